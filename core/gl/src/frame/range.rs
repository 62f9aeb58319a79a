//! Vertices in memory: their layout, and ranges that outlive a frame.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use super::words::TEXTURE_UNITS;

/// An attribute of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Slot {
    /// Object-space position.
    Position = 0,
    /// Normal.
    Normal = 1,
    /// Primary colour.
    Color = 2,
    /// Secondary colour.
    Secondary = 3,
    /// Fog coordinate.
    Fog = 4,
    /// Texture coordinates of unit 0; the other units follow.
    Texture0 = 5,
}

/// Number of attribute slots.
pub const SLOTS: usize = 5 + TEXTURE_UNITS;

/// How an attribute is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Format {
    /// Not stored: the draw's current value holds for every vertex.
    Absent = 0,
    /// One f32; y = z = 0, w = 1.
    F1 = 1,
    /// Two f32.
    F2 = 2,
    /// Three f32.
    F3 = 3,
    /// Four f32.
    F4 = 4,
    /// Four unsigned normalised bytes in one word, red in the lowest byte.
    Unorm8x4 = 5,
}

impl Format {
    /// Words that the attribute takes.
    pub const fn words(self) -> usize {
        match self {
            Format::Absent => 0,
            Format::Unorm8x4 | Format::F1 => 1,
            Format::F2 => 2,
            Format::F3 => 3,
            Format::F4 => 4,
        }
    }

    /// The format of so many floats.
    pub const fn of_words(words: usize) -> Format {
        match words {
            0 => Format::Absent,
            1 => Format::F1,
            2 => Format::F2,
            3 => Format::F3,
            _ => Format::F4,
        }
    }

    const fn from_bits(bits: u32) -> Format {
        match bits {
            1 => Format::F1,
            2 => Format::F2,
            3 => Format::F3,
            4 => Format::F4,
            5 => Format::Unorm8x4,
            _ => Format::Absent,
        }
    }
}

/// Attributes of a vertex, stored tightly in slot order: 3 bits of [`Format`] a slot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct VertexLayout(pub u32);

impl VertexLayout {
    /// The same layout with `slot` stored as `format`.
    #[must_use]
    pub const fn with(self, slot: usize, format: Format) -> VertexLayout {
        let shift = 3 * slot as u32;
        VertexLayout((self.0 & !(7 << shift)) | ((format as u32) << shift))
    }

    /// How `slot` is stored.
    pub const fn format(self, slot: usize) -> Format {
        Format::from_bits((self.0 >> (3 * slot as u32)) & 7)
    }

    /// Words from one vertex to the next.
    pub const fn stride(self) -> usize {
        self.offset(SLOTS)
    }

    /// Number of vertices in so many words, fewer than 2^32: dividing 32 bits takes half of the time of 64.
    pub fn vertices_in(self, words: usize) -> usize {
        let words = u32::try_from(words).unwrap_or(0);
        words.checked_div(self.stride() as u32).unwrap_or(0) as usize
    }

    /// Words from the start of a vertex to `slot`.
    pub const fn offset(self, slot: usize) -> usize {
        // One octal digit a slot. A format is its number of words but for `Unorm8x4`, which takes one.
        const ONES: u32 = 0o111_111_111;
        let formats = self.0 & ((1 << (3 * slot as u32)) - 1);
        let bytes = formats & (formats >> 2) & ONES;
        let words = formats & !(bytes << 2);
        // The sum of the digits, two by two; modulo 64 - 1 for what no digit of 6 bits exceeds.
        let pairs = (words & 0o070_707_070) / 8 + (words & 0o707_070_707);
        (pairs % 63) as usize
    }
}

/// Vertices and indices that outlive a frame (a display list's, a buffer object's): never changed;
/// new content is a new range. Uploaded once, hashed once.
#[derive(Debug)]
pub struct RetainedRange {
    id: u64,
    /// How the vertices are stored.
    pub layout: VertexLayout,
    /// The vertices, `layout.stride()` words each.
    pub words: Box<[u32]>,
    /// Indices from 0, of triangles, lines or points.
    pub indices: Box<[u32]>,
    hash: OnceLock<u64>,
}

static NEXT_RANGE: AtomicU64 = AtomicU64::new(1);

impl RetainedRange {
    /// A range with an id of its own.
    pub fn new(layout: VertexLayout, words: Vec<u32>, indices: Vec<u32>) -> RetainedRange {
        RetainedRange {
            id: NEXT_RANGE.fetch_add(1, Ordering::Relaxed),
            layout,
            words: words.into(),
            indices: indices.into(),
            hash: OnceLock::new(),
        }
    }

    /// Unique in the process, never used again.
    pub fn id(&self) -> u64 {
        self.id
    }

    /// Hash of layout, vertices and indices, computed once.
    pub fn content_hash(&self) -> u64 {
        *self.hash.get_or_init(|| {
            let mut hasher = xxhash_rust::xxh3::Xxh3::new();
            hasher.update(&self.layout.0.to_le_bytes());
            hasher.update(bytemuck::cast_slice(&self.words));
            hasher.update(bytemuck::cast_slice(&self.indices));
            hasher.digest()
        })
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.layout.vertices_in(self.words.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_are_sums_of_words() {
        let formats =
            [Format::Absent, Format::F1, Format::F2, Format::F3, Format::F4, Format::Unorm8x4, Format::F4];
        for first in 0..formats.len() {
            let (mut layout, mut words) = (VertexLayout::default(), 0);
            for slot in 0..SLOTS {
                let format = formats[(first + slot * slot) % formats.len()];
                layout = layout.with(slot, format);
                words += format.words();
                assert_eq!((layout.format(slot), layout.offset(slot + 1)), (format, words));
            }
            assert_eq!(layout.stride(), words);
            assert_eq!([0, words - 1, 3 * words].map(|words| layout.vertices_in(words)), [0, 0, 3]);
        }
        assert_eq!(VertexLayout::default().vertices_in(9), 0);
        let widest = (0..SLOTS).fold(VertexLayout::default(), |layout, slot| layout.with(slot, Format::F4));
        assert_eq!(widest.stride(), 4 * SLOTS);
    }
}
