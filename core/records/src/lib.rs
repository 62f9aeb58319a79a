//! Structures that the renderer writes and shaders read, beside those that a frame itself holds.
//!
//! They are a crate of their own, without any device, because the generator of the GLSL declarations
//! must not depend on the shaders that include what it writes.

mod denoise;
mod kinds;
mod pathtrace;
mod raster;

pub use denoise::*;
pub use kinds::*;
pub use pathtrace::*;
pub use raster::*;
