//! Structural similarity: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural
//! Similarity", IEEE Transactions on Image Processing 13(4), 2004.

use rayon::prelude::*;

use crate::error::MetricsError;
use crate::image::Image;

/// Half the window's side, without the middle.
const RADIUS: usize = 5;
/// Standard deviation of the Gaussian window, in pixels.
const SIGMA: f64 = 1.5;
/// (K1 L)^2 and (K2 L)^2 with K1 = 0.01, K2 = 0.03 and a data range L of 1.
const C1: f64 = 1e-4;
const C2: f64 = 9e-4;

type Window = [f64; 2 * RADIUS + 1];

/// Mean SSIM of display values 0..1: 1 for equal pictures.
///
/// Gaussian window of 11x11 pixels with sigma 1.5, weighted moments without Bessel's correction, each channel by itself, mean
/// over the channels and over the pixels whose window lies inside the picture. This is scikit-image's `structural_similarity`
/// with `gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1, channel_axis=2`. Linear pictures are
/// sRGB-encoded and clamped first.
///
/// # Errors
/// If the sizes differ, a side has fewer than 11 pixels, or a pixel is NaN or infinite.
pub fn ssim(a: &Image, b: &Image) -> Result<f64, MetricsError> {
    b.expect_same_size(a, "the picture")?;
    let (width, height) = (a.width(), a.height());
    if width.min(height) < 2 * RADIUS + 1 {
        return Err(MetricsError::TooSmallForSsim { width, height });
    }
    if a.non_finite_count() + b.non_finite_count() > 0 {
        return Err(MetricsError::NonFinite);
    }
    let (a, b) = (a.to_srgb(), b.to_srgb());
    let channels = (0..3).map(|channel| channel_ssim(&plane(&a, channel), &plane(&b, channel), width));
    Ok(channels.sum::<f64>() / 3.0)
}

/// `f64`, since variances are differences of nearly equal numbers.
fn plane(image: &Image, channel: usize) -> Vec<f64> {
    let samples = image.pixels().iter().map(|p| f64::from(p[channel]));
    samples.collect()
}

fn channel_ssim(a: &[f64], b: &[f64], width: usize) -> f64 {
    let window = window();
    let rows = a.len() / width + 1 - window.len();
    let row_sums = (0..rows).into_par_iter().map(|y| {
        let rows = y * width..(y + window.len()) * width;
        row_ssim(&a[rows.clone()], &b[rows], width, &window)
    });
    // Collected first: the order of a parallel sum, and so its last bit, would vary.
    let row_sums: Vec<f64> = row_sums.collect();
    row_sums.iter().sum::<f64>() / (rows * (width + 1 - window.len())) as f64
}

/// Sum of SSIM over the middle one of 11 rows.
fn row_ssim(a: &[f64], b: &[f64], width: usize, window: &Window) -> f64 {
    let mut columns: [Vec<f64>; MOMENTS] = std::array::from_fn(|_| vec![0.0; width]);
    let rows = a.chunks_exact(width).zip(b.chunks_exact(width));
    for ((a, b), &weight) in rows.zip(window) {
        accumulate_moments(&mut columns, a, b, weight);
    }
    let moments = columns.map(|column| along_row(&column, window));
    let count = moments[0].len();
    (0..count).map(|x| similarity(std::array::from_fn(|m| moments[m][x]))).sum()
}

/// Of a, b, a^2, b^2 and a b.
const MOMENTS: usize = 5;

fn accumulate_moments(sums: &mut [Vec<f64>; MOMENTS], a: &[f64], b: &[f64], weight: f64) {
    let [sum_a, sum_b, sum_aa, sum_bb, sum_ab] = sums;
    for x in 0..a.len() {
        let (weighted_a, weighted_b) = (weight * a[x], weight * b[x]);
        sum_a[x] += weighted_a;
        sum_b[x] += weighted_b;
        sum_aa[x] += weighted_a * a[x];
        sum_bb[x] += weighted_b * b[x];
        sum_ab[x] += weighted_a * b[x];
    }
}

/// The row filtered, where the whole window lies inside it.
fn along_row(row: &[f64], window: &Window) -> Vec<f64> {
    let mut filtered = vec![0.0; row.len() + 1 - window.len()];
    for (offset, &weight) in window.iter().enumerate() {
        for (sum, value) in filtered.iter_mut().zip(&row[offset..]) {
            *sum += weight * value;
        }
    }
    filtered
}

/// Equation 13 of the paper.
fn similarity([mean_a, mean_b, aa, bb, ab]: [f64; MOMENTS]) -> f64 {
    let (square_a, square_b, product) = (mean_a * mean_a, mean_b * mean_b, mean_a * mean_b);
    let variances = (aa - square_a) + (bb - square_b);
    let covariance = ab - product;
    (2.0 * product + C1) * (2.0 * covariance + C2) / ((square_a + square_b + C1) * (variances + C2))
}

fn window() -> Window {
    let gauss = std::array::from_fn(|i| {
        let distance = i as f64 - RADIUS as f64;
        (-0.5 * distance * distance / (SIGMA * SIGMA)).exp()
    });
    let sum: f64 = gauss.iter().sum();
    gauss.map(|g| g / sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Encoding;
    use crate::test_images as synthetic;

    /// Values of scikit-image 0.26.0 for the same pictures.
    #[test]
    fn agrees_with_scikit_image() {
        let close = |a: &Image, b: &Image, expected: f64| {
            let got = ssim(a, b).unwrap();
            assert!((got - expected).abs() < 1e-9, "{got} for {expected}");
        };
        close(&synthetic::disturbed(), &synthetic::stripes(), 0.460_481_982_741_110_9);
        close(&synthetic::lines(4), &synthetic::lines(3), 0.361_931_100_167_088_8);
        close(
            &synthetic::constant([0.55, 0.5, 0.5]),
            &synthetic::constant([0.5; 3]),
            0.998_491_976_636_042_6,
        );
        let (black, white) = (synthetic::constant([0.0; 3]), synthetic::constant([1.0; 3]));
        close(&black, &white, 9.999_000_099_989_997e-5);
        close(&white, &white, 1.0);
    }

    #[test]
    fn linear_pictures_are_encoded_first() {
        let (a, b) = (synthetic::disturbed(), synthetic::stripes());
        let linear = ssim(&a.to_linear(), &b.to_linear()).unwrap();
        assert!((linear - ssim(&a, &b).unwrap()).abs() < 1e-5);
    }

    #[test]
    fn refuses_what_has_no_window_or_no_value() {
        let image = |w, h| Image::from_fn(w, h, Encoding::Srgb, |_, _| [0.5; 3]).unwrap();
        assert!(ssim(&image(11, 11), &image(11, 11)).is_ok());
        assert!(matches!(ssim(&image(11, 10), &image(11, 10)), Err(MetricsError::TooSmallForSsim { .. })));
        let mut bad = image(11, 11);
        bad.pixels_mut()[7][1] = f32::NAN;
        assert!(matches!(ssim(&bad, &image(11, 11)), Err(MetricsError::NonFinite)));
    }
}
