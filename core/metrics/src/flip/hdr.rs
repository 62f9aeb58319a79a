//! HDR-FLIP: the worst of LDR-FLIP over a range of exposures, found from the reference.

use super::{FlipMap, Perceived, condemn_non_finite, perceived_difference};
use crate::error::MetricsError;
use crate::image::Image;

/// ACES filmic curve in Narkowicz' fit, (a x^2 + b x + c) / (d x^2 + e x + f), with his exposure of 0.6 folded in.
const CURVE: [f64; 6] = [0.36 * 2.51, 0.6 * 0.03, 0.0, 0.36 * 2.43, 0.6 * 0.59, 0.14];
/// The automatic exposures take the brightest and the median pixel to this value of the curve.
const TARGET: f64 = 0.85;
/// Light above this is white under any curve; it also keeps squares finite.
const BRIGHTEST: f32 = 1e15;

/// Exposures to look at a picture with: `count` of them, evenly from `start` to `stop`, in stops (powers of two).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposures {
    pub start: f64,
    pub stop: f64,
    pub count: usize,
}

impl Exposures {
    /// From where the brightest pixel of the reference is well exposed to where the median pixel is, about one a stop and at
    /// least two (section 3 of the HDR-FLIP paper). Luminances below `f32::EPSILON` count as that.
    pub fn of_reference(reference: &Image) -> Self {
        let mut luminances = reference.luminances();
        luminances.retain(|l| l.is_finite());
        luminances.sort_unstable_by(f64::total_cmp);
        let at = |index: usize| luminances.get(index).copied().unwrap_or(0.0);
        let brightest = at(luminances.len().saturating_sub(1));
        let median = at(luminances.len() / 2);
        let stops = |luminance: f64| (well_exposed() / luminance.max(f64::from(f32::EPSILON))).log2();
        let (start, stop) = (stops(brightest), stops(median));
        Self { start, stop, count: ((stop - start).ceil() as usize).max(2) }
    }

    fn factors(self) -> impl Iterator<Item = f32> {
        let step = (self.stop - self.start) / self.count.saturating_sub(1).max(1) as f64;
        (0..self.count).map(move |i| (self.start + i as f64 * step).exp2() as f32)
    }
}

/// HDR-FLIP of linear light; display values are linearised first. Negative light counts as none.
///
/// The exposures are those of the reference if none are given, so the measure is not symmetric.
///
/// # Errors
/// If the sizes differ.
pub fn flip_hdr(
    image: &Image,
    reference: &Image,
    pixels_per_degree: f64,
    exposures: Option<Exposures>,
) -> Result<FlipMap, MetricsError> {
    reference.expect_same_size(image, "the picture")?;
    let (image, reference) = (image.to_linear(), reference.to_linear());
    let exposures = exposures.unwrap_or_else(|| Exposures::of_reference(&reference));
    let mut errors = vec![0.0f32; image.pixels().len()];
    for factor in exposures.factors() {
        let perceived = |image: &Image| {
            let developed: Vec<_> =
                image.pixels().iter().map(|p| p.map(|light| tone_mapped(light, factor))).collect();
            Perceived::new(&developed, image.width(), pixels_per_degree)
        };
        let exposed = perceived_difference(&perceived(&image), &perceived(&reference));
        for (worst, error) in errors.iter_mut().zip(exposed) {
            *worst = worst.max(error);
        }
    }
    condemn_non_finite(&mut errors, &image, &reference);
    Ok(FlipMap { width: image.width(), height: image.height(), errors })
}

/// 0 to 1; NaN stays NaN.
fn tone_mapped(light: f32, factor: f32) -> f32 {
    let [a, b, c, d, e, f] = CURVE.map(|k| k as f32);
    let x = (light * factor).clamp(0.0, BRIGHTEST);
    let mapped = ((a * x + b) * x + c) / ((d * x + e) * x + f);
    mapped.clamp(0.0, 1.0)
}

