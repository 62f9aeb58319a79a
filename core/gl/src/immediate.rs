//! Vertices between Begin and End. They are stored in the tightest layout that holds the attributes
//! given so far; a wider attribute rewrites what is stored, once.

use glam::Vec4;

use crate::frame::{Format, SLOTS, Slot, VertexLayout};

/// Words of the largest value.
const VALUE_WORDS: usize = 4;
/// Words of the largest vertex, and what its last value may have too many.
const VERTEX_ROOM: usize = VALUE_WORDS * (SLOTS + 1);

/// Words by attribute slot, in a power of two of bytes: compared at once.
type Widths = [u8; SLOTS.next_power_of_two()];

const NONE: Widths = [0; SLOTS.next_power_of_two()];
const WIDEST: Widths = {
    let mut widths = [VALUE_WORDS as u8; SLOTS.next_power_of_two()];
    // A vertex outside of Begin and End is none.
    widths[Slot::Position as usize] = 0;
    widths
};

/// Vertices of one primitive while it is being specified.
///
/// What comes often goes the quick way: an attribute only becomes the current one, and a vertex takes what is current.
/// A value is always stored with four words; in a vertex the next one covers what it has too many. So nothing there
/// depends on how wide an attribute is, but the test whether the layout of the vertices so far suits it, and the same
/// test turns away what the quick way does not know.
#[derive(Debug)]
pub struct Immediate {
    /// The mode of glBegin, between Begin and End.
    pub mode: Option<u32>,
    /// How the vertices are stored, once there is one.
    pub layout: VertexLayout,
    /// Edge flag of each vertex, if they matter (polygon modes other than fill).
    pub edges: Option<Vec<bool>>,
    /// Attributes that first came after some vertices: slot and number of vertices without it.
    pub late: Vec<(usize, usize)>,
    /// Widths of values that may go the quick way.
    quick: Widths,
    /// Every value goes the long way, because a list takes note of it.
    is_watched: bool,
    /// The vertices so far, and room for more.
    buffer: Vec<u32>,
    /// Words of the buffer that are in use.
    used: usize,
    stride: usize,
    /// Slot and offset of each attribute of the layout but the position, by offset.
    parts: [(u8, u8); SLOTS],
    part_count: usize,
    /// Words that the vertices to come have of each attribute.
    held: Widths,
    /// What `held` was when the layout was made of it.
    laid_out: Widths,
}

