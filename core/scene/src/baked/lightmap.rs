//! Which of the textures over a triangle is its lightmap.
//!
//! A lightmap lies on the world without repeating, has few texels on much surface, is smooth, and is shared by surfaces
//! that differ in their other textures. None of these is sure alone: a picture on a wall does not repeat either, and a
//! concrete wall is smooth. So the textures of a triangle are compared two by two, each of the last three votes for
//! one of them or for none, and all votes together must be for the lightmap.

use afterglow_gl::frame::ImageKey;
use hashbrown::HashMap;

use super::surfaces::{Map, Triangle, Use, World};
use super::texels::Texels;

/// Share of a lightmap's triangles on which it may seem to repeat.
const REPEATS: f32 = 0.02;
/// One texture has clearly less of something than another below this ratio.
const CLEARLY: f32 = 0.7;

/// What can be said of a texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// It does not repeat.
    pub is_once: bool,
    /// Texels along a unit of length.
    pub density: f32,
    /// See [`Image::roughness`](super::texels::Image::roughness).
    pub roughness: f32,
    /// Other textures that it lies on.
    pub companions: usize,
}

impl Evidence {
    /// Nothing for images whose texels are not known.
    fn of(image: ImageKey, of: &Use, texels: &Texels) -> Option<Evidence> {
        let image = texels.get(image)?;
        let texels = of.area[0] * image.width as f32 * image.height as f32;
        Some(Evidence {
            is_once: (of.triangles - of.once) as f32 <= REPEATS * of.triangles as f32,
            density: (texels / of.area[1].max(f32::MIN_POSITIVE)).sqrt(),
            roughness: image.roughness(),
            companions: of.companions.len(),
        })
    }

    /// How many kinds of evidence say that this texture is rather a lightmap than `other`, less those that say otherwise.
    fn votes_against(&self, other: &Evidence) -> i32 {
        let less = |a: f32, b: f32| i32::from(a < CLEARLY * b) - i32::from(b < CLEARLY * a);
        let shared = |n: usize| n.min(4) as f32 + 0.5;
        less(self.density, other.density)
            + less(self.roughness, other.roughness)
            + less(shared(other.companions), shared(self.companions))
    }
}

/// What can be said of all textures of a world.
#[derive(Debug, Default)]
pub struct Lightmaps(HashMap<ImageKey, Evidence>);

impl Lightmaps {
    /// Gathers evidence.
    pub fn of(world: &World, texels: &Texels) -> Lightmaps {
        let evidence =
            world.uses.iter().filter_map(|(key, of)| Some((*key, Evidence::of(*key, of, texels)?)));
        Lightmaps(evidence.collect())
    }

    /// The place of a triangle's lightmap among its textures.
    pub fn find(&self, triangle: &Triangle) -> Option<usize> {
        let maps = &triangle.maps;
        let is_lightmap = |candidate: usize| {
            let Some(evidence) = self.0.get(&maps[candidate].image).filter(|e| e.is_once) else {
                return false;
            };
            let others = || maps.iter().enumerate().filter(|(i, _)| *i != candidate).map(|(_, map)| map);
            others().next().is_some() && others().all(|other| self.beats(evidence, &maps[candidate], other))
        };
        (0..maps.len()).find(|&candidate| is_lightmap(candidate))
    }

    fn beats(&self, evidence: &Evidence, map: &Map, other: &Map) -> bool {
        match self.0.get(&other.image) {
            // Too large to be looked at: no lightmap.
            None => true,
            Some(_) if map.image == other.image => false,
            Some(other) if !other.is_once => evidence.votes_against(other) >= 0,
            Some(other) => evidence.votes_against(other) > 0,
        }
    }
}
