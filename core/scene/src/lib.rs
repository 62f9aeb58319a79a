//! Scene understanding: draws in; camera, world, lights and the reason for each out.
//!
//! This is the first cut: the camera is the commonest modelview matrix, classes follow from the state of
//! a single frame. The types are those that the whole of scene recovery will fill.

mod classify;
mod color;
mod consensus;
mod content;
mod draws;
mod formers;
mod geometry;
mod images;
mod lights;
mod matrix;
mod memory;
mod objects;
mod opacity;
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

pub use recovery::Recovery;
pub use types::*;
