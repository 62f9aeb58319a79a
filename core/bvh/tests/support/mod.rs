//! Built worlds and the reference's answer.

use afterglow_bvh::{Blas, Hit, Query, Ray, Tlas};
use std::collections::HashMap;

/// Built structures with the addresses that the top level uses for them.
pub struct World {
    pub tlas: Tlas,
    pub blases: HashMap<u64, Blas>,
}

impl World {
    pub fn trace(&self, ray: &Ray, query: Query) -> Option<Hit> {
        let blas = |address| self.blases.get(&address).map(|blas| blas.words.as_slice());
        let scene = afterglow_bvh::Scene { tlas: &self.tlas.words, blas: &blas };
        afterglow_bvh::trace(&scene, ray, query, &accept)
    }
}

/// The alpha test of these worlds: a hole in one corner, and every third triangle missing.
pub fn accept(instance: u32, primitive: u32, barycentrics: [f32; 2]) -> bool {
    !(instance + primitive).is_multiple_of(3) && barycentrics[0] < 0.7
}
