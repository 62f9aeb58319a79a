//! Vertices of draws as far as understanding needs them: samples of positions, colours, keys of content.

use std::hash::{BuildHasher, Hasher};

use afterglow_gl::frame::{Draw, Format, Frame, Slot, VertexSource};
use glam::{Vec3, Vec4};
use hashbrown::{DefaultHashBuilder, HashMap, HashSet};

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

/// What a draw's vertex colours are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colors {
    /// Every alpha is one.
    pub opaque: bool,
    /// The colours differ among the vertices.
    pub varying: bool,
    /// Mean of samples, as the program gave them.
    pub mean: Vec3,
}

impl Colors {
    fn constant(color: Vec4) -> Colors {
        Colors { opaque: is_one(color.w), varying: false, mean: color.truncate() }
    }

    fn read(frame: &Frame, draw: &Draw) -> Colors {
        let Some(colors) = Attribute::of(frame, draw, Slot::Color as usize) else {
            let current = frame.current.get(draw.current as usize);
            return Colors::constant(current.map_or(Vec4::ONE, |c| Vec4::from_array(c.color)));
        };
        let stores_alpha = matches!(colors.format, Format::F4 | Format::Unorm8x4);
        let opaque = !stores_alpha
            || (0..colors.len()).all(|i| colors.get(i).is_none_or(|color| is_one(color.w)));
        let (mut least, mut most) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (mut sum, mut count) = (Vec3::ZERO, 0.0);
        for color in colors.samples(48) {
            least = least.min(color.truncate());
            most = most.max(color.truncate());
            sum += color.truncate();
            count += 1.0;
        }
        let varying = (most - least).max_element() > 4.5 / 255.0;
        Colors { opaque, varying, mean: sum / f32::max(count, 1.0) }
    }
}

fn is_one(alpha: f32) -> bool {
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
    colors: HashMap<RetainedKey, Colors>,
    positions: HashMap<RetainedKey, u64>,
}

/// Entries of each table after which it is started anew (programs make ranges without end).
const CACHE_ENTRIES: usize = 1 << 16;

impl ContentCache {
    /// Vertex colours of a draw, or its current colour.
    pub fn colors(&mut self, frame: &Frame, draw: &Draw) -> Colors {
        let stored = draw.layout.format(Slot::Color as usize) != Format::Absent;
        match retained_key(frame, draw).filter(|_| stored) {
            None => Colors::read(frame, draw),
            Some(key) => {
                bound(&mut self.colors);
                *self.colors.entry(key).or_insert_with(|| Colors::read(frame, draw))
            }
        }
    }

    /// Hash of a draw's object-space positions in drawing order.
    pub fn positions(&mut self, frame: &Frame, draw: &Draw) -> u64 {
        match retained_key(frame, draw) {
            None => hash_positions(frame, draw),
            Some(key) => {
                bound(&mut self.positions);
                *self.positions.entry(key).or_insert_with(|| hash_positions(frame, draw))
            }
        }
    }
}

fn bound<T>(table: &mut HashMap<RetainedKey, T>) {
    if table.len() >= CACHE_ENTRIES {
        table.clear();
    }
}

fn hash_positions(frame: &Frame, draw: &Draw) -> u64 {
    let Some(positions) = Attribute::of(frame, draw, Slot::Position as usize) else { return 0 };
    (0..positions.len()).filter_map(|i| positions.get(i)).fold(draw.index_count.into(), mix)
}

/// Folds a position into a hash; -0 is +0.
fn mix(hash: u64, position: Vec4) -> u64 {
    let [x, y, z, w] = (position + Vec4::ZERO).to_array().map(|c| u64::from(c.to_bits()));
    let folded = (hash ^ (x << 32 | y)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
    (folded ^ (z << 32 | w)).wrapping_mul(0xd6e8_feb8_6659_fd93).rotate_left(31)
}

/// Surfaces of the world that have been drawn, to find what is drawn over them again.
#[derive(Debug, Default)]
pub struct Surfaces {
    hasher: DefaultHashBuilder,
    draws: HashSet<(u64, u64)>,
    triangles: HashSet<u64>,
    unhashed: Vec<(Draw, u64)>,
}

impl Surfaces {
    /// Takes note of a draw: hash of its positions, hash of its transform.
    pub fn add(&mut self, draw: &Draw, positions: u64, transform: u64) {
        self.draws.insert((positions, transform));
        self.unhashed.push((*draw, transform));
    }

    /// Whether exactly these positions were drawn under the same transform.
    pub fn has_draw(&self, positions: u64, transform: u64) -> bool {
        self.draws.contains(&(positions, transform))
    }

    /// Whether most triangles of a draw were drawn before, in whatever batches.
    pub fn has_triangles(&mut self, frame: &Frame, draw: &Draw, transform: u64) -> bool {
        for (earlier, its_transform) in std::mem::take(&mut self.unhashed) {
            let count = earlier.index_count as usize / 3;
            let keys = triangle_keys(frame, &earlier, its_transform, &self.hasher, count);
            self.triangles.extend(keys);
        }
        let (mut known, mut tried) = (0, 0);
        for key in triangle_keys(frame, draw, transform, &self.hasher, 16) {
            known += usize::from(self.triangles.contains(&key));
            tried += 1;
        }
        known * 2 > tried
    }
}

/// Keys of up to `count` triangles of a draw, spread over it: positions turned so that the smallest is first.
fn triangle_keys<'a>(
    frame: &'a Frame,
    draw: &Draw,
    transform: u64,
    hasher: &'a DefaultHashBuilder,
    count: usize,
) -> impl Iterator<Item = u64> + 'a {
    let triangles = draw.index_count as usize / 3;
    let count = count.min(triangles);
    Attribute::of(frame, draw, Slot::Position as usize)
        .into_iter()
        .flat_map(move |p| (0..count).map(move |i| (p, 3 * (i * triangles / count))))
        .filter_map(move |(p, i)| {
            let mut corners = [p.get(i)?, p.get(i + 1)?, p.get(i + 2)?]
                .map(|corner| (corner + Vec4::ZERO).to_array().map(f32::to_bits));
            let smallest = (0..3).min_by_key(|&k| corners[k])?;
            corners.rotate_left(smallest);
            let mut state = hasher.build_hasher();
            state.write_u64(transform);
            state.write(bytemuck::cast_slice(&corners));
            Some(state.finish())
        })
}
