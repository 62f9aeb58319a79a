//! How the light of fixed-function OpenGL falls off (OpenGL 1.5, section 2.14.1): finite everywhere, also at the light.

use glam::Vec3;

/// Falloff by distance: 1 / (k0 + k1 d + k2 d^2), whose sum counts as 1e-6 at least, so that nothing is divided by 0 at a
/// light that falls off with the square alone. 0 where distance or coefficients are not numbers, or so great that their
/// products are not.
pub fn attenuation(coefficients: Vec3, distance: f32) -> f32 {
    let sum = coefficients.dot(Vec3::new(1.0, distance, distance * distance));
    if sum.is_nan() { 0.0 } else { 1.0 / sum.max(1e-6) }
}

/// A spot's cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Unit vector along which it shines.
    pub axis: Vec3,
    /// Cosine of the cone's half angle; -1: all directions.
    pub cos_cutoff: f32,
    /// Of the cosine within the cone.
    pub exponent: f32,
}

/// How much a spot sends along a direction away from it, a unit vector or, at the light itself, zero.
pub fn spot(spot: &Spot, away: Vec3) -> f32 {
    if spot.cos_cutoff <= -1.0 {
        return 1.0;
    }
    let along = away.dot(spot.axis);
    if along < spot.cos_cutoff { 0.0 } else { power(along, spot.exponent) }
}

/// x to the power of y, 1 where y is 0.
fn power(x: f32, y: f32) -> f32 {
    if y == 0.0 {
        1.0
    } else if x > 0.0 {
        x.powf(y)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falloff_is_opengls() {
        assert_eq!(attenuation(Vec3::new(1.0, 0.0, 0.0), 1e9), 1.0);
        assert_eq!(attenuation(Vec3::new(1.0, 0.5, 0.25), 2.0), 1.0 / 3.0);
        let cone = Spot { axis: Vec3::NEG_Y, cos_cutoff: 0.5, exponent: 2.0 };
        assert_eq!(spot(&cone, Vec3::NEG_Y), 1.0);
        assert_eq!(spot(&cone, Vec3::new(0.6, -0.8, 0.0)), 0.8 * 0.8);
        assert_eq!(spot(&cone, Vec3::new(0.96, -0.28, 0.0)), 0.0);
        assert_eq!(spot(&Spot { cos_cutoff: -1.0, ..cone }, Vec3::Y), 1.0);
        assert_eq!(spot(&Spot { exponent: 0.0, ..cone }, Vec3::NEG_Y), 1.0);
    }

    #[test]
    fn nothing_is_infinite_at_the_light() {
        for coefficients in [Vec3::Z, Vec3::Y, Vec3::ZERO, Vec3::new(0.0, 1e-38, 1e-45)] {
            let strength = attenuation(coefficients, 0.0);
            assert!(strength.is_finite() && strength > 0.0, "{coefficients}: {strength}");
        }
        assert_eq!((attenuation(Vec3::Z, f32::INFINITY), attenuation(Vec3::ONE, f32::NAN)), (0.0, 0.0));
        let cone = Spot { axis: Vec3::Z, cos_cutoff: 0.0, exponent: 128.0 };
        assert!(spot(&cone, Vec3::ZERO).is_finite());
    }
}
