//! Light from all directions in two bands of real spherical harmonics: the twin of `spherical_harmonics.glsl`.

use glam::Vec3;
use std::f32::consts::PI;

const SH_BAND_0: f32 = 0.282_094_8;
const SH_BAND_1: f32 = 0.488_602_52;

/// Radiance by direction, linear RGB.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SphericalHarmonics {
    /// Of Y00, then Y1-1, Y10, Y11, which go with y, z, x.
    pub coefficients: [Vec3; 4],
}

/// What radiance that comes from a unit direction adds to the coefficients; samples are to be divided by their
/// density in solid angle.
pub fn project(direction: Vec3, radiance: Vec3) -> SphericalHarmonics {
    SphericalHarmonics {
        coefficients: [
            SH_BAND_0 * radiance,
            SH_BAND_1 * direction.y * radiance,
            SH_BAND_1 * direction.z * radiance,
            SH_BAND_1 * direction.x * radiance,
        ],
    }
}

/// Radiance from a unit direction, as smooth as two bands are; may be negative.
pub fn evaluate(sh: &SphericalHarmonics, direction: Vec3) -> Vec3 {
    SH_BAND_0 * sh.coefficients[0] + SH_BAND_1 * linear(sh, direction)
}

/// Irradiance of a surface that faces along a unit vector: bands are convolved with the clamped cosine, whose
/// factors are pi and 2 pi / 3 (Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment
/// Maps, 2001, equation 8). May be negative opposite to strong light.
pub fn irradiance(sh: &SphericalHarmonics, normal: Vec3) -> Vec3 {
    PI * SH_BAND_0 * sh.coefficients[0] + 2.0 * PI / 3.0 * SH_BAND_1 * linear(sh, normal)
}

fn linear(sh: &SphericalHarmonics, direction: Vec3) -> Vec3 {
    sh.coefficients[1] * direction.y + sh.coefficients[2] * direction.z + sh.coefficients[3] * direction.x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of the radiance a + b . w. The axes' six directions integrate polynomials up to the third degree
    /// exactly, and these are of the second.
    fn projected(a: Vec3, b: [Vec3; 3]) -> SphericalHarmonics {
        let mut sum = SphericalHarmonics::default();
        for w in Vec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
            let radiance = a + b[0] * w.x + b[1] * w.y + b[2] * w.z;
            let part = project(w, radiance * (4.0 * PI / 6.0));
            for (coefficient, more) in sum.coefficients.iter_mut().zip(part.coefficients) {
                *coefficient += more;
            }
        }
        sum
    }

    #[test]
    fn two_bands_of_radiance_give_their_irradiance_exactly() {
        let a = Vec3::new(1.0, 2.0, 0.5);
        let b = [Vec3::new(0.1, -0.4, 0.0), Vec3::new(0.3, 0.7, -0.2), Vec3::new(0.5, 0.0, 0.1)];
        let sh = projected(a, b);
        for i in 0..64 {
            let random = crate::random::independent(i, 0, 0, 0).truncate().truncate();
            let n = crate::caps::sphere_direction(random);
            let along = b[0] * n.x + b[1] * n.y + b[2] * n.z;
            let expected = PI * a + 2.0 * PI / 3.0 * along;
            assert!((irradiance(&sh, n) - expected).abs().max_element() < 4e-6, "{n}");
            assert!((evaluate(&sh, n) - (a + along)).abs().max_element() < 2e-6, "{n}");
        }
    }

    #[test]
    fn coefficients_are_normalised() {
        let sh = projected(Vec3::ONE, [Vec3::ZERO, Vec3::ZERO, Vec3::splat(1.0)]);
        assert!((sh.coefficients[0].x - 3.544_907_7).abs() < 1e-6, "{sh:?}");
        assert!((sh.coefficients[2].x - 2.046_653_4).abs() < 1e-6, "{sh:?}");
        let sh = projected(Vec3::ONE, [Vec3::ZERO, Vec3::ZERO, Vec3::splat(0.5)]);
        assert!((irradiance(&sh, Vec3::Z).x - 4.188_790_2).abs() < 2e-6);
        assert!((irradiance(&sh, Vec3::NEG_Z).x - 2.094_395_1).abs() < 2e-6);
    }
}
