//! What the triangles of a draw are, whatever matrix they meet: keys by which they are known again.
//!
//! A triangle's *position key* is of its object-space positions, turned so that the smallest comes first; its *topology
//! key* of texture coordinates and of how its indices differ, without positions: what stays when an animated mesh
//! moves. Sums of these over a draw do not depend on order. Content is hashed once while it stays what it is.

use std::sync::{Arc, OnceLock};

use afterglow_gl::frame::{Draw, Frame, Slot, VertexSource};
use glam::{Vec3, Vec4};
use hashbrown::HashMap;
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use crate::geometry::{Attribute, mix, mix_pairs, pairs, sample_positions};

/// Positions that stand for a draw's when it is seen under matrices.
pub const SAMPLES: usize = 8;
/// Positions that are spread over triangles, at most.
const MOST_SPREAD: usize = 2048;
/// Frames that content of the frame's own memory is remembered after it was drawn last.
const KEPT: u32 = 8;

/// Keys and extent of some triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Content {
    /// Sum of the position keys.
    pub positions: u64,
    /// Sum of the topology keys.
    pub topology: u64,
    /// Number of triangles.
    pub triangles: u32,
    /// Middle of the box around them, object space.
    pub centre: Vec3,
    /// Diagonal of that box.
    pub extent: f32,
    /// Vertices: the outermost along each axis, and two more.
    pub samples: [Vec3; SAMPLES],
    /// Position key of each triangle; none for retained ranges, which are known as a whole.
    pub keys: Box<[u64]>,
    /// Positions spread evenly over the triangles, once somebody has asked for them.
    spread: OnceLock<Box<[Vec3]>>,
}

impl Content {
    /// The content of `count` triangles of a draw from triangle `first` on; nothing without positions in reach.
    pub fn of(frame: &Frame, draw: &Draw, first: u32, count: u32) -> Option<Content> {
        let positions = Attribute::of(frame, draw, Slot::Position as usize)?;
        let coordinates = Attribute::of(frame, draw, Slot::Texture0 as usize);
        let is_retained = matches!(draw.source, VertexSource::Retained { .. });
        let (_, indices) = frame.geometry(draw);
        let count = count.min((indices.len() as u32 / 3).saturating_sub(first));
        let mut keys = Vec::with_capacity(if is_retained { 0 } else { count as usize });
        let (mut sum, mut topology) = (0u64, 0u64);
        let mut outermost = Outermost::default();
        for triangle in first..first + count {
            let at = 3 * triangle as usize;
            let corner = |k: usize| positions.get(at + k).unwrap_or(Vec4::NAN);
            let corners = [corner(0), corner(1), corner(2)];
            let key = triangle_key(corners);
            sum = sum.wrapping_add(key);
            topology = topology.wrapping_add(topology_key(&indices[at..at + 3], coordinates, at));
            if !is_retained {
                keys.push(key);
            }
            corners.into_iter().for_each(|corner| outermost.add(affine(corner)));
        }
        let middle = (first + count / 2) as usize * 3;
        let others = [3 * first as usize, middle].map(|i| positions.get(i).map_or(Vec3::NAN, affine));
        let (centre, extent, samples) = outermost.finish(others)?;
        let keys = keys.into();
        let spread = OnceLock::new();
        Some(Content { positions: sum, topology, triangles: count, centre, extent, samples, keys, spread })
    }

    /// Positions spread evenly over the triangles, object space, more of them where there are more triangles. `draw` draws
    /// exactly these.
    pub fn spread(&self, frame: &Frame, draw: &Draw) -> &[Vec3] {
        self.spread.get_or_init(|| sample_positions(frame, draw, spread_of(draw)).collect())
    }

    /// Middle of a ball about the triangles, object space, and its radius squared.
    pub fn ball(&self) -> (Vec3, f32) {
        let radius = 0.51 * self.extent;
        (self.centre, radius * radius)
    }
}

/// How many positions stand for a draw's where it matters how far it reaches.
pub fn spread_of(draw: &Draw) -> usize {
    8 + (draw.index_count as usize / 64).min(MOST_SPREAD)
}

/// A homogeneous position as a point; not a number at infinity.
pub fn affine(position: Vec4) -> Vec3 {
    if position.w == 1.0 { position.truncate() } else { position.truncate() / position.w }
}

