//! Frames built by hand, and what they must look like.

mod backends;
mod clears;
mod cones;
mod fragments;
mod hints;
mod images;
mod lighting;
mod pathtrace;
mod pixels;
mod primitives;
mod relit;
mod replies;
mod scale;
mod sky;
mod textures;
