//! Errors of single pixels, averaged: RMSE, relMSE, PSNR, ratio of luminance.
//!
//! The numbers are compared as they are stored; bring pictures to one encoding first ([`crate::compare`] does). Sums are `f64`
//! and in pixel order, so results repeat bit for bit. A NaN or infinite pixel makes the result NaN or infinite.

use crate::error::MetricsError;
use crate::image::Image;

/// Added to the squared reference in [`relmse`], so that black pixels do not divide by zero. A linear value of 0.1 is where
/// relMSE turns from relative to absolute.
pub const RELMSE_EPSILON: f64 = 1e-2;

/// Root of the mean over pixels and channels of (a - b)^2, in the pictures' unit.
///
/// # Errors
/// If the sizes differ.
pub fn rmse(a: &Image, b: &Image) -> Result<f64, MetricsError> {
    Ok(mean_over_channels(a, b, |a, b| (a - b) * (a - b))?.sqrt())
}

/// Mean over pixels and channels of (a - b)^2 / (b^2 + [`RELMSE_EPSILON`]), b being the reference.
///
/// # Errors
/// If the sizes differ.
pub fn relmse(a: &Image, b: &Image) -> Result<f64, MetricsError> {
    mean_over_channels(a, b, |a, b| (a - b) * (a - b) / (b * b + RELMSE_EPSILON))
}

/// Peak signal-to-noise ratio in dB for a peak of 1, so for display values; infinite where the pictures are equal.
///
/// # Errors
/// If the sizes differ.
pub fn psnr(a: &Image, b: &Image) -> Result<f64, MetricsError> {
    Ok(-20.0 * rmse(a, b)?.log10())
}

/// Mean luminance of `a` over that of `b`, both taken as linear light; NaN or infinite if `b` is black.
///
/// # Errors
/// If the sizes differ.
pub fn luminance_ratio(a: &Image, b: &Image) -> Result<f64, MetricsError> {
    b.expect_same_size(a, "the picture")?;
    let sum = |image: &Image| image.luminances().iter().sum::<f64>();
    Ok(sum(a) / sum(b))
}

fn mean_over_channels(a: &Image, b: &Image, error: impl Fn(f64, f64) -> f64) -> Result<f64, MetricsError> {
    b.expect_same_size(a, "the picture")?;
    let pairs = a.pixels().iter().flatten().zip(b.pixels().iter().flatten());
    let sum: f64 = pairs.map(|(&a, &b)| error(f64::from(a), f64::from(b))).sum();
    Ok(sum / (3 * a.pixels().len()) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Encoding;

    fn image(pixels: Vec<[f32; 3]>) -> Image {
        Image::new(pixels.len(), 1, Encoding::Linear, pixels).unwrap()
    }

    #[test]
    fn closed_forms() {
        let a = image(vec![[1.0, 0.5, 0.0], [0.0; 3]]);
        let b = image(vec![[0.5, 0.5, 0.0], [0.0, 0.0, 1.0]]);
        assert!((rmse(&a, &b).unwrap() - (1.25f64 / 6.0).sqrt()).abs() < 1e-12);
        let expected = (0.25 / 0.26 + 1.0 / 1.01) / 6.0;
        assert!((relmse(&a, &b).unwrap() - expected).abs() < 1e-12);
        assert!((psnr(&a, &b).unwrap() - 10.0 * (6.0f64 / 1.25).log10()).abs() < 1e-9);
        let expected = (0.2126 + 0.5 * 0.7152) / (0.5 * (0.2126 + 0.7152) + 0.0722);
        assert!((luminance_ratio(&a, &b).unwrap() - expected).abs() < 1e-9);
    }

    #[test]
    fn equal_pictures_have_no_error() {
        let a = image(vec![[0.25; 3]; 4]);
        assert_eq!(rmse(&a, &a).unwrap(), 0.0);
        assert_eq!(psnr(&a, &a).unwrap(), f64::INFINITY);
        assert_eq!(luminance_ratio(&a, &a).unwrap(), 1.0);
    }

    #[test]
    fn one_nan_is_not_averaged_away() {
        let a = image(vec![[0.0; 3], [0.0, f32::NAN, 0.0]]);
        let b = image(vec![[0.0; 3]; 2]);
        assert!(rmse(&a, &b).unwrap().is_nan());
        assert!(relmse(&a, &b).unwrap().is_nan());
    }

    #[test]
    fn sizes_must_agree() {
        let (a, b) = (image(vec![[0.0; 3]; 2]), image(vec![[0.0; 3]; 3]));
        assert!(matches!(rmse(&a, &b), Err(MetricsError::SizeMismatch { got_width: 2, .. })));
    }
}