/// Key of a triangle's positions, turned so that the smallest is first; a reflected one has another.
pub fn triangle_key(corners: [Vec4; 3]) -> u64 {
    // Compared and mixed as pairs of coordinates.
    let [a, b, c] = corners.map(pairs);
    let (first, second, third) = match (b < a, c < a, c < b) {
        (true, _, false) => (b, c, a),
        (true, _, true) | (false, true, _) => (c, a, b),
        (false, false, _) => (a, b, c),
    };
    scatter(mix_pairs(mix_pairs(mix_pairs(3, first), second), third))
}

fn topology_key(indices: &[u32], coordinates: Option<Attribute>, at: usize) -> u64 {
    let steps = [indices[1].wrapping_sub(indices[0]), indices[2].wrapping_sub(indices[0])];
    let start = u64::from(steps[0]) << 32 | u64::from(steps[1]);
    let corners = coordinates.into_iter().flat_map(|c| (0..3).filter_map(move |k| c.get(at + k)));
    scatter(corners.fold(start, mix))
}

/// Spreads a hash over all bits, so that sums of hashes are hashes.
fn scatter(hash: u64) -> u64 {
    let folded = (hash ^ (hash >> 32)).wrapping_mul(0x9fb2_1c65_1e98_df25);
    (folded ^ (folded >> 29)).wrapping_mul(0xd6e8_feb8_6659_fd93) ^ (folded >> 32)
}

/// The outermost of points along each axis.
struct Outermost {
    least: Vec3,
    most: Vec3,
    points: [Vec3; 6],
}

impl Default for Outermost {
    fn default() -> Outermost {
        Outermost { least: Vec3::INFINITY, most: Vec3::NEG_INFINITY, points: [Vec3::ZERO; 6] }
    }
}

impl Outermost {
    fn add(&mut self, point: Vec3) {
        // A point that is not a number is neither less nor greater.
        if point.cmplt(self.least).any() || point.cmpgt(self.most).any() {
            if !point.is_finite() {
                return;
            }
            for axis in 0..3 {
                if point[axis] < self.least[axis] {
                    self.points[axis] = point;
                }
                if point[axis] > self.most[axis] {
                    self.points[3 + axis] = point;
                }
            }
            self.least = self.least.min(point);
            self.most = self.most.max(point);
        }
    }

    /// Middle, extent and samples; nothing without a point.
    fn finish(self, others: [Vec3; 2]) -> Option<(Vec3, f32, [Vec3; SAMPLES])> {
        let centre = 0.5 * self.least + 0.5 * self.most;
        let extent = (self.most - self.least).length();
        let mut samples = [centre; SAMPLES];
        samples[..6].copy_from_slice(&self.points);
        for (sample, other) in samples[6..].iter_mut().zip(others) {
            *sample = if other.is_finite() { other } else { self.points[0] };
        }
        (centre.is_finite() && extent.is_finite()).then_some((centre, extent, samples))
    }
}

/// Content that was seen in the last frames, by a hash of its bytes.
#[derive(Debug, Default)]
pub struct Contents {
    known: HashMap<u64, Kept>,
    frame: u32,
}

#[derive(Debug)]
struct Kept {
    content: Option<Arc<Content>>,
    first: u32,
    last: u32,
}

/// Content as it is found.
#[derive(Debug, Clone)]
pub struct Found {
    /// Hash of its bytes.
    pub bytes: u64,
    /// The content.
    pub content: Arc<Content>,
    /// Frames since it was first seen.
    pub age: u32,
}

impl Contents {
    /// A frame begins.
    pub fn next_frame(&mut self) {
        self.frame = self.frame.wrapping_add(1);
        if self.frame.is_multiple_of(KEPT) {
            let frame = self.frame;
            self.known.retain(|_, kept| {
                let is_retained = kept.content.as_ref().is_some_and(|content| content.keys.is_empty());
                frame.wrapping_sub(kept.last) < if is_retained { 64 * KEPT } else { KEPT }
            });
        }
    }

    /// The content of a whole draw.
    pub fn of(&mut self, frame: &Frame, draw: &Draw) -> Option<Found> {
        let bytes = content_hash(frame, draw)?;
        let now = self.frame;
        let kept = self.known.entry(bytes).or_insert_with(|| Kept {
            content: Content::of(frame, draw, 0, u32::MAX).map(Arc::new),
            first: now,
            last: now,
        });
        kept.last = now;
        let content = kept.content.clone()?;
        Some(Found { bytes, content, age: now.wrapping_sub(kept.first) })
    }
}

