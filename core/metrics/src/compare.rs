//! All metrics of a pair of pictures at once.

use std::borrow::Cow;

use serde::Serialize;

use crate::blocks::{BlockReport, compare_blocks};
use crate::error::MetricsError;
use crate::flip::flip;
use crate::image::{Encoding, Image};
use crate::noise::Noise;
use crate::pixelwise::{luminance_ratio, psnr, relmse, rmse};
use crate::ssim::ssim;

/// What [`compare`] found. Numbers that do not exist are none (`null` in JSON).
///
/// A NaN or infinite pixel is never averaged with others: it is counted, `relmse`, `rmse`, `psnr`, `ssim` and
/// `luminance_ratio` are then none, FLIP has an error of 1 there, and its block is beyond.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    pub width: usize,
    pub height: usize,
    /// What `relmse` and `rmse` were computed of, and which FLIP: linear light and HDR-FLIP if both pictures are linear, display
    /// values and LDR-FLIP otherwise.
    pub encoding: Encoding,
    /// Pixels of the picture with a channel that is NaN or infinite.
    pub non_finite: u64,
    pub non_finite_reference: u64,
    pub non_finite_standard_error: u64,
    /// Pixels that are not in `relmse`, `rmse`, their floors, `luminance_ratio` and blocks ([`Noise::most_of_reference`]).
    pub left_out: u64,
    /// Mean of (a - b)^2 / (b^2 + 0.01).
    pub relmse: Option<f64>,
    pub rmse: Option<f64>,
    /// Root of the mean square of the standard errors: the `rmse` of a picture without any error.
    pub rmse_floor: Option<f64>,
    /// The part of it that is the reference's.
    pub rmse_floor_reference: Option<f64>,
    /// Of display values, in dB; none also for equal pictures, where it is infinite.
    pub psnr: Option<f64>,
    /// Of display values; none also for pictures below 11 pixels a side.
    pub ssim: Option<f64>,
    /// Mean FLIP error.
    pub flip: f64,
    /// FLIP error of the worst pixel.
    pub flip_max: f32,
    /// Mean luminance over the reference's, of linear light; none also if the reference is black.
    pub luminance_ratio: Option<f64>,
    /// Share of 16x16 blocks whose mean luminance differs by more than 4 standard errors; none without those.
    pub blocks_beyond_4: Option<f64>,
    pub blocks_beyond_6: Option<f64>,
    /// The same in each channel, and where it is worst.
    pub blocks: Option<BlockReport>,
}

impl Comparison {
    /// Whether every pixel of both pictures is a number.
    pub fn all_finite(&self) -> bool {
        self.non_finite == 0 && self.non_finite_reference == 0
    }
}

/// Every metric of `image` against `reference`. `standard_error` is that of their difference, a pixel and channel: the reference's own, or
/// that of both combined ([`crate::combine_standard_errors`]) if the picture has noise too.
///
/// # Errors
/// If sizes differ, or there is a standard error and a picture is not linear.
pub fn compare(
    image: &Image,
    reference: &Image,
    standard_error: Option<&Image>,
) -> Result<Comparison, MetricsError> {
    compare_noisy(image, reference, &Noise { of_picture: standard_error, ..Noise::default() })
}

/// As [`compare`], with what is known of the noise of each.
///
/// # Errors
/// As [`compare`].
pub fn compare_noisy(
    image: &Image,
    reference: &Image,
    noise: &Noise<'_>,
) -> Result<Comparison, MetricsError> {
    reference.expect_same_size(image, "the picture")?;
    let (standard_error, kept) = (noise.combined()?, noise.kept(reference)?);
    let standard_error = standard_error.as_ref();
    let kept = kept.as_deref();
    let blocks = standard_error.map(|error| compare_blocks(image, reference, error, kept)).transpose()?;
    let floor = |error: &Image| if_finite(root_mean_square(&of_kept(error, kept)));
    let flip_map = flip(image, reference)?;
    let (shown, shown_reference) = (image.to_srgb(), reference.to_srgb());
    let both_linear = image.encoding() == Encoding::Linear && reference.encoding() == Encoding::Linear;
    let (a, b) = if both_linear { (image, reference) } else { (&*shown, &*shown_reference) };
    let (non_finite, non_finite_reference) = (image.non_finite_count(), reference.non_finite_count());
    // Finite numbers may come of infinite light: display values clamp it to white, and a ratio over it is 0.
    let all_finite = non_finite + non_finite_reference == 0;
    let sound = |value: f64| if_finite(value).filter(|_| all_finite);
    let (lit, lit_reference) = (of_kept(image, kept), of_kept(reference, kept));
    let (a, b) = (of_kept(a, kept), of_kept(b, kept));
    Ok(Comparison {
        width: image.width(),
        height: image.height(),
        encoding: a.encoding(),
        left_out: kept.map_or(0, |kept| kept.iter().filter(|kept| !**kept).count() as u64),
        non_finite,
        non_finite_reference,
        non_finite_standard_error: standard_error.map_or(0, Image::non_finite_count),
        relmse: sound(relmse(&a, &b)?),
        rmse: sound(rmse(&a, &b)?),
        rmse_floor: standard_error.and_then(floor),
        rmse_floor_reference: noise.of_reference.and_then(floor),
        psnr: sound(psnr(&shown, &shown_reference)?),
        ssim: optional_ssim(&shown, &shown_reference)?.and_then(sound),
        flip: flip_map.mean(),
        flip_max: flip_map.max(),
        luminance_ratio: sound(luminance_ratio(&lit, &lit_reference)?),
        blocks_beyond_4: blocks.as_ref().map(|b| b.beyond_4),
        blocks_beyond_6: blocks.as_ref().map(|b| b.beyond_6),
        blocks,
    })
}

