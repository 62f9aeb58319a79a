//! Vertices between Begin and End. They are stored in the tightest layout that holds the attributes
//! given so far; a wider attribute rewrites what is stored, once.

use glam::Vec4;

use crate::frame::{Format, SLOTS, Slot, VertexLayout};

/// Words of the largest value.
const VALUE_WORDS: usize = 4;

/// Vertices of one primitive while it is being specified.
///
/// A value is always stored with four words; in a vertex the next one covers what it has too many. So nothing here
/// depends on how wide an attribute is but the rare change of the layout.
#[derive(Debug)]
pub struct Immediate {
    /// The mode of glBegin, between Begin and End.
    pub mode: Option<u32>,
    /// How the vertices are stored.
    pub layout: VertexLayout,
    /// Number of vertices so far.
    pub count: usize,
    /// Edge flag of each vertex, if they matter (polygon modes other than fill).
    pub edges: Option<Vec<bool>>,
    /// Attributes that first came after some vertices: slot and number of vertices without it.
    pub late: Vec<(usize, usize)>,
    /// The vertices so far, and room for more.
    buffer: Vec<u32>,
    /// Words of the buffer that are in use.
    used: usize,
    stride: usize,
    /// The latest value of each attribute that the layout has. They are written and read as a whole: a load of what
    /// was stored in parts would wait for the stores.
    values: [Vec4; SLOTS],
    /// Words that the layout has of each attribute. Outside Begin and End all, so that no value is too wide.
    held: [u8; SLOTS],
    /// Slot and offset of each attribute of the layout but the position, by offset.
    parts: [(u8, u8); SLOTS],
    part_count: usize,
}

