//! Scenes made in code, and what the whole renderer makes of them: for tests against closed forms, and at the ends of what
//! numbers can be.
//!
//! A [`World`] becomes a scene file in memory; [`reference`](fn@reference) and [`pathtrace`] draw it on the device of all tests, whose
//! validation layer must stay silent. With `AFTERGLOW_EXTREMES_BACKEND=hardware` the driver's structures are gone through. A [`Picture`] has the mean and standard error of each pixel, and the counters.

#![allow(clippy::unwrap_used, reason = "all of this is for tests")]

mod picture;
mod shapes;
mod shot;
mod world;

pub use picture::{Estimate, Picture};
pub use shapes::{cube, icosphere, quad};
pub use shot::{Shot, backend, pathtrace, reference, staged};
pub use world::{World, lambert, metal, shining};
