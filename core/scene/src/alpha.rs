//! Where an image is opaque: programs paint windows and bodies of cars into one texture, and blend all of it.

use afterglow_gl::frame::{Draw, Frame, ImageShape, Slot};
use glam::Vec2;

use crate::geometry::Attribute;

/// Blocks along a side of a map, at most.
const BLOCKS: u32 = 64;
/// Least alpha, of 255, that shows nothing of what is behind.
const OPAQUE: u8 = 230;
/// Triangles of a draw that are looked up.
const LOOKED_UP: usize = 64;
/// Share of what a draw shows of an image that must be opaque, 0 to 1.
const ENOUGH: f32 = 0.9;

/// The share of opaque texels by blocks of an image.
#[derive(Debug, Clone, PartialEq)]
pub struct AlphaMap {
    size: [u32; 2],
    /// By rows from t = 0, 0 to 255.
    opaque: Vec<u8>,
}

impl AlphaMap {
    /// The map of an image's texels, all of level 0; nothing unless it has two dimensions.
    pub fn of(shape: &ImageShape, texels: &[u8]) -> Option<AlphaMap> {
        let (width, height) = (shape.width as usize, shape.height as usize);
        if shape.depth != 1 || texels.len() != 4 * width * height || texels.is_empty() {
            return None;
        }
        let size = [shape.width.min(BLOCKS), shape.height.min(BLOCKS)];
        let mut counts = vec![[0u32; 2]; (size[0] * size[1]) as usize];
        for (y, row) in texels.chunks_exact(4 * width).enumerate() {
            let first = (y * size[1] as usize / height) * size[0] as usize;
            for (x, texel) in row.chunks_exact(4).enumerate() {
                let [opaque, all] = &mut counts[first + x * size[0] as usize / width];
                *opaque += u32::from(texel[3] >= OPAQUE);
                *all += 1;
            }
        }
        Some(AlphaMap {
            size,
            opaque: counts.iter().map(|[opaque, all]| (255 * opaque / all) as u8).collect(),
        })
    }

    /// Share of opaque texels about a place, which repeats, 0 to 1.
    fn at(&self, place: Vec2) -> f32 {
        let block = |coordinate: f32, count: u32| {
            let within = coordinate - coordinate.floor();
            ((within * count as f32) as u32).min(count - 1)
        };
        let index = block(place.y, self.size[1]) * self.size[0] + block(place.x, self.size[0]);
        f32::from(self.opaque[index as usize]) / 255.0
    }

    /// Whether what a draw shows of the image by its coordinates of a unit is opaque, but for little.
    pub fn is_opaque_in(&self, frame: &Frame, draw: &Draw, unit: usize) -> bool {
        let slot = Slot::Texture0 as usize + unit;
        let Some(coordinates) = Attribute::of(frame, draw, slot) else { return false };
        let triangles = coordinates.len() / 3;
        let looked_up = triangles.min(LOOKED_UP);
        let (mut sum, mut count) = (0.0, 0.0);
        for k in 0..looked_up {
            let first = 3 * (k * triangles / looked_up);
            let corners =
                [0, 1, 2].map(|i| coordinates.get(first + i).map_or(Vec2::NAN, |c| c.truncate().truncate()));
            let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
            for place in corners.map(|corner| corner.midpoint(centre)).into_iter().chain([centre]) {
                sum += if place.is_finite() { self.at(place) } else { 0.0 };
                count += 1.0;
            }
        }
        count > 0.0 && sum >= ENOUGH * count
    }
}