impl Default for Immediate {
    fn default() -> Immediate {
        Immediate {
            mode: None,
            layout: VertexLayout::default(),
            count: 0,
            edges: None,
            late: Vec::new(),
            buffer: Vec::new(),
            used: 0,
            stride: 0,
            values: [Vec4::ZERO; SLOTS],
            held: [VALUE_WORDS as u8; SLOTS],
            parts: [(0, 0); SLOTS],
            part_count: 0,
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

    /// glEnd: the mode that there was, if any. The vertices stay until the next Begin.
    pub fn end(&mut self) -> Option<u32> {
        self.held = [VALUE_WORDS as u8; SLOTS];
        self.mode.take()
    }

    /// Forgets the vertices; the primitive goes on.
    pub fn restart(&mut self) {
        self.late.clear();
        self.count = 0;
        self.used = 0;
        self.layout = VertexLayout::default();
        self.stride = 0;
        self.held = [0; SLOTS];
        self.part_count = 0;
    }

    /// The vertices so far.
    pub fn words(&self) -> &[u32] {
        &self.buffer[..self.used]
    }

    /// Takes the vertices out, with what is behind them: so many words are vertices. To be given back.
    pub fn take(&mut self) -> (Vec<u32>, usize) {
        (std::mem::take(&mut self.buffer), self.used)
    }

    /// Gives the memory of vertices back.
    pub fn give_back(&mut self, buffer: Vec<u32>) {
        self.buffer = buffer;
    }

    /// An attribute of the vertices to come. `before` is what holds for the vertices so far if the
    /// attribute was not among theirs.
    #[inline(always)]
    pub fn attribute(&mut self, slot: usize, [x, y, z, w]: [f32; 4], before: &[f32; 4]) {
        if tightest(slot, [x, y, z, w]).words() as u8 > self.held[slot] {
            self.widen_for(slot, x, y, z, w, before);
        }
        self.values[slot] = Vec4::new(x, y, z, w);
    }

    /// A vertex, with the attributes as they are now.
    #[inline(always)]
    pub fn vertex(&mut self, [x, y, z, w]: [f32; 4], edge: bool) {
        let slot = Slot::Position as usize;
        let format = tightest(slot, [x, y, z, w]);
        if format.words() as u8 > self.held[slot] {
            self.widen(slot, format, [0.0, 0.0, 0.0, 1.0]);
        }
        if self.used + self.stride + VALUE_WORDS > self.buffer.len() {
            self.grow();
        }
        let vertex = &mut self.buffer[self.used..self.used + self.stride + VALUE_WORDS];
        store(vertex, 0, Vec4::new(x, y, z, w));
        for &(slot, offset) in &self.parts[..self.part_count] {
            store(vertex, offset as usize, self.values[slot as usize]);
        }
        self.used += self.stride;
        self.count += 1;
        if self.edges.is_some() {
            self.push_edge(edge);
        }
    }

    #[cold]
    fn push_edge(&mut self, edge: bool) {
        self.edges.get_or_insert_default().push(edge);
    }

    #[cold]
    fn grow(&mut self) {
        let least = self.used + self.stride + VALUE_WORDS;
        self.buffer.resize((2 * least).max(1024), 0);
    }

    #[cold]
    fn widen_for(&mut self, slot: usize, x: f32, y: f32, z: f32, w: f32, before: &[f32; 4]) {
        if self.held[slot] == 0 && self.count > 0 {
            self.late.push((slot, self.count));
        }
        self.widen(slot, tightest(slot, [x, y, z, w]), *before);
    }

    /// Stores `slot` as `format` from now on; vertices so far get `before` if they lack it.
    #[cold]
    fn widen(&mut self, slot: usize, format: Format, before: [f32; 4]) {
        let (old, new) = (self.layout, self.layout.with(slot, format));
        if self.count > 0 {
            self.buffer = relayout(self.words(), old, new, slot, before);
            self.used = self.buffer.len();
        }
        self.layout = new;
        self.stride = new.stride();
        self.part_count = 0;
        for slot in 0..SLOTS {
            self.held[slot] = new.format(slot).words() as u8;
            if self.held[slot] > 0 && slot != Slot::Position as usize {
                self.parts[self.part_count] = (slot as u8, new.offset(slot) as u8);
                self.part_count += 1;
            }
        }
    }
}

/// Writes all of a value to a vertex, if there is room.
#[inline(always)]
fn store(vertex: &mut [u32], offset: usize, value: Vec4) {
    if let Some(words) = vertex.get_mut(offset..offset + VALUE_WORDS) {
        words.copy_from_slice(&bytemuck::cast::<Vec4, [u32; VALUE_WORDS]>(value));
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
        immediate.words().iter().map(|&w| f32::from_bits(w)).collect()
    }

    #[test]
    fn a_late_attribute_fills_earlier_vertices_with_the_value_before() {
        let mut immediate = Immediate::default();
        immediate.begin(4, false);
        immediate.vertex([1.0, 2.0, 0.0, 1.0], true);
        immediate.attribute(Slot::Color as usize, [0.1, 0.2, 0.3, 1.0], &[0.5, 0.6, 0.7, 0.8]);
        immediate.vertex([3.0, 4.0, 5.0, 1.0], true);
        assert_eq!(floats(&immediate), [1.0, 2.0, 0.0, 0.5, 0.6, 0.7, 3.0, 4.0, 5.0, 0.1, 0.2, 0.3]);
        assert_eq!(immediate.late, [(Slot::Color as usize, 1)]);
    }

    #[test]
    fn a_wider_value_keeps_what_was_stored() {
        let mut immediate = Immediate::default();
        immediate.begin(4, false);
        immediate.attribute(Slot::Texture0 as usize, [0.25, 0.75, 0.0, 1.0], &[0.0; 4]);
        immediate.vertex([1.0, 2.0, 0.0, 1.0], true);
        immediate.attribute(Slot::Texture0 as usize, [0.5, 0.5, 0.0, 2.0], &[0.0; 4]);
        immediate.vertex([1.0, 2.0, 0.0, 1.0], true);
        assert_eq!(floats(&immediate), [1.0, 2.0, 0.25, 0.75, 0.0, 1.0, 1.0, 2.0, 0.5, 0.5, 0.0, 2.0]);
    }
}
