//! Is a picture within its noise? Means over blocks of pixels, against their standard errors.

use serde::Serialize;

use crate::colour::luminance;
use crate::error::MetricsError;
use crate::image::{Encoding, Image, is_finite};

/// Side of a block in pixels.
pub const BLOCK_SIDE: usize = 16;

/// Rounding, as a share of the reference's mean: it is added to the standard error (as squares), which may be exactly 0, for
/// instance where only a constant sky is seen.
const ROUNDING: f64 = 1e-5;

/// How many block means differ from the reference's by more than so many standard errors.
///
/// Blocks are [`BLOCK_SIDE`] pixels a side from the top left corner; those at the right and bottom edge hold what is left. The
/// standard error of a mean of n pixels is the root of the sum of their squares over n: pixels are independent. The
/// channels of a pixel are not, as its samples share their paths, so the standard error of its luminance is the luminance of its
/// standard errors: an upper bound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BlockReport {
    pub count: usize,
    /// Share of the blocks whose mean luminance differs by more than 4 standard errors.
    pub beyond_4: f64,
    pub beyond_6: f64,
    /// The same for red, green and blue.
    pub channels_beyond_4: [f64; 3],
    pub channels_beyond_6: [f64; 3],
    /// Blocks with a NaN or infinite pixel in either picture; they count as beyond in every share.
    pub non_finite: usize,
    /// Left column and top row of the block, in pixels, whose mean luminance differs most, and by how many standard errors; none if
    /// no block is finite.
    pub worst: Option<WorstBlock>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WorstBlock {
    pub x: usize,
    pub y: usize,
    pub sigmas: f64,
}

/// Root of the sum of squares, for the difference of two independent estimates.
///
/// # Errors
/// If the sizes differ.
pub fn combine_standard_errors(a: &Image, b: &Image) -> Result<Image, MetricsError> {
    a.expect_same_size(b, "the second standard error")?;
    let pairs = a.pixels().iter().zip(b.pixels());
    let pixels = pairs.map(|(a, b)| std::array::from_fn(|c| a[c].hypot(b[c])));
    let pixels = pixels.collect();
    Ok(Image::new(a.width(), a.height(), Encoding::Linear, pixels)?)
}

/// Compares linear pictures block by block; `standard_error` is that of the difference, a pixel and channel. Pixels whose standard error is
/// NaN or infinite are left out, and those that are not `kept`; so are blocks without any other.
///
/// # Errors
/// If the sizes differ or a picture is not linear.
pub fn compare_blocks(
    image: &Image,
    reference: &Image,
    standard_error: &Image,
    kept: Option<&[bool]>,
) -> Result<BlockReport, MetricsError> {
    reference.expect_same_size(image, "the picture")?;
    reference.expect_same_size(standard_error, "the standard error")?;
    let all = [image, reference, standard_error];
    if all.iter().any(|i| i.encoding() != Encoding::Linear) {
        return Err(MetricsError::StandardErrorOfEncoded);
    }
    let rows = (0..image.height()).step_by(BLOCK_SIDE);
    let corners = rows.flat_map(|y| (0..image.width()).step_by(BLOCK_SIDE).map(move |x| (x, y)));
    let blocks: Vec<_> = corners
        .filter_map(|(x, y)| {
            let sums = Sums::of_block(image, reference, standard_error, kept, x, y);
            (sums.count > 0 || sums.non_finite).then(|| (x, y, sums.sigmas()))
        })
        .collect();
    Ok(report(&blocks))
}

/// Luminance, red, green, blue; none if a pixel is NaN or infinite.
type Sigmas = Option<[f64; 4]>;

fn report(blocks: &[(usize, usize, Sigmas)]) -> BlockReport {
    let share = |quantity: usize, limit: f64| {
        let beyond = |sigmas: &Sigmas| sigmas.is_none_or(|s| s[quantity] > limit);
        blocks.iter().filter(|(.., s)| beyond(s)).count() as f64 / blocks.len().max(1) as f64
    };
    let luminance_sigmas = blocks.iter().filter_map(|&(x, y, sigmas)| {
        let sigmas = sigmas?[0];
        Some(WorstBlock { x, y, sigmas })
    });
    BlockReport {
        count: blocks.len(),
        beyond_4: share(0, 4.0),
        beyond_6: share(0, 6.0),
        channels_beyond_4: [1, 2, 3].map(|c| share(c, 4.0)),
        channels_beyond_6: [1, 2, 3].map(|c| share(c, 6.0)),
        non_finite: blocks.iter().filter(|(.., s)| s.is_none()).count(),
        worst: luminance_sigmas.max_by(|a, b| a.sigmas.total_cmp(&b.sigmas)),
    }
}

/// Sums over a block's pixels; luminance first, then the channels.
#[derive(Default)]
struct Sums {
    difference: [f64; 4],
    reference: [f64; 4],
    variance: [f64; 4],
    non_finite: bool,
    /// Pixels that count.
    count: usize,
}

