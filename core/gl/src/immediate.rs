//! Vertices between Begin and End. They are stored in the tightest layout that holds the attributes
//! given so far; a wider attribute rewrites what is stored, once.

use crate::frame::{Format, SLOTS, Slot, VertexLayout};

/// Words of the largest vertex.
const VERTEX_WORDS: usize = 4 * SLOTS;

/// Vertices of one primitive while it is being specified.
#[derive(Debug)]
pub struct Immediate {
    /// The mode of glBegin, between Begin and End.
    pub mode: Option<u32>,
    /// How the vertices are stored.
    pub layout: VertexLayout,
    /// The vertices so far.
    pub words: Vec<u32>,
    /// Number of vertices so far.
    pub count: usize,
    /// Edge flag of each vertex, if they matter (polygon modes other than fill).
    pub edges: Option<Vec<bool>>,
    /// Attributes that first came after some vertices: slot and number of vertices without it.
    pub late: Vec<(usize, usize)>,
    template: [u32; VERTEX_WORDS],
    offsets: [u8; SLOTS],
    stride: usize,
}

impl Default for Immediate {
    fn default() -> Immediate {
        Immediate {
            mode: None,
            layout: VertexLayout::default(),
            words: Vec::new(),
            count: 0,
            edges: None,
            late: Vec::new(),
            template: [0; VERTEX_WORDS],
            offsets: [0; SLOTS],
            stride: 0,
        }
    }
}

impl Immediate {
    /// glBegin.
    pub fn begin(&mut self, mode: u32, edges: bool) {
        self.mode = Some(mode);
        self.edges = edges.then(Vec::new);
        self.restart();
    }

    /// Forgets the vertices; the primitive goes on.
    pub fn restart(&mut self) {
        self.words.clear();
        self.late.clear();
        self.count = 0;
        self.layout = VertexLayout::default();
        self.stride = 0;
    }

    /// An attribute of the vertices to come. `before` is what holds for the vertices so far if the
    /// attribute was not among theirs.
    #[inline]
    pub fn attribute(&mut self, slot: usize, value: [f32; 4], before: [f32; 4]) {
        let stored = self.layout.format(slot);
        let format = tightest(slot, value);
        if format.words() > stored.words() {
            if stored == Format::Absent && self.count > 0 {
                self.late.push((slot, self.count));
            }
            self.widen(slot, format, before);
        }
        let offset = self.offsets[slot] as usize;
        for (word, v) in self.template[offset..][..self.layout.format(slot).words()].iter_mut().zip(value) {
            *word = v.to_bits();
        }
    }

    /// A vertex, with the attributes as they are now.
    #[inline]
    pub fn vertex(&mut self, position: [f32; 4], edge: bool) {
        let slot = Slot::Position as usize;
        if tightest(slot, position).words() > self.layout.format(slot).words() {
            self.widen(slot, tightest(slot, position), [0.0, 0.0, 0.0, 1.0]);
        }
        for (word, v) in self.template[..self.layout.format(slot).words()].iter_mut().zip(position) {
            *word = v.to_bits();
        }
        self.words.extend_from_slice(&self.template[..self.stride]);
        self.count += 1;
        if let Some(edges) = &mut self.edges {
            edges.push(edge);
        }
    }

    /// Stores `slot` as `format` from now on; vertices so far get `before` if they lack it.
    #[cold]
    fn widen(&mut self, slot: usize, format: Format, before: [f32; 4]) {
        let (old, new) = (self.layout, self.layout.with(slot, format));
        if self.count > 0 {
            self.words = relayout(&self.words, old, new, slot, before);
        }
        let mut template = [0; VERTEX_WORDS];
        convert(&self.template[..old.stride()], old, &mut template[..new.stride()], new, slot, before);
        self.template = template;
        self.layout = new;
        self.stride = new.stride();
        for slot in 0..SLOTS {
            self.offsets[slot] = new.offset(slot) as u8;
        }
    }
}

/// The least format that holds the value of an attribute.
#[inline]
fn tightest(slot: usize, v: [f32; 4]) -> Format {
    const NORMAL: usize = Slot::Normal as usize;
    const COLOR: usize = Slot::Color as usize;
    const SECONDARY: usize = Slot::Secondary as usize;
    const FOG: usize = Slot::Fog as usize;
    match slot {
        NORMAL | SECONDARY => Format::F3,
        FOG => Format::F1,
        COLOR if v[3] == 1.0 => Format::F3,
        COLOR => Format::F4,
        _ if v[3] != 1.0 => Format::F4,
        _ if v[2] != 0.0 => Format::F3,
        _ => Format::F2,
    }
}

fn relayout(words: &[u32], old: VertexLayout, new: VertexLayout, slot: usize, before: [f32; 4]) -> Vec<u32> {
    let (from, to) = (old.stride(), new.stride());
    let mut out = vec![0; words.len() / from * to];
    for (vertex, target) in words.chunks_exact(from).zip(out.chunks_exact_mut(to)) {
        convert(vertex, old, target, new, slot, before);
    }
    out
}

/// Copies one vertex to a layout that differs in `slot` only; what the old one lacks comes from `before`,
/// or from (0, 0, 0, 1) where it had fewer components.
fn convert(
    vertex: &[u32],
    old: VertexLayout,
    target: &mut [u32],
    new: VertexLayout,
    slot: usize,
    before: [f32; 4],
) {
    let (had, has) = (old.format(slot).words(), new.format(slot).words());
    let (head, tail) = (old.offset(slot), old.offset(slot) + had);
    target[..head].copy_from_slice(&vertex[..head]);
    let filler = if had == 0 { before } else { [0.0, 0.0, 0.0, 1.0] };
    for (i, (word, v)) in target[head..head + has].iter_mut().zip(filler).enumerate() {
        *word = if i < had { vertex[head + i] } else { v.to_bits() };
    }
    target[head + has..].copy_from_slice(&vertex[tail..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floats(immediate: &Immediate) -> Vec<f32> {
        immediate.words.iter().map(|&w| f32::from_bits(w)).collect()
    }

    #[test]
    fn a_late_attribute_fills_earlier_vertices_with_the_value_before() {
        let mut immediate = Immediate::default();
        immediate.begin(4, false);
        immediate.vertex([1.0, 2.0, 0.0, 1.0], true);
        immediate.attribute(Slot::Color as usize, [0.1, 0.2, 0.3, 1.0], [0.5, 0.6, 0.7, 0.8]);
        immediate.vertex([3.0, 4.0, 5.0, 1.0], true);
        assert_eq!(floats(&immediate), [1.0, 2.0, 0.0, 0.5, 0.6, 0.7, 3.0, 4.0, 5.0, 0.1, 0.2, 0.3]);
        assert_eq!(immediate.late, [(Slot::Color as usize, 1)]);
    }

    #[test]
    fn a_wider_value_keeps_what_was_stored() {
        let mut immediate = Immediate::default();
        immediate.begin(4, false);
        immediate.attribute(Slot::Texture0 as usize, [0.25, 0.75, 0.0, 1.0], [0.0; 4]);
        immediate.vertex([1.0, 2.0, 0.0, 1.0], true);
        immediate.attribute(Slot::Texture0 as usize, [0.5, 0.5, 0.0, 2.0], [0.0; 4]);
        immediate.vertex([1.0, 2.0, 0.0, 1.0], true);
        assert_eq!(floats(&immediate), [1.0, 2.0, 0.25, 0.75, 0.0, 1.0, 1.0, 2.0, 0.5, 0.5, 0.0, 2.0]);
    }
}
