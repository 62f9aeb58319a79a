//! Statistics, and rays through triangles.

#![allow(dead_code, reason = "each test takes what it needs")]

#[path = "../../src/testing.rs"]
mod statistics;

use afterglow_bvh::{
    Blas, Hit, IDENTITY, Instance, Quality, Query, Ray, Scene, Tlas, build_blas, build_tlas,
};
// What the statistics draw from.
use afterglow_sampling::random;
use glam::Vec3;

pub use statistics::*;

const ADDRESS: u64 = 16;

/// Triangles that rays meet.
pub struct World {
    blas: Blas,
    tlas: Tlas,
}

impl World {
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let positions: Vec<[f32; 3]> = triangles.as_flattened().iter().map(Vec3::to_array).collect();
        let indices: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|i| [0, 1, 2].map(|c| 3 * i + c)).collect();
        let blas = build_blas(&positions, &indices, Quality::Good).unwrap();
        let bounds = blas.bounds;
        let instance =
            Instance { object_to_world: IDENTITY, blas: ADDRESS, bounds, id: 0, mask: 0xff, flags: 0 };
        Self { tlas: build_tlas(&[instance]).unwrap(), blas }
    }

    /// The nearest triangle further than `t_min`.
    pub fn trace(&self, origin: Vec3, t_min: f32, direction: Vec3) -> Option<Hit> {
        let blas = |address| (address == ADDRESS).then_some(self.blas.words.as_slice());
        let scene = Scene { tlas: &self.tlas.words, blas: &blas };
        let ray = Ray { origin, t_min, direction, t_max: f32::INFINITY };
        afterglow_bvh::trace(&scene, &ray, Query { mask: 1, any_hit: false }, &|_, _, _| true)
    }
}

/// A parallelogram as two triangles that face along `edges[0] x edges[1]`.
pub fn parallelogram(corner: Vec3, edges: [Vec3; 2]) -> [[Vec3; 3]; 2] {
    let [a, b, c, d] = [corner, corner + edges[0], corner + edges[0] + edges[1], corner + edges[1]];
    [[a, b, c], [a, c, d]]
}

/// The cube from 0 to 1, its faces outwards: two triangles each of x = 0, x = 1, y = 0, ...
pub fn cube() -> Vec<[Vec3; 3]> {
    let faces = (0..3).flat_map(|axis| {
        let (u, v) = (Vec3::AXES[(axis + 1) % 3], Vec3::AXES[(axis + 2) % 3]);
        let near = parallelogram(Vec3::ZERO, [v, u]);
        let far = parallelogram(Vec3::AXES[axis], [u, v]);
        near.into_iter().chain(far)
    });
    faces.collect()
}
