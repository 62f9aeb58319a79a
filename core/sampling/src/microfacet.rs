//! GGX with separable Smith shadowing: the twin of `bsdf.glsl`, first part. Vectors are of a local frame whose z is
//! the surface's normal.

use crate::caps::cap_direction_z;
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;

/// Roughness squared, at least 1e-3 (so that D stays below 4e5), whatever roughness is.
pub fn alpha_of(roughness: f32) -> f32 {
    let sane = if roughness > 0.0 { roughness.min(1.0) } else { 0.0 };
    (sane * sane).max(1e-3)
}

/// Schlick, An Inexpensive BRDF Model for Physically-Based Rendering, 1994.
pub fn schlick(f0: Vec3, cos_half: f32) -> Vec3 {
    let away = (1.0 - cos_half).clamp(0.0, 1.0);
    let away_2 = away * away;
    f0 + (1.0 - f0) * (away_2 * away_2 * away)
}

/// D of a half vector, given the squares of its sine and cosine to the normal (Walter and others, Microfacet Models
/// for Refraction, 2007, equation 33).
pub(crate) fn ggx_of_squares(alpha: f32, sin2: f32, cos2: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let stretched = sin2 + alpha2 * cos2;
    FRAC_1_PI * alpha2 / (stretched * stretched)
}

/// D by the cosine alone. Exact for that cosine; but near 1 its last digit is much at small alpha.
pub fn ggx_d(alpha: f32, cos_h: f32) -> f32 {
    ggx_of_squares(alpha, ((1.0 - cos_h) * (1.0 + cos_h)).max(0.0), cos_h * cos_h)
}

/// 2 cos / G1.
pub(crate) fn smith_denominator(alpha: f32, cos_direction: f32) -> f32 {
    let alpha2 = alpha * alpha;
    cos_direction + (alpha2 + (1.0 - alpha2) * cos_direction * cos_direction).sqrt()
}

/// Share of the microfacets that are seen from a direction above the horizon (Walter and others 2007, equation 34).
pub fn smith_g1(alpha: f32, cos_direction: f32) -> f32 {
    if cos_direction > 0.0 {
        (2.0 * cos_direction / smith_denominator(alpha, cos_direction)).min(1.0)
    } else {
        0.0
    }
}

/// A microfacet's normal, as likely as it is seen from `wo`: the reflected directions of a stretched hemisphere make
/// a cap (Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023).
pub fn sample_visible_normal(wo: Vec3, alpha: f32, random: Vec2) -> Vec3 {
    let view = unit((alpha * wo.truncate()).extend(wo.z));
    let reflected = cap_direction_z(1.0 + view.z, random);
    // At the cap's rim both can cancel altogether.
    let half_way = (reflected.truncate() + view.truncate()).extend((reflected.z + view.z).max(1e-7));
    unit((alpha * half_way.truncate()).extend(half_way.z))
}

