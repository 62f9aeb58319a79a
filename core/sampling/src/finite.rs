//! Light that is a number: the twin of `finite.glsl`.

use glam::Vec3;

/// Most that a channel of radiance may be, so that sums of squares of 2^30 samples stay finite.
pub const LARGEST_RADIANCE: f32 = 1e15;

/// Radiance that can be added up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FiniteRadiance {
    /// Black if a channel was not finite.
    pub value: Vec3,
    /// No channel was infinite or not a number.
    pub was_finite: bool,
    /// A channel was beyond [`LARGEST_RADIANCE`].
    pub was_capped: bool,
}

/// Radiance that can be added up: black where a channel is not finite, else each at most [`LARGEST_RADIANCE`].
pub fn finite_radiance(radiance: Vec3) -> FiniteRadiance {
    if !radiance.is_finite() {
        return FiniteRadiance { value: Vec3::ZERO, was_finite: false, was_capped: false };
    }
    let capped = radiance.clamp(Vec3::splat(-LARGEST_RADIANCE), Vec3::splat(LARGEST_RADIANCE));
    FiniteRadiance { value: capped, was_finite: true, was_capped: capped != radiance }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_is_black_and_says_so() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let result = finite_radiance(Vec3::new(1.0, bad, 2.0));
            assert_eq!(result, FiniteRadiance { value: Vec3::ZERO, was_finite: false, was_capped: false });
        }
    }

    #[test]
    fn squares_of_what_is_left_are_finite() {
        let result = finite_radiance(Vec3::new(1e30, 3.4e38, 0.5));
        assert_eq!(result.value, Vec3::new(1e15, 1e15, 0.5));
        assert!(result.was_capped && result.was_finite);
        // The most that squares of deviations of so many samples add up to: half of them are black.
        let samples = (1_u64 << 30) as f32;
        assert!((samples / 4.0 * result.value * result.value).is_finite());
        let plain = Vec3::new(0.0, 65_504.0, 1e-40);
        assert_eq!(
            finite_radiance(plain),
            FiniteRadiance { value: plain, was_finite: true, was_capped: false }
        );
    }
}
