//! Vertices of draws as far as understanding needs them: samples of positions, colours, hashes of content.

use std::hash::Hash;
use std::sync::Arc;

use afterglow_gl::frame::{Draw, Format, Frame, Slot};
use glam::{Vec3, Vec4};
use hashbrown::HashMap;

/// Reads an attribute of a draw's vertices.
#[derive(Clone, Copy)]
pub struct Attribute<'a> {
    words: &'a [u32],
    indices: &'a [u32],
    stride: usize,
    offset: usize,
    /// Words of a value.
    count: usize,
    format: Format,
}

impl<'a> Attribute<'a> {
    /// The attribute in `slot`; `None` when the vertices do not store it.
    pub fn of(frame: &'a Frame, draw: &Draw, slot: usize) -> Option<Attribute<'a>> {
        let format = draw.layout.format(slot);
        let (words, indices) = frame.geometry(draw);
        let (stride, offset) = (draw.layout.stride(), draw.layout.offset(slot));
        let count = format.words();
        (format != Format::Absent).then_some(Attribute { words, indices, stride, offset, count, format })
    }

    /// Number of indices.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Value at the `i`th index, components that are not stored as OpenGL has them. Nothing when the
    /// index is out of range.
    #[inline]
    pub fn get(&self, i: usize) -> Option<Vec4> {
        let start = *self.indices.get(i)? as usize * self.stride + self.offset;
        let f = f32::from_bits;
        Some(match *self.words.get(start..start + self.count)? {
            [x, y, z] => Vec4::new(f(x), f(y), f(z), 1.0),
            [x, y] => Vec4::new(f(x), f(y), 0.0, 1.0),
            [x, y, z, w] => Vec4::new(f(x), f(y), f(z), f(w)),
            [bytes] if self.format == Format::Unorm8x4 => {
                Vec4::from_array(bytes.to_le_bytes().map(f32::from)) / 255.0
            }
            [x] => Vec4::new(f(x), 0.0, 0.0, 1.0),
            _ => Vec4::W,
        })
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

/// Facts on vertices that are asked for in each frame, found once for each content. What nobody asks for is forgotten.
#[derive(Debug, Default)]
pub struct ContentCache {
    opaque_colors: Generations<u64, bool>,
    varying_colors: Generations<u64, bool>,
    opaque_texels: Generations<(u64, u64, usize), bool>,
    triangle_keys: Generations<u64, Arc<[u64]>>,
    frames: u32,
}

/// Frames from one generation of a cache to the next.
const GENERATION: u32 = 32;

impl ContentCache {
    /// A frame begins.
    pub fn next_frame(&mut self) {
        self.frames = self.frames.wrapping_add(1);
        if self.frames.is_multiple_of(GENERATION) {
            self.opaque_colors.age();
            self.varying_colors.age();
            self.opaque_texels.age();
            self.triangle_keys.age();
        }
    }

    /// Whether all vertices of a draw, or its current colour, have an alpha of one. `content` names what the draw holds, if
    /// that is known.
    pub fn has_opaque_colors(&mut self, frame: &Frame, draw: &Draw, content: Option<u64>) -> bool {
        let stored = draw.layout.format(Slot::Color as usize) != Format::Absent;
        let find = || has_opaque_colors(frame, draw);
        self.opaque_colors.find(content.filter(|_| stored), find)
    }

    /// Whether the colours differ among the vertices.
    pub fn has_varying_colors(&mut self, frame: &Frame, draw: &Draw, content: Option<u64>) -> bool {
        self.varying_colors.find(content, || has_varying_colors(frame, draw))
    }

    /// Whether what a draw shows of an image of this content on a unit is opaque, as `find` finds it.
    pub fn has_opaque_texels(
        &mut self,
        content: Option<u64>,
        image: u64,
        unit: usize,
        find: impl FnOnce() -> bool,
    ) -> bool {
        self.opaque_texels.find(content.map(|content| (content, image, unit)), find)
    }

    /// Keys of all triangles of a draw, the smallest first, as `find` finds them in any order.
    pub fn triangle_keys(&mut self, content: Option<u64>, find: impl FnOnce() -> Vec<u64>) -> Arc<[u64]> {
        self.triangle_keys.find(content, || {
            let mut keys = find();
            keys.sort_unstable();
            keys.into()
        })
    }
}

/// What was asked for of late, and what was asked for before.
#[derive(Debug)]
struct Generations<K, V> {
    now: HashMap<K, V>,
    before: HashMap<K, V>,
}

impl<K, V> Default for Generations<K, V> {
    fn default() -> Self {
        Generations { now: HashMap::new(), before: HashMap::new() }
    }
}

impl<K: Hash + Eq + Copy, V: Clone> Generations<K, V> {
    /// The value of a key, found now unless it is known; of no key, found now.
    fn find(&mut self, key: Option<K>, find: impl FnOnce() -> V) -> V {
        let Some(key) = key else { return find() };
        let before = &self.before;
        let known = self.now.entry(key).or_insert_with(|| before.get(&key).cloned().unwrap_or_else(find));
        known.clone()
    }

    /// Forgets what was not asked for since the last time but one.
    fn age(&mut self) {
        self.before = std::mem::take(&mut self.now);
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
#[inline]
pub fn mix(hash: u64, position: Vec4) -> u64 {
    mix_pairs(hash, pairs(position))
}

/// The bits of a position's coordinates x and y, and z and w; -0 is +0.
#[inline]
pub fn pairs(position: Vec4) -> (u64, u64) {
    let [x, y, z, w] = (position + Vec4::ZERO).to_array().map(|c| u64::from(c.to_bits()));
    (x << 32 | y, z << 32 | w)
}

/// As [`mix`], of a position's bits.
#[inline]
pub fn mix_pairs(hash: u64, (xy, zw): (u64, u64)) -> u64 {
    let folded = (hash ^ xy).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
    (folded ^ zw).wrapping_mul(0xd6e8_feb8_6659_fd93).rotate_left(31)
}
