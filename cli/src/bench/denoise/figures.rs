//! Figures of a sequence of pictures: errors of a frame, flicker of what stands still, lag of a step of the light.

use afterglow_metrics::pixelwise::RELMSE_EPSILON;
use afterglow_metrics::{Image, MetricsError, compare};
use serde::Serialize;

use super::references::Reference;

/// What a mean luminance may be away from the one it should be, of the latter.
const LAG_TOLERANCE: f64 = 0.1;
/// Share of a stretch's mean luminance that counts as luminance where there is less, so that black pixels do not flicker.
const LEAST_LUMINANCE: f64 = 0.01;

/// Errors of a frame against its reference. None where a number does not exist.
#[derive(Debug, Clone, Serialize)]
pub struct Errors {
    /// Radiance.
    pub rmse: Option<f64>,
    /// That over the reference's mean.
    pub rmse_over_mean: Option<f64>,
    /// The noise of the reference in the same measure, if it is known.
    pub reference_floor_over_mean: Option<f64>,
    /// Of mean((x - r)^2 / (r^2 + 0.01)).
    pub relmse: Option<f64>,
    /// Of display values.
    pub ssim: Option<f64>,
    /// HDR-FLIP.
    pub flip: f64,
    /// Mean luminance over the reference's.
    pub luminance_ratio: Option<f64>,
}

impl Errors {
    /// Of a linear picture.
    pub fn of(image: &Image, reference: &Reference) -> Result<Errors, MetricsError> {
        let found = compare(image, &reference.mean, reference.standard_error.as_ref())?;
        let mean = mean(&reference.mean);
        Ok(Errors {
            rmse: found.rmse,
            rmse_over_mean: found.rmse.map(|rmse| rmse / mean),
            reference_floor_over_mean: found.rmse_floor.map(|floor| floor / mean),
            relmse: found.relmse,
            ssim: found.ssim,
            flip: found.flip,
            luminance_ratio: found.luminance_ratio,
        })
    }
}

/// The mean of all pixels and channels.
fn mean(image: &Image) -> f64 {
    let channels = image.pixels().iter().flatten();
    channels.map(|&channel| f64::from(channel)).sum::<f64>() / (3 * image.pixels().len()) as f64
}

/// Errors of some pixels only.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PartErrors {
    /// How many they are.
    pub pixels: usize,
    /// None if there are none.
    pub rmse_over_mean: Option<f64>,
    /// Likewise.
    pub relmse: Option<f64>,
}

impl PartErrors {
    /// Of the pixels that are `chosen`.
    pub fn of(image: &Image, reference: &Image, chosen: &[bool]) -> PartErrors {
        let (mut square, mut relative, mut sum, mut pixels) = (0.0, 0.0, 0.0, 0);
        let pairs = image.pixels().iter().zip(reference.pixels()).zip(chosen);
        for ((pixel, wanted), _) in pairs.filter(|(_, chosen)| **chosen) {
            pixels += 1;
            for (x, r) in pixel.iter().zip(wanted) {
                let (x, r) = (f64::from(*x), f64::from(*r));
                square += (x - r) * (x - r);
                relative += (x - r) * (x - r) / (r * r + RELMSE_EPSILON);
                sum += r;
            }
        }
        let count = 3.0 * pixels as f64;
        let sound = |value: f64| Some(value).filter(|value| value.is_finite());
        PartErrors {
            pixels,
            rmse_over_mean: sound((square / count).sqrt() / (sum / count)),
            relmse: sound(relative / count),
        }
    }
}

/// How much the luminance of pixels changes from frame to frame, of itself: the mean over pixels and over pairs of successive
/// frames in the second half of a stretch. `luminances`: a frame, a pixel. None of fewer than two frames in that half.
pub fn flicker(luminances: &[Vec<f64>]) -> Option<f64> {
    let half = &luminances[luminances.len() / 2..];
    let floor = LEAST_LUMINANCE * half.iter().map(|frame| mean_of(frame)).sum::<f64>() / half.len() as f64;
    let changes = half.windows(2).map(|pair| {
        let pixels = pair[0].iter().zip(&pair[1]);
        let change = pixels.map(|(a, b)| (b - a).abs() / (f64::midpoint(*a, *b) + floor));
        change.sum::<f64>() / pair[0].len() as f64
    });
    let count = half.len().saturating_sub(1);
    Some(changes.sum::<f64>() / count as f64).filter(|flicker| flicker.is_finite())
}

