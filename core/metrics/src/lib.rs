//! Image metrics: how far a picture is from the one it should be.
//!
//! [`compare`] gives every number at once; [`golden::check`] holds a picture against a stored one; the metrics are also there
//! one by one. Pictures are [`Image`]s, read and written by [`io`]. Where a function takes two pictures, the first is the one
//! judged and the second the reference.

pub mod blocks;
pub mod colour;
mod compare;
mod convolve;
mod error;
pub mod flip;
pub mod golden;
mod image;
pub mod io;
mod magma;
mod noise;
pub mod pixelwise;
mod side_by_side;
mod ssim;
#[cfg(test)]
mod test_images;

pub use blocks::{BlockReport, combine_standard_errors};
pub use compare::{Comparison, compare, compare_noisy};
pub use error::{FormatError, GoldenFailure, MetricsError};
pub use flip::{FlipMap, flip, flip_hdr, flip_ldr};
pub use image::{Encoding, Image, MAX_PIXELS, MAX_SIDE};
pub use noise::Noise;
pub use side_by_side::side_by_side;
pub use ssim::ssim;