impl Default for Immediate {
    fn default() -> Immediate {
        Immediate {
            mode: None,
            layout: VertexLayout::default(),
            edges: None,
            late: Vec::new(),
            quick: WIDEST,
            is_watched: false,
            buffer: Vec::new(),
            used: 0,
            stride: 0,
            parts: [(0, 0); SLOTS],
            part_count: 0,
            held: NONE,
            laid_out: NONE,
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
        self.quick = if self.is_watched { NONE } else { WIDEST };
        self.mode.take()
    }

    /// Whether a list takes note of every value from now on; outside of Begin and End.
    pub fn watch(&mut self, is_watched: bool) {
        self.is_watched = is_watched;
        self.quick = if is_watched { NONE } else { WIDEST };
    }

    /// Forgets the vertices; the primitive goes on.
    pub fn restart(&mut self) {
        self.late.clear();
        self.used = 0;
        self.held = NONE;
        self.quick = NONE;
    }

    /// Number of vertices so far.
    pub fn count(&self) -> usize {
        if self.used == 0 { 0 } else { self.used / self.stride }
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

    /// Whether a value may become current without further ado.
    #[inline(always)]
    pub fn is_quick(&self, slot: usize, value: [f32; 4]) -> bool {
        tightest(slot, value).words() as u8 <= self.quick[slot]
    }

    /// A vertex the quick way, with the attributes that are current. `false`: it must go the long way.
    #[inline(always)]
    pub fn push_quickly(&mut self, position: [f32; 4], current: &[Vec4; SLOTS]) -> bool {
        self.is_quick(Slot::Position as usize, position) && self.store(position, current)
    }

    /// A vertex of whatever width. `current` has the values of the attributes.
    pub fn push(&mut self, position: [f32; 4], edge: bool, current: &[Vec4; SLOTS]) {
        self.admit(Slot::Position as usize, position, [0.0, 0.0, 0.0, 1.0]);
        if self.used == 0 {
            self.lay_out();
        }
        if !self.store(position, current) {
            self.buffer.resize((2 * self.used).max(8 * VERTEX_ROOM), 0);
            self.store(position, current);
        }
        match &mut self.edges {
            Some(edges) => edges.push(edge),
            None if self.is_watched => {}
            None => self.quick = self.held,
        }
    }

    /// Vertices to come have an attribute as wide as `value`. `before` is what holds for the vertices so far if the
    /// attribute was not among theirs: then it must be wide enough for that, too, and a list does not know it yet.
    pub fn admit(&mut self, slot: usize, value: [f32; 4], before: [f32; 4]) {
        let mut words = tightest(slot, value).words() as u8;
        if self.mode.is_none() || words <= self.held[slot] {
            return;
        }
        if self.held[slot] == 0 && self.used > 0 {
            self.late.push((slot, self.count()));
            let unknown = [f32::NAN; 4];
            words = words.max(tightest(slot, if self.is_watched { unknown } else { before }).words() as u8);
        }
        self.held[slot] = words;
        if self.used > 0 {
            let old = self.layout;
            self.lay_out();
            self.buffer.truncate(self.used);
            self.buffer = relayout(&self.buffer, old, self.layout, slot, before);
            self.used = self.buffer.len();
        }
        if !self.is_watched && slot != Slot::Position as usize {
            self.quick[slot] = words;
        }
    }

    /// Makes the layout for what is held.
    fn lay_out(&mut self) {
        if self.laid_out == self.held {
            return;
        }
        self.laid_out = self.held;
        self.layout = VertexLayout::default();
        for slot in 0..SLOTS {
            self.layout = self.layout.with(slot, Format::of_words(self.held[slot].into()));
        }
        self.stride = self.layout.stride();
        self.part_count = 0;
        for slot in (0..SLOTS).filter(|&slot| slot != Slot::Position as usize && self.held[slot] > 0) {
            self.parts[self.part_count] = (slot as u8, self.layout.offset(slot) as u8);
            self.part_count += 1;
        }
    }

    /// Writes a vertex, if there is room.
    #[inline(always)]
    fn store(&mut self, [x, y, z, w]: [f32; 4], current: &[Vec4; SLOTS]) -> bool {
        let free = self.buffer.get_mut(self.used..).and_then(|free| free.first_chunk_mut::<VERTEX_ROOM>());
        let Some(vertex) = free else { return false };
        store(vertex, 0, Vec4::new(x, y, z, w));
        for &(slot, offset) in self.parts.iter().take(self.part_count) {
            if let Some(value) = current.get(slot as usize) {
                store(vertex, offset as usize, *value);
            }
        }
        self.used += self.stride;
        true
    }
}

/// Writes all of a value to a vertex.
#[inline(always)]
fn store(vertex: &mut [u32; VERTEX_ROOM], offset: usize, value: Vec4) {
    if let Some(words) = vertex.get_mut(offset..offset + VALUE_WORDS) {
        words.copy_from_slice(&bytemuck::cast::<Vec4, [u32; VALUE_WORDS]>(value));
    }
}

/// The least format that holds the value of an attribute.
#[inline(always)]
fn tightest(slot: usize, [_, _, z, w]: [f32; 4]) -> Format {
    const NORMAL: usize = Slot::Normal as usize;
    const COLOR: usize = Slot::Color as usize;
    const SECONDARY: usize = Slot::Secondary as usize;
    const FOG: usize = Slot::Fog as usize;
    // By their bits: quicker, and right for what is no number.
    let is_one = w.to_bits() == 1.0_f32.to_bits();
    let is_flat = z.to_bits() << 1 == 0;
    match slot {
        NORMAL | SECONDARY => Format::F3,
        FOG => Format::F1,
        COLOR if is_one => Format::F3,
        COLOR => Format::F4,
        _ if !is_one => Format::F4,
        _ if !is_flat => Format::F3,
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

    /// Calls as a context makes them.
    struct Caller {
        immediate: Immediate,
        current: [Vec4; SLOTS],
    }

    impl Caller {
        fn new(is_watched: bool) -> Caller {
            let mut immediate = Immediate::default();
            immediate.watch(is_watched);
            immediate.begin(4, false);
            Caller { immediate, current: [Vec4::new(0.5, 0.6, 0.7, 0.8); SLOTS] }
        }

        fn attribute(&mut self, slot: Slot, value: [f32; 4]) {
            let slot = slot as usize;
            if !self.immediate.is_quick(slot, value) {
                self.immediate.admit(slot, value, self.current[slot].to_array());
            }
            self.current[slot] = Vec4::from_array(value);
        }

        fn vertex(&mut self, position: [f32; 4]) {
            if !self.immediate.push_quickly(position, &self.current) {
                self.immediate.push(position, true, &self.current);
            }
        }

        fn floats(&self) -> Vec<f32> {
            self.immediate.words().iter().map(|&w| f32::from_bits(w)).collect()
        }
    }

    #[test]
    fn a_late_attribute_fills_earlier_vertices_with_the_value_before() {
        for is_watched in [false, true] {
            let mut caller = Caller::new(is_watched);
            caller.vertex([1.0, 2.0, 0.0, 1.0]);
            caller.attribute(Slot::Color, [0.1, 0.2, 0.3, 1.0]);
            caller.vertex([3.0, 4.0, 5.0, 1.0]);
            let expected = [1.0, 2.0, 0.0, 0.5, 0.6, 0.7, 0.8, 3.0, 4.0, 5.0, 0.1, 0.2, 0.3, 1.0];
            assert_eq!(caller.floats(), expected);
            assert_eq!(caller.immediate.late, [(Slot::Color as usize, 1)]);
        }
    }

    #[test]
    fn a_wider_value_keeps_what_was_stored() {
        let mut caller = Caller::new(false);
        caller.attribute(Slot::Texture0, [0.25, 0.75, 0.0, 1.0]);
        caller.vertex([1.0, 2.0, 0.0, 1.0]);
        caller.attribute(Slot::Texture0, [0.5, 0.5, 0.0, 2.0]);
        caller.vertex([1.0, 2.0, 0.0, 1.0]);
        assert_eq!(caller.floats(), [1.0, 2.0, 0.25, 0.75, 0.0, 1.0, 1.0, 2.0, 0.5, 0.5, 0.0, 2.0]);
    }

    #[test]
    fn a_primitive_has_the_attributes_of_its_own() {
        let mut caller = Caller::new(false);
        caller.attribute(Slot::Normal, [0.0, 0.0, 1.0, 0.0]);
        caller.vertex([1.0, 2.0, 3.0, 1.0]);
        assert_eq!(caller.immediate.end(), Some(4));
        caller.attribute(Slot::Color, [0.1, 0.2, 0.3, 0.4]);
        caller.immediate.begin(4, false);
        assert_eq!(caller.immediate.count(), 0);
        caller.vertex([4.0, 5.0, 0.0, 1.0]);
        assert_eq!(caller.floats(), [4.0, 5.0]);
        assert_eq!(caller.immediate.count(), 1);
    }

    #[test]
    fn many_vertices_of_many_attributes_find_room() {
        let mut caller = Caller::new(false);
        for i in 0..1000 {
            for unit in 0..4 {
                let slot = Slot::Texture0 as usize + unit;
                let value = [i as f32, unit as f32, 1.0, 2.0];
                if !caller.immediate.is_quick(slot, value) {
                    caller.immediate.admit(slot, value, [0.0; 4]);
                }
                caller.current[slot] = Vec4::from_array(value);
            }
            caller.vertex([0.0, 1.0, 2.0, i as f32]);
        }
        assert_eq!((caller.immediate.count(), caller.immediate.layout.stride()), (1000, 20));
        let words = caller.floats();
        let vertex = |i: usize| &words[20 * i..20 * i + 8];
        assert!((0..1000).all(|i| vertex(i)[2..5] == [2.0, if i == 1 { 1.0 } else { i as f32 }, i as f32]));
    }
}
