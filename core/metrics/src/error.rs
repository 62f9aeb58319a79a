//! Everything that can go wrong while reading, writing or comparing pictures.

use std::path::PathBuf;

use afterglow_npy::NpyError;
use thiserror::Error;

use crate::image::{MAX_PIXELS, MAX_SIDE};

/// Errors of this crate.
#[derive(Debug, Error)]
pub enum MetricsError {
    #[error("cannot read {}: {source}", path.display())]
    Load { path: PathBuf, source: FormatError },
    #[error("cannot be written: {source}")]
    Save { path: PathBuf, source: FormatError },
    #[error("{what} is {got_width}x{got_height} pixels, not {width}x{height}")]
    SizeMismatch { what: &'static str, width: usize, height: usize, got_width: usize, got_height: usize },
    #[error(transparent)]
    Format(#[from] FormatError),
    #[error("SSIM needs at least 11x11 pixels, not {width}x{height}")]
    TooSmallForSsim { width: usize, height: usize },
    #[error("a picture with NaN or infinite pixels has no SSIM")]
    NonFinite,
    #[error("standard errors are of linear pictures; here a picture is sRGB-encoded")]
    StandardErrorOfEncoded,
    #[error("no pictures to join")]
    NothingToJoin,
    #[error(transparent)]
    Golden(#[from] GoldenFailure),
}

/// What is wrong with one file or with a buffer of pixels.
#[derive(Debug, Error)]
pub enum FormatError {
    #[error(transparent)]
    Io(#[from] std::io::Error),
    #[error("PNG: {0}")]
    Png(#[from] image::ImageError),
    #[error("EXR: {0}")]
    Exr(#[from] exr::error::Error),
    #[error("npy: {0}")]
    Npy(#[from] NpyError),
    #[error("unknown extension (png, exr, npy and npz:ARRAY are known)")]
    UnknownExtension,
    #[error(
        "a picture of {width}x{height} pixels is refused (at most {MAX_SIDE} a side and {MAX_PIXELS} in all)"
    )]
    TooLarge { width: usize, height: usize },
    #[error("a picture of {width}x{height} pixels is empty")]
    Empty { width: usize, height: usize },
    #[error("{got} pixels given for a picture of {width}x{height}")]
    PixelCount { width: usize, height: usize, got: usize },
}

/// Why a picture is not its golden; the paths say where to look.
#[derive(Debug, Error)]
pub enum GoldenFailure {
    #[error(
        "no golden at {}; the picture is {}; set {}=1 to make it the golden",
        golden.display(), actual.display(), crate::golden::BLESS_VARIABLE
    )]
    Missing { golden: PathBuf, actual: PathBuf },
    #[error("{} pixels are NaN or infinite in {}", count, actual.display())]
    NonFinite { count: u64, actual: PathBuf },
    #[error(
        "the picture is {}x{} pixels and its golden {}x{}; see {} and {}",
        actual_size.0, actual_size.1, expected_size.0, expected_size.1, actual.display(), expected.display()
    )]
    Size { actual_size: (usize, usize), expected_size: (usize, usize), actual: PathBuf, expected: PathBuf },
    #[error(
        "mean FLIP {mean_flip:.5} is above {threshold} (worst pixel {max_flip:.3}); see {}, {} and {}",
        actual.display(), expected.display(), difference.display()
    )]
    Differs {
        mean_flip: f64,
        max_flip: f64,
        threshold: f64,
        actual: PathBuf,
        expected: PathBuf,
        difference: PathBuf,
    },
}