/// A picture without the pixels that are left out.
fn of_kept<'a>(image: &'a Image, kept: Option<&[bool]>) -> Cow<'a, Image> {
    match kept {
        Some(kept) => Cow::Owned(image.only(kept)),
        None => Cow::Borrowed(image),
    }
}

fn if_finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn optional_ssim(a: &Image, b: &Image) -> Result<Option<f64>, MetricsError> {
    match ssim(a, b) {
        Ok(value) => Ok(Some(value)),
        Err(MetricsError::TooSmallForSsim { .. } | MetricsError::NonFinite) => Ok(None),
        Err(error) => Err(error),
    }
}

fn root_mean_square(image: &Image) -> f64 {
    let samples = image.pixels().iter().flatten();
    let sum: f64 = samples.map(|&v| f64::from(v) * f64::from(v)).sum();
    (sum / (3 * image.pixels().len()) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_images as synthetic;

    fn spoilt(result: &Comparison) -> [Option<f64>; 5] {
        [result.relmse, result.rmse, result.psnr, result.ssim, result.luminance_ratio]
    }

    #[test]
    fn linear_pictures_are_compared_as_light() {
        let (a, b) = (synthetic::hdr_noisy(), synthetic::hdr());
        let result = compare(&a, &b, None).unwrap();
        assert_eq!(result.encoding, Encoding::Linear);
        assert_eq!(result.rmse.unwrap(), rmse(&a, &b).unwrap());
        // The authors' HDR-FLIP.
        assert!((result.flip - 0.031_773).abs() < 1e-4);
        assert_eq!(result.blocks_beyond_4, None);
        assert!(result.all_finite());
    }

    #[test]
    fn one_encoded_picture_makes_it_display_values() {
        let (a, b) = (synthetic::disturbed(), synthetic::stripes());
        let both = compare(&a, &b, None).unwrap();
        let mixed = compare(&a.to_linear(), &b, None).unwrap();
        assert_eq!(mixed.encoding, Encoding::Srgb);
        assert!((both.rmse.unwrap() - mixed.rmse.unwrap()).abs() < 1e-6);
        assert!((both.flip - 0.325_030).abs() < 1e-4);
        assert!(compare(&a, &b, Some(&synthetic::hdr())).is_err());
    }

    #[test]
    fn a_nan_is_counted_and_spoils_what_it_must() {
        let (mut a, b) = (synthetic::hdr_noisy(), synthetic::hdr());
        a.pixels_mut()[100] = [f32::NAN, 1.0, f32::INFINITY];
        let result = compare(&a, &b, Some(&b)).unwrap();
        assert_eq!((result.non_finite, result.non_finite_reference), (1, 0));
        assert!(!result.all_finite());
        assert_eq!(spoilt(&result), [None; 5]);
        assert_eq!(result.flip_max, 1.0);
        assert!(result.flip < 0.1);
        assert_eq!(result.blocks.unwrap().non_finite, 1);
    }

    #[test]
    fn pixels_that_the_reference_knows_badly_do_not_count() {
        let reference = synthetic::hdr();
        let mut image = reference.clone();
        let mut error =
            Image::from_fn(reference.width(), reference.height(), Encoding::Linear, |_, _| [0.0; 3]).unwrap();
        image.pixels_mut()[5] = [1e3; 3];
        error.pixels_mut()[5] = [1e2; 3];
        let noise = Noise { of_reference: Some(&error), most_of_reference: Some(0.02), ..Noise::default() };
        let result = compare_noisy(&image, &reference, &noise).unwrap();
        assert_eq!((result.left_out, result.rmse, result.luminance_ratio), (1, Some(0.0), Some(1.0)));
        assert_eq!((result.blocks_beyond_4, result.rmse_floor_reference), (Some(0.0), Some(0.0)));
        assert!(result.flip_max > 0.5);
    }

    #[test]
    fn infinite_light_is_not_clamped_into_white() {
        let (mut bright, good) = (synthetic::hdr(), synthetic::hdr());
        bright.pixels_mut()[0] = [f32::INFINITY; 3];
        let shown = good.to_srgb();
        for (a, b) in [(&bright, &good), (&good, &bright), (&bright, &*shown)] {
            let result = compare(a, b, None).unwrap();
            assert_eq!(spoilt(&result), [None; 5]);
            assert_eq!(result.flip_max, 1.0);
        }
    }

    #[test]
    fn json_has_stable_keys_and_nulls() {
        let a = synthetic::hdr();
        let result = compare(&a, &a, Some(&a)).unwrap();
        let json = serde_json::to_value(&result).unwrap();
        assert!(json["psnr"].is_null());
        assert_eq!(json["encoding"], "linear");
        assert_eq!(json["relmse"], 0.0);
        assert_eq!(json["blocks_beyond_4"], 0.0);
        assert_eq!(json["blocks"]["count"], 12);
        assert_eq!(json["luminance_ratio"], 1.0);
    }

    #[test]
    fn small_pictures_have_no_ssim() {
        let tiny = Image::from_fn(4, 3, Encoding::Srgb, |_, _| [0.5; 3]).unwrap();
        let result = compare(&tiny, &tiny, None).unwrap();
        assert_eq!((result.ssim, result.flip), (None, 0.0));
    }
}
