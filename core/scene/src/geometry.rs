//! Vertices of draws as far as understanding needs them: samples of positions, colours, hashes of content.

use afterglow_gl::frame::{Draw, Format, Frame, Slot, VertexSource};
use glam::{Vec3, Vec4};
use hashbrown::HashMap;

/// Reads an attribute of a draw's vertices.
#[derive(Clone, Copy)]
pub struct Attribute<'a> {
    words: &'a [u32],
    indices: &'a [u32],
    stride: usize,
    offset: usize,
    format: Format,
}

impl<'a> Attribute<'a> {
    /// The attribute in `slot`; `None` when the vertices do not store it.
    pub fn of(frame: &'a Frame, draw: &Draw, slot: usize) -> Option<Attribute<'a>> {
        let format = draw.layout.format(slot);
        let (words, indices) = frame.geometry(draw);
        let (stride, offset) = (draw.layout.stride(), draw.layout.offset(slot));
        (format != Format::Absent).then_some(Attribute { words, indices, stride, offset, format })
    }

    /// Number of indices.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Value at the `i`th index, components that are not stored as OpenGL has them. Nothing when the
    /// index is out of range.
    pub fn get(&self, i: usize) -> Option<Vec4> {
        let start = *self.indices.get(i)? as usize * self.stride + self.offset;
        let words = self.words.get(start..start + self.format.words())?;
        let mut value = Vec4::W;
        if self.format == Format::Unorm8x4 {
            return Some(Vec4::from_array(words[0].to_le_bytes().map(f32::from)) / 255.0);
        }
        for (component, word) in words.iter().enumerate() {
            value[component] = f32::from_bits(*word);
        }
        Some(value)
    }

    /// Up to `count` values spread evenly over the indices, first and last included.
    pub fn samples(self, count: usize) -> impl Iterator<Item = Vec4> + use<'a> {
        let taken = self.len().min(count);
        let last = self.len().saturating_sub(1);
        (0..taken).filter_map(move |i| self.get(i * last / (taken - 1).max(1)))
    }
}

/// Positions of a draw, spread evenly over it.
pub fn sample_positions(frame: &Frame, draw: &Draw, count: usize) -> impl Iterator<Item = Vec3> {
    Attribute::of(frame, draw, Slot::Position as usize)
        .into_iter()
        .flat_map(move |positions| positions.samples(count))
        .map(|p| if p.w == 1.0 || p.w == 0.0 { p.truncate() } else { p.truncate() / p.w })
        .filter(|p| p.is_finite())
}

/// The colour of a draw whose vertices store none.
fn current_color(frame: &Frame, draw: &Draw) -> Vec4 {
    frame.current.get(draw.current as usize).map_or(Vec4::ONE, |c| Vec4::from_array(c.color))
}

/// Whether the colours differ among the vertices.
pub fn has_varying_colors(frame: &Frame, draw: &Draw) -> bool {
    let Some(colors) = Attribute::of(frame, draw, Slot::Color as usize) else { return false };
    let (mut least, mut most) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for color in colors.samples(48) {
        least = least.min(color.truncate());
        most = most.max(color.truncate());
    }
    (most - least).max_element() > 4.5 / 255.0
}

/// Mean colour of samples of the vertices, as the program gave them.
pub fn mean_color(frame: &Frame, draw: &Draw) -> Vec4 {
    let Some(colors) = Attribute::of(frame, draw, Slot::Color as usize) else {
        return current_color(frame, draw);
    };
    let (sum, count) = colors.samples(48).fold((Vec4::ZERO, 0.0), |(s, n), c| (s + c, n + 1.0));
    sum / f32::max(count, 1.0)
}

fn has_opaque_colors(frame: &Frame, draw: &Draw) -> bool {
    match Attribute::of(frame, draw, Slot::Color as usize) {
        None => is_one(current_color(frame, draw).w),
        Some(colors) if matches!(colors.format, Format::F4 | Format::Unorm8x4) => {
            (0..colors.len()).all(|i| colors.get(i).is_none_or(|color| is_one(color.w)))
        }
        Some(_) => true,
    }
}

/// Whether an alpha shows as one in eight bits.
pub fn is_one(alpha: f32) -> bool {
    alpha > 1.0 - 0.5 / 255.0
}

/// Names the content of a draw in a retained range.
pub type RetainedKey = (u64, u32, u32);

/// The content of a draw that outlives the frame, if it does.
pub fn retained_key(frame: &Frame, draw: &Draw) -> Option<RetainedKey> {
    match draw.source {
        VertexSource::Arena { .. } => None,
        VertexSource::Retained { range, first_index } => {
            Some((frame.retained.get(range as usize)?.id(), first_index, draw.index_count))
        }
    }
}

/// Facts on retained content, found once. Bounded: started anew when it grows large.
#[derive(Debug, Default)]
pub struct ContentCache {
    opaque_colors: HashMap<RetainedKey, bool>,
}

/// Entries of each table after which it is started anew (programs make ranges without end).
const CACHE_ENTRIES: usize = 1 << 16;

impl ContentCache {
    /// Whether all vertices of a draw, or its current colour, have an alpha of one.
    pub fn has_opaque_colors(&mut self, frame: &Frame, draw: &Draw) -> bool {
        let stored = draw.layout.format(Slot::Color as usize) != Format::Absent;
        match retained_key(frame, draw).filter(|_| stored) {
            None => has_opaque_colors(frame, draw),
            Some(key) => {
                bound(&mut self.opaque_colors);
                *self.opaque_colors.entry(key).or_insert_with(|| has_opaque_colors(frame, draw))
            }
        }
    }
}

fn bound<T>(table: &mut HashMap<RetainedKey, T>) {
    if table.len() >= CACHE_ENTRIES {
        table.clear();
    }
}

/// Positions that stand for a draw's in its hash.
const HASHED: usize = 96;

/// Hash of a draw's object-space positions: their number and, in drawing order, up to [`HASHED`] spread over
/// them. Two draws of a frame with the same are the same surface.
pub fn hash_positions(frame: &Frame, draw: &Draw) -> u64 {
    let positions = Attribute::of(frame, draw, Slot::Position as usize);
    let samples = positions.into_iter().flat_map(|positions| positions.samples(HASHED));
    samples.fold(draw.index_count.into(), mix)
}

/// Folds a position into a hash; -0 is +0.
pub fn mix(hash: u64, position: Vec4) -> u64 {
    let [x, y, z, w] = (position + Vec4::ZERO).to_array().map(|c| u64::from(c.to_bits()));
    let folded = (hash ^ (x << 32 | y)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
    (folded ^ (z << 32 | w)).wrapping_mul(0xd6e8_feb8_6659_fd93).rotate_left(31)
}
