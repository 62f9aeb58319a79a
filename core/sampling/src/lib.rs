//! What path tracing samples: directions, BSDFs, lights, tables.
//!
//! Most of it is the twin of GLSL under `shaders/include/pathtrace`: the same names, the same operations in the same order,
//! so that what is proved of one by closed forms holds for the other (`tests/gpu.rs` compares them on a device). Everything is
//! `f32` for that reason; closed forms in the tests are `f64`.
//!
//! Directions are unit vectors. Densities are per steradian. Random numbers are in [0, 1), multiples of 2^-24
//! ([`random`]). Lengths are the world's; radiance is linear RGB in any unit.
//!
//! ```
//! use afterglow_sampling::bsdf::{Bsdf, sample_bsdf};
//! use afterglow_sampling::microfacet::alpha_of;
//! use afterglow_sampling::random::independent;
//! use glam::Vec3;
//!
//! // A rough mirror seen head-on reflects at most what arrives.
//! let bsdf = Bsdf { diffuse: Vec3::ZERO, specular: Vec3::ONE, alpha: alpha_of(0.3) };
//! let random = independent(0, 0, 0, 0);
//! let sample = sample_bsdf(&bsdf, Vec3::Z, random.x, random.truncate().truncate());
//! assert!(sample.weight.max_element() <= 1.0);
//! ```

pub mod alias;
pub mod bsdf;
pub mod caps;
pub mod color;
pub mod directions;
pub mod falloff;
pub mod finite;
pub mod heuristics;
pub mod lights;
pub mod microfacet;
pub mod random;
pub mod spherical_harmonics;

#[cfg(test)]
mod testing;
