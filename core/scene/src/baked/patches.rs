//! The lit surfaces of a world in patches, and all that sources are searched in.
//!
//! Patches are cells of a grid in the plane of a surface. A cell is sampled at some places of each triangle in it, so that
//! it does not matter how the world is cut into triangles.

use std::collections::BTreeMap;
use std::sync::Arc;

use afterglow_gl::frame::ImageKey;
use afterglow_relight::Patch;
use glam::{Vec2, Vec3};
use hashbrown::{HashMap, HashSet};

use super::emitters::emitters;
use super::lightmap::Lightmaps;
use super::relit::Bakes;
use super::search::Problem;
use super::surfaces::{Map, Triangle, World};
use super::texels::{Image, Texels};
use crate::color::linear_from_srgb;
use crate::images::Images;

/// About how many patches a world is cut into.
const PATCHES: f32 = 2500.0;
/// Patches that are looked at, the largest.
const MOST_PATCHES: usize = 3000;
/// Patches below which nothing is searched.
const LEAST_PATCHES: usize = 64;
/// Samples along a patch.
const SAMPLES: f32 = 4.0;
/// Samples along a triangle's box, at most.
const MOST_STEPS: f32 = 100.0;
/// Share of a world's area that must show baked light.
const LEAST_LIT: f32 = 0.5;
/// The same from which on it has lightmaps.
const LEAST_MAPPED: f32 = 0.1;
/// Albedo of surfaces of which nothing is known.
const GREY: f32 = 0.5;

/// Where the light that a triangle shows is baked into.
#[derive(Debug, Clone, Copy)]
pub enum Bake<'a> {
    /// A lightmap.
    Map(&'a Map, &'a Image),
    /// Colours of its corners.
    Colors,
}

impl Bake<'_> {
    /// The light at barycentric coordinates, as the program stored it: compilers of that time computed in linear light and
    /// stored it as it was.
    fn at(&self, triangle: &Triangle, weights: [f32; 3]) -> Vec3 {
        match self {
            Bake::Map(map, image) => {
                let [a, b, c] = map.coordinates;
                let at: Vec2 = a * weights[0] + b * weights[1] + c * weights[2];
                image.sample(at) * map.scale
            }
            Bake::Colors => {
                let [a, b, c] = triangle.colors;
                a * weights[0] + b * weights[1] + c * weights[2]
            }
        }
    }
}

impl World {
    /// The bake of each triangle.
    fn bakes<'a>(&'a self, lightmaps: &Lightmaps, texels: &'a Texels) -> Vec<Option<Bake<'a>>> {
        let by_map = |triangle: &'a Triangle| {
            let map = &triangle.maps[lightmaps.find(triangle).filter(|_| !triangle.is_lit)?];
            Some(Bake::Map(map, texels.get(map.image)?))
        };
        let mut bakes: Vec<Option<Bake>> = self.triangles.iter().map(by_map).collect();
        let area = |bakes: &[Option<Bake>]| -> f32 {
            let lit = self.triangles.iter().zip(bakes).filter(|(_, bake)| bake.is_some());
            lit.map(|(triangle, _)| triangle.area).sum()
        };
        // Among lightmapped surfaces those with colours alone have them for another reason.
        if area(&bakes) < LEAST_MAPPED * self.area {
            for (bake, triangle) in bakes.iter_mut().zip(&self.triangles) {
                if bake.is_none() && triangle.has_colors && !triangle.is_lit {
                    *bake = Some(Bake::Colors);
                }
            }
        }
        bakes
    }

    /// The textures that are lightmaps where they lie, mostly.
    fn lightmaps(&self, bakes: &[Option<Bake>]) -> HashSet<ImageKey> {
        let mut counts: HashMap<ImageKey, u32> = HashMap::new();
        for bake in bakes {
            if let Some(Bake::Map(map, _)) = bake {
                *counts.entry(map.image).or_default() += 1;
            }
        }
        let is_mostly =
            |(key, count): &(ImageKey, u32)| self.uses.get(key).is_some_and(|of| 2 * count > of.triangles);
        counts.into_iter().filter(is_mostly).map(|(key, _)| key).collect()
    }

    /// What sources are to be found in; nothing where the world does not show enough of baked light.
    pub fn problem(&self, texels: &Texels, images: &Images, has_sky: bool) -> Option<Problem> {
        let lightmaps = Lightmaps::of(self, texels);
        let bakes = self.bakes(&lightmaps, texels);
        let lit = || self.triangles.iter().zip(&bakes).filter_map(|(t, bake)| Some((t, (*bake)?)));
        let area: f32 = lit().map(|(triangle, _)| triangle.area).sum();
        if area <= LEAST_LIT * self.area {
            return None;
        }
        let side = (area / PATCHES).sqrt();
        let mut cells = Cells { side, cells: BTreeMap::new() };
        for (triangle, bake) in lit() {
            cells.add(triangle, &bake, albedo(triangle, &bake, images));
        }
        let patches = cells.patches();
        let scale = lit().filter_map(|(_, bake)| match bake {
            Bake::Map(map, _) => Some(map.scale),
            Bake::Colors => None,
        });
        let in_colors = !bakes.iter().any(|bake| matches!(bake, Some(Bake::Map(..))));
        (patches.len() >= LEAST_PATCHES).then(|| Problem {
            bakes: Bakes { lightmaps: Arc::new(self.lightmaps(&bakes)), in_colors },
            triangles: self.triangles.iter().map(|triangle| triangle.corners).collect(),
            emitters: emitters(&self.triangles, &bakes, images, side),
            patches,
            saturation: scale.reduce(f32::max).unwrap_or(1.0),
            has_sky,
        })
    }
}

