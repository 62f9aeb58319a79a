//! The two-level bounding volume hierarchy of the software ray tracer: builders on the CPU, the
//! format that shaders read (`shaders/include/bvh.glsl`), and a reference traversal over the same
//! words.
//!
//! Triangles → [`build_blas`] → [`Blas`], copied to the device; instances that name the addresses →
//! [`build_tlas`] → [`Tlas`]. One node format serves both: four-wide, boxes in f32.

mod binary;
mod blas;
mod bounds;
mod collapse;
mod encode;
mod error;
pub mod intersect;
pub mod layout;
mod optimise;
mod refit;
pub mod room;
mod split;
mod tlas;
pub mod traverse;

#[cfg(test)]
mod testing;

pub use blas::{Blas, BlasInput, Quality, TriangleAttributes, build_blas, build_blas_with};
pub use bounds::Aabb;
pub use error::BuildError;
pub use refit::Levels;
pub use tlas::{IDENTITY, Instance, Tlas, build_tlas};
pub use traverse::{Hit, Query, Ray, Scene, trace};
