//! Whole frames, built by hand, and what is understood of them.

mod camera;
mod classes;
mod layers;
mod lights;
mod profile;
mod robustness;