/// The light that the curve takes to [`TARGET`]: the positive root of its quadratic equation.
fn well_exposed() -> f64 {
    let [a, b, c, d, e, f] = CURVE;
    let (a, b, c) = (a - TARGET * d, b - TARGET * e, c - TARGET * f);
    (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flip::{DEFAULT_PIXELS_PER_DEGREE, flip};
    use crate::test_images as synthetic;

    /// Exposures, mean, and the pixels (0, 0), (20, 17) and (63, 47), as the authors' `flip-evaluator` 1.7 gives them.
    fn check(a: &Image, b: &Image, exposures: Exposures, mean: f64, pixels: [f32; 3]) {
        let got = Exposures::of_reference(b);
        assert!((got.start - exposures.start).abs() < 1e-5, "{got:?}");
        assert!((got.stop - exposures.stop).abs() < 1e-5, "{got:?}");
        assert_eq!(got.count, exposures.count);
        let map = flip(a, b).unwrap();
        assert!((map.mean() - mean).abs() < 2e-5, "{} for {mean}", map.mean());
        for ((x, y), expected) in [(0, 0), (20, 17), (63, 47)].into_iter().zip(pixels) {
            let got = map.errors()[y * 64 + x];
            assert!((got - expected).abs() < 5e-4, "{got} for {expected} at {x}, {y}");
        }
    }

    fn exposures(start: f64, stop: f64, count: usize) -> Exposures {
        Exposures { start, stop, count }
    }

    #[test]
    fn agrees_with_the_authors_program() {
        let (noisy, clean) = (synthetic::hdr_noisy(), synthetic::hdr());
        check(
            &noisy,
            &clean,
            exposures(-2.253_812_8, -1.234_648, 2),
            0.031_773_295_474_143_5,
            [0.030_674_633, 0.033_937_946, 0.056_699_99],
        );
        check(
            &clean,
            &noisy,
            exposures(-2.480_374_1, -1.209_219_5, 2),
            0.033_197_441_416_177_75,
            [0.031_096_643, 0.034_247_585, 0.056_501_325],
        );
        check(
            &synthetic::wide_noisy(),
            &synthetic::wide(),
            exposures(-8.928_042, -6.405_163, 3),
            0.040_576_065_228_303_07,
            [0.006_228_336, 0.036_570_422, 0.079_250_105],
        );
    }

    #[test]
    fn a_reference_that_is_mostly_black() {
        check(
            &synthetic::mostly_dark(12, 90.0),
            &synthetic::mostly_dark(10, 100.0),
            exposures(-2.253_812_8, 24.083_298, 27),
            0.143_294_371_480_701_93,
            [0.120_477_38, 0.044_845_22, 0.0],
        );
    }

    #[test]
    fn black_and_absurd_light_give_a_number() {
        let black = synthetic::mostly_dark(0, 1.0);
        let mut absurd = black.clone();
        absurd.pixels_mut()[0] = [f32::MAX, -f32::MAX, 1e-45];
        absurd.pixels_mut()[1] = [f32::INFINITY, 0.0, 0.0];
        assert_eq!(flip(&black, &black).unwrap().max(), 0.0);
        for (a, b) in [(&black, &absurd), (&absurd, &black), (&absurd, &absurd)] {
            let map = flip(a, b).unwrap();
            assert!(map.errors().iter().all(|e| (0.0..=1.0).contains(e)));
            assert_eq!(map.errors()[1], 1.0);
        }
    }

    #[test]
    fn one_given_exposure_is_used_as_it_is() {
        let (a, b) = (synthetic::hdr_noisy(), synthetic::hdr());
        let dark = Some(exposures(-30.0, -30.0, 1));
        let map = flip_hdr(&a, &b, DEFAULT_PIXELS_PER_DEGREE, dark).unwrap();
        assert!(map.max() < 1e-3);
    }
}
