//! Random numbers by pixel, sample and dimension, the same in every run: the twin of `random.glsl`.
//!
//! Sobol points, their order and digits scrambled by hashes (Burley, Practical Hash-based Owen Scrambling, JCGT
//! 2020), or, where errors must be known, numbers that are independent of each other.

use glam::{UVec4, Vec2, Vec4};

/// Numbers are multiples of this, and at most 1 less this, so that log(1 - u) is finite.
const GRID: f32 = 1.0 / 16_777_216.0;

/// Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 2020: pcg.
pub fn hash(value: u32) -> u32 {
    let state = value.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// A permutation in which a bit depends on the bits above it only.
pub fn owen_scramble(value: u32, seed: u32) -> u32 {
    let mut value = value.reverse_bits().wrapping_add(seed);
    value ^= value.wrapping_mul(0x6c50_b47c);
    value ^= value.wrapping_mul(0xb82f_1e52);
    value ^= value.wrapping_mul(0xc7af_e638);
    value ^= value.wrapping_mul(0x8d22_f6e6);
    value.reverse_bits()
}

/// The second coordinate of the index-th Sobol point; the first is the index with its bits reversed.
pub fn sobol_second(mut index: u32) -> u32 {
    let (mut result, mut direction) = (0, 0x8000_0000u32);
    while index != 0 {
        result ^= if index & 1 != 0 { direction } else { 0 };
        index >>= 1;
        direction ^= direction >> 1;
    }
    result
}

/// Where in the sequences a sample stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Random {
    /// Of the pixel and the run.
    pub pixel: u32,
    /// Number of the sample.
    pub sample_index: u32,
}

/// A point of [0, 1)^2: the sample's in a sequence of this dimension's own.
pub fn random_2d(random: Random, dimension: u32) -> Vec2 {
    let seed = hash(random.pixel.wrapping_add(dimension.wrapping_mul(0x9e37_79b9)));
    let index = owen_scramble(random.sample_index, seed);
    let x = owen_scramble(index.reverse_bits(), hash(seed ^ 0x5555_5555));
    let y = owen_scramble(sobol_second(index), hash(seed ^ 0xaaaa_aaaa));
    Vec2::new((x >> 8) as f32, (y >> 8) as f32) * GRID
}

/// Jarzynski and Olano 2020: pcg4d.
pub fn pcg4d(value: UVec4) -> UVec4 {
    let [mut x, mut y, mut z, mut w] =
        value.to_array().map(|v| v.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let round = |x: &mut u32, y: &mut u32, z: &mut u32, w: &mut u32| {
        *x = x.wrapping_add(y.wrapping_mul(*w));
        *y = y.wrapping_add(z.wrapping_mul(*x));
        *z = z.wrapping_add(x.wrapping_mul(*y));
        *w = w.wrapping_add(y.wrapping_mul(*z));
    };
    round(&mut x, &mut y, &mut z, &mut w);
    [x, y, z, w] = [x, y, z, w].map(|v| v ^ (v >> 16));
    round(&mut x, &mut y, &mut z, &mut w);
    UVec4::new(x, y, z, w)
}

/// Four numbers in [0, 1), multiples of 2^-24, independent of those of any other pixel, sample, dimension or seed.
pub fn independent(pixel: u32, sample_index: u32, dimension: u32, seed: u32) -> Vec4 {
    (pcg4d(UVec4::new(pixel, sample_index, dimension, seed)) >> 8u32).as_vec4() * GRID
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Mean, assert_chi_square};

    #[test]
    fn the_greatest_number_is_less_than_one() {
        let greatest = (u32::MAX >> 8) as f32 * GRID;
        assert_eq!(greatest, 1.0 - f32::EPSILON / 2.0);
        assert!((1.0 - greatest).ln().is_finite());
        // Any word is such a number exactly: 24 bits are what f32 holds.
        assert_eq!(f64::from(greatest), f64::from(u32::MAX >> 8) / f64::from(1 << 24));
    }

    type Stream = fn(u32) -> Vec4;

    /// Streams that vary one input alone, from where f32 would no longer tell neighbours apart.
    const STREAMS: [(&str, Stream); 6] = [
        ("pixel", |i| independent(i, 0, 0, 0)),
        ("pixel over 2^16", |i| independent(i + (1 << 16), 3, 1, 0)),
        ("sample over 2^24", |i| independent(5, i + (1 << 24), 2, 0)),
        ("pixel over 2^30", |i| independent(i + (1 << 30), 1, 0, 9)),
        ("dimension", |i| independent(77, 12, i, 1)),
        ("seed", |i| independent(77, 12, 3, i)),
    ];

    #[test]
    fn numbers_are_even_whatever_varies() {
        for (name, stream) in STREAMS {
            for axis in 0..4 {
                let mut bins = [0u32; 256];
                (0..1 << 18).for_each(|i| bins[(stream(i)[axis] * 256.0) as usize] += 1);
                assert_chi_square(&bins.map(f64::from), &[1024.0; 256], &format!("{name} {axis}"));
            }
        }
    }

    #[test]
    fn neighbours_do_not_know_each_other() {
        for (name, stream) in STREAMS {
            // Pairs of successive numbers and of a number's two coordinates, in 16 x 16 bins.
            for (a, b, step) in [(0, 0, 1), (0, 1, 0), (2, 3, 0), (1, 2, 1), (3, 3, 64)] {
                let mut bins = [0u32; 256];
                for i in 0..1 << 18 {
                    let (first, second) = (stream(i)[a], stream(i + step)[b]);
                    bins[(first * 16.0) as usize * 16 + (second * 16.0) as usize] += 1;
                }
                assert_chi_square(&bins.map(f64::from), &[1024.0; 256], &format!("{name} {a} {b} {step}"));
            }
        }
    }

    #[test]
    fn means_of_independent_numbers_have_the_error_of_independent_numbers() {
        // 2,000 pixels' means of 256 numbers: their variance is 1/12 over 256.
        let mut means = Mean::new();
        for pixel in 0..2000 {
            let sum: f64 = (0..256).map(|i| f64::from(independent(pixel, i, 4, 1).x)).sum();
            means.add(sum / 256.0);
        }
        means.assert_near(0.5, 4.0);
        let ratio = means.variance() * 12.0 * 256.0;
        assert!((ratio - 1.0).abs() < 4.0 * (2.0f64 / 2000.0).sqrt(), "{ratio}");
    }

    #[test]
    fn sobol_points_leave_no_box_empty() {
        // 256 points: one in each of 16 x 16 boxes, and in each of 256 columns and rows.
        for pixel in [0, 1, 70_000, u32::MAX] {
            let mut boxes = [[0u32; 256]; 3];
            for sample_index in 0..256 {
                let point = random_2d(Random { pixel, sample_index }, 5);
                let (x, y) = ((point.x * 256.0) as usize, (point.y * 256.0) as usize);
                boxes[0][x / 16 * 16 + y / 16] += 1;
                boxes[1][x] += 1;
                boxes[2][y] += 1;
            }
            assert_eq!(boxes, [[1; 256]; 3], "{pixel}");
        }
    }
}