/// Linear albedo of a triangle: its textures' mean colours, but for the lightmap's.
fn albedo(triangle: &Triangle, bake: &Bake, images: &Images) -> Vec3 {
    let is_light = |map: &Map| matches!(bake, Bake::Map(light, _) if std::ptr::eq(*light, map));
    let mut others = triangle.maps.iter().filter(|map| !is_light(map)).peekable();
    if others.peek().is_none() {
        return Vec3::splat(GREY);
    }
    let mean = |map: &Map| {
        let mean = images.get(map.image).and_then(|image| image.mean()).map_or(Vec3::ONE, |m| m.truncate());
        linear_from_srgb((mean * map.scale).min(Vec3::ONE))
    };
    others.map(mean).product()
}

/// A plane and a cell in it.
type CellKey = ([i32; 3], i32, [i32; 2]);

/// Cells of surfaces.
struct Cells {
    side: f32,
    cells: BTreeMap<CellKey, Sum>,
}

/// Sums over samples, weighted by area.
#[derive(Default)]
struct Sum {
    area: f32,
    position: Vec3,
    normal: Vec3,
    irradiance: Vec3,
    albedo: Vec3,
}

impl Cells {
    fn add(&mut self, triangle: &Triangle, bake: &Bake, albedo: Vec3) {
        let [a, b, c] = triangle.corners;
        let normal = triangle.normal;
        let along = tangents(normal);
        let flat = |p: Vec3| Vec2::new(p.dot(along[0]), p.dot(along[1]));
        let [p, q, r] = [a, b, c].map(flat);
        let (least, most) = (p.min(q).min(r), p.max(q).max(r));
        let step = (self.side / SAMPLES).max((most - least).max_element() / MOST_STEPS);
        let twice_area = (q - p).perp_dot(r - p);
        let weights = |at: Vec2| {
            let v = (at - p).perp_dot(r - p) / twice_area;
            let w = (q - p).perp_dot(at - p) / twice_area;
            [1.0 - v - w, v, w]
        };
        let first = (least / step).floor();
        let count = ((most / step).floor() - first).min(Vec2::splat(MOST_STEPS + 2.0));
        let mut inside: Vec<(Vec2, [f32; 3])> = Vec::new();
        for y in 0..=count.y as u32 {
            for x in 0..=count.x as u32 {
                let at = (first + Vec2::new(x as f32, y as f32) + 0.5) * step;
                let weights = weights(at);
                if weights.iter().all(|&w| w >= 0.0) {
                    inside.push((at, weights));
                }
            }
        }
        if inside.is_empty() {
            inside.push(((p + q + r) / 3.0, [1.0 / 3.0; 3]));
        }
        let share = triangle.area / inside.len() as f32;
        for (at, weights) in inside {
            let position = a * weights[0] + b * weights[1] + c * weights[2];
            let sum = self.cells.entry(self.key(normal, position, at)).or_default();
            sum.area += share;
            sum.position += share * position;
            sum.normal += share * normal;
            sum.irradiance += share * bake.at(triangle, weights);
            sum.albedo += share * albedo;
        }
    }

    fn key(&self, normal: Vec3, position: Vec3, at: Vec2) -> CellKey {
        let cell = (at / self.side).floor();
        let facing = (normal * 6.0).round();
        let height = (normal.dot(position) / (0.5 * self.side)).round();
        (facing.to_array().map(|v| v as i32), height as i32, cell.to_array().map(|v| v as i32))
    }

    fn patches(self) -> Vec<Patch> {
        let least = 0.02 * self.side * self.side;
        let patch = |sum: Sum| Patch {
            position: sum.position / sum.area,
            normal: sum.normal,
            area: sum.area,
            irradiance: sum.irradiance / sum.area,
            albedo: sum.albedo / sum.area,
        };
        let mut patches: Vec<Patch> =
            self.cells.into_values().filter(|sum| sum.area > least).map(patch).collect();
        // Texture coordinates may be anything.
        patches.retain(|patch| patch.irradiance.is_finite() && patch.position.is_finite());
        patches.sort_by(|a, b| b.area.total_cmp(&a.area));
        patches.truncate(MOST_PATCHES);
        patches
    }
}

/// Two unit vectors across a normal, the same for all surfaces that face the same way.
fn tangents(normal: Vec3) -> [Vec3; 2] {
    let along = normal.any_orthonormal_vector();
    [along, normal.cross(along)]
}