/// The mean of some numbers.
pub fn mean_of(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Frames until the mean luminance is within a tenth of what it should be, and stays there; 0 if it is so from the frame of the
/// step on. None if it is not so in the last frame.
pub fn lag(means: &[f64], wanted: f64) -> Option<usize> {
    let is_there = |mean: &f64| (mean / wanted - 1.0).abs() <= LAG_TOLERANCE;
    let settled = means.iter().rev().take_while(|mean| is_there(mean)).count();
    (settled > 0).then_some(means.len() - settled)
}

/// The mean of what there is.
pub fn mean_known(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let values: Vec<f64> = values.flatten().collect();
    (!values.is_empty()).then(|| mean_of(&values))
}

#[cfg(test)]
mod tests {
    use afterglow_metrics::Encoding;

    use super::*;

    /// A history that gives each new frame a weight, after the light went from 1 to 0.1.
    fn after_step(weight: f64, frames: usize) -> Vec<f64> {
        let decay = |index: usize| 0.1 + 0.9 * (1.0 - weight).powi(index as i32 + 1);
        (0..frames).map(decay).collect()
    }

    #[test]
    fn lag_counts_frames_until_the_light_stays() {
        assert_eq!(lag(&after_step(1.0, 12), 0.1), Some(0));
        assert_eq!(lag(&after_step(0.5, 12), 0.1), Some(6));
        assert_eq!(lag(&after_step(0.1, 12), 0.1), None);
        // Through what is wanted and out of it again.
        assert_eq!(lag(&[1.0, 0.1, 0.05, 0.1, 0.1], 0.1), Some(3));
        assert_eq!(lag(&[], 0.1), None);
        assert_eq!(lag(&[f64::NAN, 0.1], 0.1), Some(1));
    }

    #[test]
    fn flicker_is_the_relative_change_in_the_second_half() {
        let steady = vec![vec![2.0; 4]; 6];
        assert_eq!(flicker(&steady), Some(0.0));
        // The first half does not count.
        let mut settling = steady.clone();
        settling[0] = vec![9.0; 4];
        assert_eq!(flicker(&settling), Some(0.0));
        // One of two pixels goes from 1 to 3 and back: 2 / (2 + 1 % of the mean of 2), halved.
        let alternating: Vec<_> =
            (0..8).map(|index| vec![2.0, if index % 2 == 0 { 1.0 } else { 3.0 }]).collect();
        assert!((flicker(&alternating).unwrap() - 0.5 * 2.0 / 2.02).abs() < 1e-12);
        assert_eq!((flicker(&[vec![1.0]]), flicker(&[])), (None, None));
        assert_eq!(flicker(&vec![vec![0.0; 4]; 4]), None);
    }

    #[test]
    fn errors_of_a_part_leave_out_the_rest() {
        let image = |pixels: [f32; 3]| {
            Image::new(3, 1, Encoding::Linear, pixels.map(|value| [value; 3]).to_vec()).unwrap()
        };
        let (picture, reference) = (image([1.0, 0.5, 9.0]), image([0.5, 0.5, 0.0]));
        let found = PartErrors::of(&picture, &reference, &[true, true, false]);
        assert_eq!(found.pixels, 2);
        assert!((found.rmse_over_mean.unwrap() - 0.125f64.sqrt() / 0.5).abs() < 1e-12);
        assert!((found.relmse.unwrap() - 0.125 / 0.26).abs() < 1e-12);
        let none = PartErrors { pixels: 0, rmse_over_mean: None, relmse: None };
        assert_eq!(PartErrors::of(&picture, &reference, &[false; 3]), none);
    }
}