/// GLSL's `normalize`.
fn unit(vector: Vec3) -> Vec3 {
    vector * (1.0 / vector.dot(vector).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Mean, draws};

    const ALPHAS: [f32; 7] = [1e-3, 2e-3, 0.01, 0.04, 0.16, 0.5, 1.0];

    #[test]
    fn any_roughness_is_a_lobe() {
        assert_eq!(alpha_of(0.5), 0.25);
        assert_eq!(alpha_of(9.0), 1.0);
        for nothing in [0.0, -0.0, 1e-4, 1e-3, -1.0, f32::NAN, f32::NEG_INFINITY, 1e-45] {
            assert_eq!(alpha_of(nothing), 1e-3, "{nothing}");
        }
        assert_eq!(alpha_of(f32::INFINITY), 1.0);
    }

    /// The integral of a function of the cosine over the hemisphere, where D is not flat: tan(theta) is alpha
    /// sqrt(x / (1 - x)) with x uniform under D cos.
    fn over_normals(alpha: f32, value: impl Fn(f64, f64) -> f64) -> f64 {
        let (alpha2, steps) = (f64::from(alpha).powi(2), 4000);
        let sum = (0..steps).map(|i| {
            let x = (f64::from(i) + 0.5) / f64::from(steps);
            let tan2 = alpha2 * x / (1.0 - x);
            let (sin2, cos) = (tan2 / (1.0 + tan2), (1.0 + tan2).sqrt().recip());
            // D cos dw = dx, by the closed form of D.
            let d = alpha2 / (std::f64::consts::PI * (sin2 + alpha2 * cos * cos).powi(2));
            value(sin2, cos) / (d * cos)
        });
        sum.sum::<f64>() / f64::from(steps)
    }

    #[test]
    fn normals_project_onto_one() {
        for alpha in ALPHAS {
            let of_squares =
                |sin2: f64, cos: f64| f64::from(ggx_of_squares(alpha, sin2 as f32, (cos * cos) as f32)) * cos;
            let integral = over_normals(alpha, of_squares);
            assert!((integral - 1.0).abs() < 2e-6, "{alpha}: {integral}");
            // By the cosine alone it is a step function for small alpha: one unit of the cosine is (3.5e-4)^2.
            let integral = over_normals(alpha, |_, cos| f64::from(ggx_d(alpha, cos as f32)) * cos);
            let most = if alpha < 0.01 { 0.05 } else { 1e-4 };
            assert!((integral - 1.0).abs() < most, "{alpha}: {integral}");
        }
    }

    #[test]
    fn densities_are_finite_where_they_are_greatest() {
        let peak = ggx_d(1e-3, 1.0);
        assert!((f64::from(peak) * std::f64::consts::PI * 1e-6 - 1.0).abs() < 1e-6, "{peak}");
        assert!(peak < 4e5);
        for alpha in ALPHAS {
            for cos in [0.0, 1e-6, 1e-4, 0.5, 1.0, 1.000_000_1] {
                let (d, g1) = (ggx_d(alpha, cos), smith_g1(alpha, cos));
                assert!(d.is_finite() && d > 0.0 && (0.0..=1.0).contains(&g1), "{alpha} {cos}: {d} {g1}");
            }
        }
    }

    #[test]
    fn shadowing_is_smiths_function() {
        for alpha in ALPHAS {
            for cos in [1e-6f32, 1e-4, 0.05, 0.3, 0.9, 1.0] {
                let (a, c) = (f64::from(alpha), f64::from(cos));
                let tan2 = (1.0 - c * c) / (c * c);
                let expected = 2.0 / (1.0 + (1.0 + a * a * tan2).sqrt());
                let ratio = f64::from(smith_g1(alpha, cos)) / expected;
                assert!((ratio - 1.0).abs() < 1e-6, "{alpha} {cos}: {ratio}");
            }
        }
        assert_eq!((smith_g1(0.1, 0.0), smith_g1(0.1, -0.3)), (0.0, 0.0));
    }

    #[test]
    fn fresnel_averages_to_its_closed_form() {
        // Over the cosine-weighted hemisphere: f0 + (1 - f0) / 21.
        let f0 = Vec3::new(0.04, 0.0, 0.9);
        let mut sum = glam::DVec3::ZERO;
        for i in 0..20_000 {
            let cos = (f64::from(i) + 0.5) / 20_000.0;
            sum += schlick(f0, cos as f32).as_dvec3() * 2.0 * cos / 20_000.0;
        }
        let expected = f0.as_dvec3() + (1.0 - f0.as_dvec3()) / 21.0;
        assert!((sum - expected).abs().max_element() < 1e-6, "{sum} {expected}");
        assert_eq!((schlick(f0, 1.0), schlick(f0, 0.0)), (f0, f0 + (1.0 - f0)));
    }

    #[test]
    fn visible_normals_are_visible_unit_vectors() {
        for random in draws(11, 100_000) {
            let alpha = alpha_of(random.x);
            let cos = if random.y < 0.1 { 1e-6 } else { random.y };
            let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            let normal = sample_visible_normal(wo, alpha, Vec2::new(random.z, random.w));
            assert!(normal.z > 0.0 && (normal.length() - 1.0).abs() < 1e-6, "{normal}");
            assert!(normal.dot(wo) > -1e-6, "{normal} {wo}");
        }
    }

    #[test]
    fn normals_seen_from_above_are_distributed_as_d_times_cosine() {
        // tan^2 / (tan^2 + alpha^2) is uniform then, for mirrors too.
        for alpha in ALPHAS {
            let (mut first, mut second) = (Mean::new(), Mean::new());
            for random in draws(12, 100_000) {
                let n = sample_visible_normal(Vec3::Z, alpha, Vec2::new(random.x, random.y)).as_dvec3();
                let tan2 = n.truncate().length_squared() / (n.z * n.z);
                let x = tan2 / (tan2 + f64::from(alpha).powi(2));
                first.add(x);
                second.add(x * x);
            }
            first.assert_near(0.5, 5.0);
            second.assert_near(1.0 / 3.0, 5.0);
        }
    }

    #[test]
    fn the_corners_of_the_square_are_normals_too() {
        let most = 1.0 - f32::EPSILON / 2.0;
        for (x, y) in [(0.0, 0.0), (0.0, 0.5), (0.5, 0.5), (most, 0.0), (most, most), (0.0, most)] {
            for cos in [1e-30, 1e-6, 0.7, 1.0f32] {
                for alpha in ALPHAS {
                    for turn in [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::new(0.6, -0.8, 0.0)] {
                        let wo = turn * (1.0 - cos * cos).sqrt() + Vec3::Z * cos;
                        let normal = sample_visible_normal(wo, alpha, Vec2::new(x, y));
                        assert!((normal.length() - 1.0).abs() < 1e-6, "{x} {y} {cos} {alpha}: {normal}");
                    }
                }
            }
        }
    }
}
