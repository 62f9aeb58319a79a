//! Rays through the static world.

use crate::rays::{Ray, Shapes};
use crate::types::{Baked, Sky};
use afterglow_bvh::{Quality, build_blas};
use glam::Vec3;
use std::cell::Cell;

/// The occluders and the sky's surfaces, ready for rays.
pub(crate) struct World {
    shapes: Shapes,
    /// Primitives from this number on are sky.
    first_sky: u32,
    has_sky: bool,
    open: bool,
    /// Length of the diagonal of what lies in the world.
    pub size: f32,
    rays: Cell<u64>,
}

/// What a ray meets.
pub(crate) enum Met {
    /// The sky.
    Sky,
    /// A surface, in lengths of the direction.
    Surface(f32),
    /// Nothing, where that is not sky.
    Nothing,
}

impl World {
    /// None where there are more triangles than a structure holds.
    pub fn new(baked: &Baked, size: f32) -> Option<Self> {
        let sky = if let Sky::Surfaces(triangles) = baked.sky { triangles } else { &[] };
        let corners = baked.triangles.iter().chain(sky).flatten();
        let positions: Vec<[f32; 3]> = corners.map(Vec3::to_array).collect();
        let count = u32::try_from(positions.len() / 3).ok().filter(|&count| count < u32::MAX / 3)?;
        let indices: Vec<[u32; 3]> = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let blas = build_blas(&positions, &indices, Quality::Good).ok()?;
        Some(Self {
            shapes: Shapes::new(&blas),
            first_sky: baked.triangles.len() as u32,
            has_sky: baked.sky == Sky::Open || !sky.is_empty(),
            open: baked.sky == Sky::Open,
            size,
            rays: Cell::new(0),
        })
    }

    /// How many rays were traced.
    pub fn rays(&self) -> u64 {
        self.rays.get()
    }

    /// How far off its surface a ray starts.
    pub fn offset(&self) -> f32 {
        self.size * 2e-5
    }

    /// The sky can be seen somewhere.
    pub fn has_sky(&self) -> bool {
        self.has_sky
    }

    /// Nothing lies between the two points.
    pub fn visible(&self, from: Vec3, to: Vec3) -> bool {
        let ray = Ray { origin: from, direction: to - from, t_max: 0.9999 };
        self.trace(&ray, true).is_none()
    }

    /// What a ray of any length meets first.
    pub fn first(&self, origin: Vec3, direction: Vec3) -> Met {
        let ray = Ray { origin, direction, t_max: f32::INFINITY };
        match self.trace(&ray, false) {
            Some((_, primitive)) if primitive >= self.first_sky => Met::Sky,
            Some((t, _)) => Met::Surface(t),
            None if self.open => Met::Sky,
            None => Met::Nothing,
        }
    }

    /// The sky is seen along this direction.
    pub fn sees_sky(&self, origin: Vec3, direction: Vec3) -> bool {
        if self.open {
            let ray = Ray { origin, direction, t_max: f32::INFINITY };
            return self.trace(&ray, true).is_none();
        }
        matches!(self.first(origin, direction), Met::Sky)
    }

    fn trace(&self, ray: &Ray, any_hit: bool) -> Option<(f32, u32)> {
        self.rays.set(self.rays.get() + 1);
        self.shapes.trace(ray, any_hit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_sky_is_seen_as_sky() {
        let square = |z: f32| [Vec3::new(-9.0, -9.0, z), Vec3::new(9.0, -9.0, z), Vec3::new(0.0, 9.0, z)];
        let (wall, sky) = ([square(1.0)], [square(-1.0)]);
        let world =
            |sky| World::new(&Baked { triangles: &wall, patches: &[], emitters: &[], sky }, 10.0).unwrap();
        let seen = |world: &World| [Vec3::Z, Vec3::NEG_Z, Vec3::X].map(|way| world.sees_sky(Vec3::ZERO, way));
        assert_eq!(seen(&world(Sky::Surfaces(&sky))), [false, true, false]);
        assert_eq!(seen(&world(Sky::Open)), [false, true, true]);
        assert_eq!(seen(&world(Sky::None)), [false; 3]);
        assert!(matches!(world(Sky::None).first(Vec3::ZERO, Vec3::Z * 0.5), Met::Surface(t) if t == 2.0));
        assert!(!world(Sky::None).visible(Vec3::ZERO, Vec3::Z * 2.0));
        assert!(world(Sky::None).visible(Vec3::ZERO, Vec3::X * 2.0));
    }
}