/// Hash of what a draw of a range that outlives the frame sends; nothing for others.
pub fn retained_hash(frame: &Frame, draw: &Draw) -> Option<u64> {
    match draw.source {
        VertexSource::Retained { .. } => content_hash(frame, draw),
        VertexSource::Arena { .. } => None,
    }
}

/// Hash of part of what a draw sends.
pub fn part_hash(bytes: u64, first: u32, count: u32) -> u64 {
    xxh3_64(bytemuck::bytes_of(&[bytes, u64::from(first) << 32 | u64::from(count)]))
}

/// Hash of what a draw sends; nothing where its numbers lead out of the frame.
fn content_hash(frame: &Frame, draw: &Draw) -> Option<u64> {
    let part = match draw.source {
        VertexSource::Retained { range, first_index } => {
            let hash = frame.retained.get(range as usize)?.content_hash();
            return Some(xxh3_64(bytemuck::bytes_of(&[
                hash,
                u64::from(first_index) << 32 | u64::from(draw.index_count),
            ])));
        }
        VertexSource::Arena { .. } => frame.geometry(draw),
    };
    let (words, indices) = part;
    let mut hasher = Xxh3::new();
    hasher.update(bytemuck::bytes_of(&draw.layout.0));
    hasher.update(bytemuck::cast_slice(words));
    hasher.update(bytemuck::cast_slice(indices));
    Some(hasher.digest())
}

/// Corners of some triangles of a draw, object space.
pub fn corners(frame: &Frame, draw: &Draw) -> Vec<Vec3> {
    let positions = Attribute::of(frame, draw, Slot::Position as usize);
    let corner = |i: usize| positions.and_then(|p| p.get(i)).map_or(Vec3::NAN, affine);
    (0..draw.index_count as usize).map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Sketch, floor, thing};

    fn content(corners: &[Vec3]) -> Content {
        let mut sketch = Sketch::new();
        sketch.draw(corners);
        let (_, draw) = sketch.frame.draws().next().unwrap();
        Content::of(&sketch.frame, draw, 0, u32::MAX).unwrap()
    }

    #[test]
    fn a_triangle_is_the_same_from_any_corner_but_not_from_behind() {
        let [a, b, c] = [Vec4::new(1., 0., -0., 1.), Vec4::new(0., 2., 0., 1.), Vec4::new(3., 3., 3., 1.)];
        assert_eq!(triangle_key([a, b, c]), triangle_key([c, a, b]));
        assert_eq!(triangle_key([a, b, c]), triangle_key([b, c, Vec4::new(1., 0., 0., 1.)]));
        assert_ne!(triangle_key([a, b, c]), triangle_key([a, c, b]));
    }

    #[test]
    fn order_does_not_matter_positions_do() {
        let corners = floor();
        let mut turned: Vec<Vec3> = corners.clone();
        turned.rotate_left(9);
        assert_eq!(content(&corners).positions, content(&turned).positions);
        turned[0].x += 1e-3;
        assert_ne!(content(&corners).positions, content(&turned).positions);
        assert_eq!(content(&corners).topology, content(&turned).topology);
    }

    #[test]
    fn samples_are_the_outermost_vertices() {
        let found = content(&thing(2.0));
        assert_eq!(found.centre, Vec3::new(0.0, 0.0, 1.0));
        assert!(found.samples.iter().all(|s| s.length() == 2.0), "{:?}", found.samples);
        assert_eq!(found.triangles, 3);
    }

    #[test]
    fn what_is_not_a_number_has_no_extent() {
        let mut sketch = Sketch::new();
        sketch.draw(&[Vec3::NAN, Vec3::INFINITY, Vec3::NAN]);
        let (_, draw) = sketch.frame.draws().next().unwrap();
        assert_eq!(Content::of(&sketch.frame, draw, 0, 9), None);
    }

    #[test]
    fn the_same_bytes_are_hashed_once() {
        let mut sketch = Sketch::new();
        sketch.world();
        let (_, draw) = sketch.frame.draws().next().unwrap();
        let mut contents = Contents::default();
        let mut found = || contents.of(&sketch.frame, draw).unwrap().content;
        assert!(Arc::ptr_eq(&found(), &found()));
    }
}