impl Sums {
    fn of_block(
        image: &Image,
        reference: &Image,
        error: &Image,
        kept: Option<&[bool]>,
        x: usize,
        y: usize,
    ) -> Self {
        let mut sums = Self::default();
        for row in y..(y + BLOCK_SIDE).min(image.height()) {
            for column in x..(x + BLOCK_SIDE).min(image.width()) {
                if kept.is_some_and(|kept| !kept[row * image.width() + column]) {
                    continue;
                }
                let [a, b, error] = [image, reference, error].map(|i| i.pixel(column, row));
                if !(is_finite(a) && is_finite(b)) {
                    sums.non_finite = true;
                } else if is_finite(error) {
                    sums.add(quantities(a), quantities(b), quantities(error));
                }
            }
        }
        sums
    }

    fn add(&mut self, image: [f64; 4], reference: [f64; 4], error: [f64; 4]) {
        self.count += 1;
        for i in 0..4 {
            self.difference[i] += image[i] - reference[i];
            self.reference[i] += reference[i].abs();
            self.variance[i] += error[i] * error[i];
        }
    }

    /// The count of pixels is a factor of both sides, so sums do instead of means.
    fn sigmas(&self) -> Sigmas {
        if self.non_finite {
            return None;
        }
        Some(std::array::from_fn(|i| {
            let difference = self.difference[i].abs();
            let error = self.variance[i].sqrt().hypot(ROUNDING * self.reference[i]);
            if difference == 0.0 {
                return 0.0;
            }
            // `f64::MAX` and not infinity: JSON has no infinity.
            (difference / error).min(f64::MAX)
        }))
    }
}

fn quantities(pixel: [f32; 3]) -> [f64; 4] {
    let [r, g, b] = pixel.map(f64::from);
    [luminance(pixel), r, g, b]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constant(width: usize, height: usize, value: f32) -> Image {
        Image::from_fn(width, height, Encoding::Linear, |_, _| [value; 3]).unwrap()
    }

    #[test]
    fn a_block_mean_has_a_sixteenth_of_a_pixels_error() {
        // 256 pixels of standard error 0.16: 0.01 for the mean.
        let error = constant(32, 16, 0.16);
        let reference = constant(32, 16, 1.0);
        let mut image = reference.clone();
        for y in 0..16 {
            for x in 0..16 {
                image.pixels_mut()[y * 32 + x] = [1.05; 3];
            }
        }
        let report = compare_blocks(&image, &reference, &error, None).unwrap();
        assert_eq!(report.count, 2);
        assert_eq!((report.beyond_4, report.beyond_6), (0.5, 0.0));
        assert_eq!(report.channels_beyond_4, [0.5; 3]);
        let worst = report.worst.unwrap();
        assert_eq!((worst.x, worst.y), (0, 0));
        assert!((worst.sigmas - 5.0).abs() < 1e-4);
    }

    #[test]
    fn one_channel_alone_may_be_beyond() {
        let reference = constant(16, 16, 1.0);
        let image = Image::from_fn(16, 16, Encoding::Linear, |_, _| [1.0, 1.0, 1.07]).unwrap();
        let report = compare_blocks(&image, &reference, &constant(16, 16, 0.16), None).unwrap();
        assert_eq!(report.beyond_4, 0.0);
        assert_eq!(report.channels_beyond_6, [0.0, 0.0, 1.0]);
    }

    #[test]
    fn edge_blocks_hold_what_is_left() {
        let reference = constant(17, 33, 1.0);
        let mut image = reference.clone();
        image.pixels_mut()[32 * 17 + 16] = [1.5; 3];
        let report = compare_blocks(&image, &reference, &constant(17, 33, 0.1), None).unwrap();
        assert_eq!(report.count, 6);
        // One pixel is the whole last block: 0.5 of 0.1.
        let worst = report.worst.unwrap();
        assert_eq!((worst.x, worst.y), (16, 32));
        assert!((worst.sigmas - 5.0).abs() < 1e-4);
    }

    #[test]
    fn without_noise_only_rounding_is_forgiven() {
        let reference = constant(16, 16, 1.0);
        let of = |value| {
            compare_blocks(&constant(16, 16, value), &reference, &constant(16, 16, 0.0), None).unwrap()
        };
        assert_eq!(of(1.0 + 3e-5).beyond_4, 0.0);
        assert_eq!(of(1.001).beyond_6, 1.0);
    }

    #[test]
    fn nan_blocks_are_beyond_and_unknown_errors_are_left_out() {
        let (reference, mut error) = (constant(32, 16, 1.0), constant(32, 16, 0.1));
        let mut image = reference.clone();
        image.pixels_mut()[0][1] = f32::NAN;
        image.pixels_mut()[20] = [1e9; 3];
        error.pixels_mut()[20] = [f32::INFINITY; 3];
        let report = compare_blocks(&image, &reference, &error, None).unwrap();
        assert_eq!((report.non_finite, report.beyond_6), (1, 0.5));
    }

    #[test]
    fn errors_combine_as_roots_of_squares() {
        let combined = combine_standard_errors(&constant(2, 2, 3.0), &constant(2, 2, 4.0)).unwrap();
        assert_eq!(combined.pixel(1, 1), [5.0; 3]);
    }
}
