//! Scene understanding: draws in; camera, world, lights and the reason for each out.
//!
//! Draws are cut into what belongs together (`shapes`), paired with the objects that are known (`tracking`), and
//! what most of the world agrees on is the camera (`consensus`); classes follow from what objects did and from the
//! state of their draws (`classify`). `ARCHITECTURE.md` has the whole of it.

mod alpha;
mod baked;
mod classify;
mod color;
mod consensus;
mod content;
mod deform;
mod draws;
mod foresight;
mod former;
mod formers;
mod geometry;
mod hints;
mod images;
mod lights;
mod matrix;
mod memory;
mod objects;
mod opacity;
mod pairing;
mod phase;
mod profile;
mod program_cache;
mod recovery;
mod shapes;
mod shown;
mod sky;
mod stretches;
mod surfaces;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod tracking;
mod types;
mod views;
mod world;

pub use color::{linear_from_srgb, srgb_from_linear};
pub use images::ImageFacts;
pub use phase::Phase;
pub use profile::{Profile, ProfileChoice, ProfileError, shipped as shipped_profiles};
pub use program_cache::ProgramCache;
pub use recovery::Recovery;
pub use types::*;
