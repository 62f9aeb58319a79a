//! Whole frames, built by hand, and what is understood of them.

mod camera;
mod classes;
mod hints;
mod layers;
mod lights;
mod memory;
mod motion;
mod profile;
mod robustness;
mod scale;
