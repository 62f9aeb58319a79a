//! Scene understanding: draws in; camera, world, lights and the reason for each out.
//!
//! This is the first cut: the camera is the commonest modelview matrix, classes follow from the state of
//! a single frame. The types are those that the whole of scene recovery will fill.

mod baked;
mod classify;
mod color;
mod consensus;
mod content;
mod draws;
mod formers;
mod geometry;
mod hints;
mod images;
mod lights;
mod matrix;
mod objects;
mod opacity;
mod profile;
mod recovery;
mod shapes;
mod sky;
mod surfaces;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod tracking;
mod types;
mod views;
mod world;

pub use images::ImageFacts;
pub use profile::{Profile, ProfileChoice, ProfileError, shipped as shipped_profiles};
pub use recovery::Recovery;
pub use types::*;
