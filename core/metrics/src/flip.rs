//! FLIP: what an observer sees who flips between two pictures.
//!
//! LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating
//! Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020. HDR-FLIP: Andersson, Nilsson,
//! Shirley, Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021 (short papers).
//! Written from the papers' equations; the constants are theirs.

mod contrast;
mod features;
mod hdr;
mod observer;

use crate::error::MetricsError;
use crate::image::{Encoding, Image, is_finite};
use crate::magma::magma;
use observer::{Perceived, perceived_difference};

pub use hdr::{Exposures, flip_hdr};

/// Pixels per degree of visual angle of the papers' default: a display 0.7 m wide of 3840 pixels, seen from 0.7 m.
pub const DEFAULT_PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// FLIP error of every pixel: 0 where no difference is seen, 1 at most. Pixels that are NaN or infinite in either picture
/// have error 1.
#[derive(Clone, Debug, PartialEq)]
pub struct FlipMap {
    width: usize,
    height: usize,
    errors: Vec<f32>,
}

impl FlipMap {
    /// Errors row after row, row 0 on top.
    pub fn errors(&self) -> &[f32] {
        &self.errors
    }

    pub fn mean(&self) -> f64 {
        self.errors.iter().map(|&e| f64::from(e)).sum::<f64>() / self.errors.len() as f64
    }

    pub fn max(&self) -> f32 {
        self.errors.iter().copied().fold(0.0, f32::max)
    }

    /// The map in magma colours, as the papers show it.
    pub fn to_image(&self) -> Image {
        let pixels = self.errors.iter().map(|&e| magma(e)).collect();
        Image::new(self.width, self.height, Encoding::Srgb, pixels)
            .expect("a map has as many errors as the accepted picture had pixels")
    }
}

/// LDR-FLIP if either picture holds display values, HDR-FLIP with automatic exposures if both are linear.
///
/// # Errors
/// If the sizes differ.
pub fn flip(image: &Image, reference: &Image) -> Result<FlipMap, MetricsError> {
    let ppd = DEFAULT_PIXELS_PER_DEGREE;
    match (image.encoding(), reference.encoding()) {
        (Encoding::Linear, Encoding::Linear) => flip_hdr(image, reference, ppd, None),
        _ => flip_ldr(image, reference, ppd),
    }
}

/// LDR-FLIP of display values, symmetric in its pictures. Linear pictures are sRGB-encoded and clamped first.
///
/// # Errors
/// If the sizes differ.
pub fn flip_ldr(image: &Image, reference: &Image, pixels_per_degree: f64) -> Result<FlipMap, MetricsError> {
    reference.expect_same_size(image, "the picture")?;
    let perceived = |image: &Image| {
        let srgb = image.to_srgb();
        let linear = srgb.to_linear();
        Perceived::new(linear.pixels(), image.width(), pixels_per_degree)
    };
    let mut errors = perceived_difference(&perceived(image), &perceived(reference));
    condemn_non_finite(&mut errors, image, reference);
    Ok(FlipMap { width: image.width(), height: image.height(), errors })
}

/// Error 1 where there is nothing to see.
fn condemn_non_finite(errors: &mut [f32], image: &Image, reference: &Image) {
    let pairs = image.pixels().iter().zip(reference.pixels());
    for (error, (&a, &b)) in errors.iter_mut().zip(pairs) {
        if !(is_finite(a) && is_finite(b)) {
            *error = 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_images as synthetic;

    /// Mean, and the pixels (0, 0), (20, 17) and (63, 47), as the authors' `flip-evaluator` 1.7 gives them.
    fn check(map: &FlipMap, mean: f64, pixels: [f32; 3]) {
        assert!((map.mean() - mean).abs() < 2e-5, "{} for {mean}", map.mean());
        for ((x, y), expected) in [(0, 0), (20, 17), (63, 47)].into_iter().zip(pixels) {
            let got = map.errors()[y * 64 + x];
            assert!((got - expected).abs() < 5e-4, "{got} for {expected} at {x}, {y}");
        }
    }

    #[test]
    fn ldr_agrees_with_the_authors_program() {
        let (a, b) = (synthetic::disturbed(), synthetic::stripes());
        let map = flip(&a, &b).unwrap();
        check(&map, 0.325_029_942_289_499_3, [0.415_805_85, 0.417_510_63, 0.446_725_55]);
        assert!((map.max() - 0.546_123_9).abs() < 1e-4);
        check(
            &flip_ldr(&a, &b, 30.0).unwrap(),
            0.408_065_437_846_137_97,
            [0.392_326_4, 0.518_274_96, 0.507_089_26],
        );
        check(
            &flip(&synthetic::lines(4), &synthetic::lines(3)).unwrap(),
            0.221_522_731_588_353_1,
            [0.129_191_6, 0.0, 0.080_341_11],
        );
    }

    #[test]
    fn ldr_of_constants() {
        let of = |a, b| flip(&synthetic::constant(a), &synthetic::constant(b)).unwrap();
        check(&of([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]), 1.0, [1.0; 3]);
        check(&of([0.0; 3], [1.0; 3]), 0.967_388_33, [0.967_388_33; 3]);
        check(&of([0.5; 3], [0.55, 0.5, 0.5]), 0.149_689_88, [0.149_689_88; 3]);
        assert_eq!(of([0.3; 3], [0.3; 3]).max(), 0.0);
    }

    #[test]
    fn ldr_is_symmetric() {
        let (a, b) = (synthetic::disturbed(), synthetic::stripes());
        assert_eq!(flip(&a, &b).unwrap(), flip(&b, &a).unwrap());
    }

    #[test]
    fn a_nan_pixel_is_an_error_of_one_and_spreads_no_nan() {
        let good = synthetic::stripes();
        let mut bad = good.clone();
        bad.pixels_mut()[5 * 64 + 9][2] = f32::NAN;
        let map = flip(&bad, &good).unwrap();
        assert_eq!(map.errors()[5 * 64 + 9], 1.0);
        assert!(map.errors().iter().all(|e| (0.0..=1.0).contains(e)));
        assert_eq!(map.errors()[40 * 64 + 60], 0.0);
    }

    #[test]
    fn maps_become_pictures_in_magma() {
        let picture = flip(&synthetic::constant([0.0, 1.0, 0.0]), &synthetic::constant([0.0, 0.0, 1.0]))
            .unwrap()
            .to_image();
        assert_eq!(picture.rounded_to_8_bits().to_rgb8()[..3], [252, 253, 191]);
    }
}
