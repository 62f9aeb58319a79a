//! How surfaces reflect: a Lambertian lobe and a GGX lobe without multiple scattering, evaluated and sampled. The
//! twin of `bsdf.glsl`, second part.
//!
//! Directions are unit vectors of a local frame whose z is the normal: `wo` goes to the viewer, `wi` to the light.
//! Values hold the cosine to the light.
//!
//! F D G / (4 cos_o cos_i) is never computed so. With separable Smith shadowing, G1(o) / cos_o is
//! 2 / (cos_o + sqrt(alpha^2 + (1 - alpha^2) cos_o^2)), which is finite at grazing; and half vectors near the normal
//! enter by their x and y, since the cosine of a small angle has no digits left for alpha^2 = 1e-6.

use crate::color::{LEAST_LUMINANCE, luminance};
use crate::directions::disc_point;
use crate::microfacet::{ggx_of_squares, sample_visible_normal, schlick, smith_denominator, smith_g1};
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;

/// Share of the samples that each lobe has at least; bounds what a sample can weigh.
pub const LEAST_LOBE_CHANCE: f32 = 0.05;

/// How a surface reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bsdf {
    /// Share reflected by the Lambertian lobe.
    pub diffuse: Vec3,
    /// Schlick's F0; 0: there is no specular lobe.
    pub specular: Vec3,
    /// Of GGX, from [`crate::microfacet::alpha_of`].
    pub alpha: f32,
}

/// A direction that [`sample_bsdf`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// To the light.
    pub wi: Vec3,
    /// Value over density; 0 where nothing is reflected that way.
    pub weight: Vec3,
    /// Density of the mixture of both lobes, per steradian.
    pub pdf: f32,
    /// Which lobe was followed.
    pub is_specular: bool,
}

/// Whether the Lambertian lobe is there.
pub fn has_diffuse(bsdf: &Bsdf) -> bool {
    luminance(bsdf.diffuse) >= LEAST_LUMINANCE
}

/// Whether the GGX lobe is there.
pub fn has_specular(bsdf: &Bsdf) -> bool {
    luminance(bsdf.specular) >= LEAST_LUMINANCE
}

/// The unit vector between two directions above the horizon.
pub fn half_vector(wo: Vec3, wi: Vec3) -> Vec3 {
    let sum = wo + wi;
    let length2 = sum.dot(sum);
    if length2 > 1e-20 { sum * (1.0 / length2.sqrt()) } else { Vec3::Z }
}

/// Density of visible normals' reflections, per steradian, at a half vector: D G1(o) / (4 cos_o).
fn reflection_pdf(alpha: f32, cos_o: f32, half_way: Vec3) -> f32 {
    let flat = half_way.truncate();
    let normals = ggx_of_squares(alpha, flat.dot(flat), half_way.z * half_way.z);
    normals / (2.0 * smith_denominator(alpha, cos_o))
}

fn above_horizon(wo: Vec3, wi: Vec3) -> bool {
    wo.z > 0.0 && wi.z > 0.0
}

/// Density of the Lambertian lobe, per steradian.
pub fn diffuse_pdf(wi: Vec3) -> f32 {
    FRAC_1_PI * wi.z.max(0.0)
}

/// Density of the GGX lobe, per steradian; what is reflected below the horizon is lost, so that over the hemisphere this
/// is less than 1.
pub fn specular_pdf(bsdf: &Bsdf, wo: Vec3, wi: Vec3) -> f32 {
    if !has_specular(bsdf) || !above_horizon(wo, wi) {
        return 0.0;
    }
    reflection_pdf(bsdf.alpha, wo.z, half_vector(wo, wi))
}

/// Lambert's BRDF times the cosine.
pub fn diffuse_value(bsdf: &Bsdf, wi: Vec3) -> Vec3 {
    bsdf.diffuse * diffuse_pdf(wi)
}

/// F D G / (4 cos_o): the BRDF times the cosine.
pub fn specular_value(bsdf: &Bsdf, wo: Vec3, wi: Vec3) -> Vec3 {
    if !has_specular(bsdf) || !above_horizon(wo, wi) {
        return Vec3::ZERO;
    }
    let half_way = half_vector(wo, wi);
    let reflected = schlick(bsdf.specular, wo.dot(half_way));
    reflected * smith_g1(bsdf.alpha, wi.z) * reflection_pdf(bsdf.alpha, wo.z, half_way)
}

/// How often the specular lobe is followed.
pub fn specular_chance(bsdf: &Bsdf, wo: Vec3) -> f32 {
    if !has_specular(bsdf) {
        return 0.0;
    }
    if !has_diffuse(bsdf) {
        return 1.0;
    }
    let specular = luminance(schlick(bsdf.specular, wo.z));
    let chance = specular / (specular + luminance(bsdf.diffuse));
    chance.clamp(LEAST_LOBE_CHANCE, 1.0 - LEAST_LOBE_CHANCE)
}

/// Density of [`sample_bsdf`], per steradian.
pub fn bsdf_pdf(bsdf: &Bsdf, wo: Vec3, wi: Vec3) -> f32 {
    let chance = specular_chance(bsdf, wo);
    chance * specular_pdf(bsdf, wo, wi) + (1.0 - chance) * diffuse_pdf(wi)
}

/// A direction to the light: `choice` chooses the lobe, `random` the direction.
pub fn sample_bsdf(bsdf: &Bsdf, wo: Vec3, choice: f32, random: Vec2) -> BsdfSample {
    let is_specular = choice < specular_chance(bsdf, wo);
    let wi = if is_specular {
        let normal = sample_visible_normal(wo, bsdf.alpha, random);
        2.0 * wo.dot(normal) * normal - wo
    } else {
        let disc = disc_point(random);
        disc.extend((1.0 - disc.dot(disc)).max(0.0).sqrt())
    };
    let pdf = if wo.z > 0.0 { bsdf_pdf(bsdf, wo, wi) } else { 0.0 };
    let value = diffuse_value(bsdf, wi) + specular_value(bsdf, wo, wi);
    let weight = if pdf > 0.0 { value / pdf } else { Vec3::ZERO };
    BsdfSample { wi, weight, pdf, is_specular }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::microfacet::alpha_of;

    const PLASTIC: Bsdf = Bsdf { diffuse: Vec3::splat(0.5), specular: Vec3::splat(0.04), alpha: 0.1 };

    fn at(cos: f32) -> Vec3 {
        Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
    }

    #[test]
    fn a_lobe_that_is_there_is_followed_and_no_other() {
        let lone = |diffuse, specular| specular_chance(&Bsdf { diffuse, specular, alpha: 0.1 }, at(0.5));
        let (faint, bright) = (Vec3::splat(1e-6), Vec3::ONE);
        assert_eq!((lone(bright, Vec3::ZERO), lone(Vec3::ZERO, faint)), (0.0, 1.0));
        assert_eq!((lone(bright, Vec3::splat(1e-21)), lone(Vec3::splat(1e-38), bright)), (0.0, 1.0));
        assert_eq!((lone(bright, faint), lone(faint, bright)), (LEAST_LOBE_CHANCE, 1.0 - LEAST_LOBE_CHANCE));
        assert_eq!(lone(Vec3::ZERO, Vec3::ZERO), 0.0);
        assert_eq!(lone(Vec3::splat(f32::NAN), Vec3::splat(f32::NAN)), 0.0);
    }

    #[test]
    fn reflection_is_reciprocal() {
        for random in crate::testing::draws(21, 20_000) {
            let bsdf = Bsdf { alpha: alpha_of(random.x), ..PLASTIC };
            let (wo, wi) = (at(random.y.max(0.01)), at(random.z.max(0.01)));
            let wi = Vec3::new(wi.x * random.w, wi.x * (1.0 - random.w * random.w).sqrt(), wi.z);
            let there = specular_value(&bsdf, wo, wi) / wi.z;
            let back = specular_value(&bsdf, wi, wo) / wo.z;
            assert!((there / back - 1.0).abs().max_element() < 1e-5, "{there} {back}");
        }
    }

    #[test]
    fn the_cancelled_form_is_the_formula() {
        for random in crate::testing::draws(22, 40_000) {
            // Anywhere, or where a mirror would reflect, give or take alpha.
            let bsdf = Bsdf { alpha: alpha_of(random.x), ..PLASTIC };
            let wo = at(random.y.max(0.01));
            let anywhere = at(random.z.max(0.01)) * Vec3::new(2.0 * random.w - 1.0, 1.0, 1.0);
            let aside = (Vec3::new(random.w, random.z, 0.5) - 0.5) * bsdf.alpha;
            let wi =
                if random.w < 0.5 { anywhere } else { wo * Vec3::new(-1.0, 1.0, 1.0) + aside }.normalize();
            let (o, i) = (wo.as_dvec3(), wi.as_dvec3());
            let h = (o + i).normalize();
            let a2 = f64::from(bsdf.alpha).powi(2);
            let d = a2 / (std::f64::consts::PI * (h.z * h.z * (a2 - 1.0) + 1.0).powi(2));
            let g1 = |c: f64| 2.0 / (1.0 + (1.0 + a2 * (1.0 - c * c) / (c * c)).sqrt());
            let f = 0.04 + 0.96 * (1.0 - o.dot(h)).powi(5);
            let expected = f * d * g1(o.z) * g1(i.z) / (4.0 * o.z);
            let ratio = f64::from(specular_value(&bsdf, wo, wi).x) / expected;
            // The half vector's x and y are as exact as the directions', beside alpha.
            let rounding = 1e-6 + 2e-7 / (f64::from(bsdf.alpha) * (o + i).length());
            assert!((ratio - 1.0).abs() < 8.0 * rounding, "{bsdf:?} {wo} {wi}: {ratio}");
        }
    }

    #[test]
    fn grazing_light_is_finite() {
        for alpha in [1e-3, 0.01, 0.3, 1.0] {
            for cos_o in [1e-6, 1e-4, 1.0] {
                for cos_i in [1e-6, 1e-4, 1.0] {
                    for side in [Vec3::ONE, Vec3::new(-1.0, 1.0, 1.0)] {
                        let bsdf = Bsdf { alpha, ..PLASTIC };
                        let (wo, wi) = (at(cos_o), at(cos_i) * side);
                        let value = specular_value(&bsdf, wo, wi);
                        let pdf = bsdf_pdf(&bsdf, wo, wi);
                        assert!(
                            value.is_finite() && value.min_element() >= 0.0,
                            "{alpha} {wo} {wi}: {value}"
                        );
                        assert!(pdf.is_finite() && pdf > 0.0, "{alpha} {wo} {wi}: {pdf}");
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_comes_from_below() {
        let (above, below) = (at(0.5), -at(0.5));
        assert_eq!((bsdf_pdf(&PLASTIC, above, below), diffuse_pdf(below)), (0.0, 0.0));
        assert_eq!(specular_value(&PLASTIC, above, below), Vec3::ZERO);
        for choice in [0.0, 0.99] {
            let sample = sample_bsdf(&PLASTIC, below, choice, Vec2::new(0.3, 0.7));
            assert_eq!((sample.weight, sample.pdf), (Vec3::ZERO, 0.0));
            assert!(sample.wi.is_finite());
        }
    }

    #[test]
    fn a_white_lambertian_surface_loses_nothing() {
        let white = Bsdf { diffuse: Vec3::ONE, specular: Vec3::ZERO, alpha: 1.0 };
        for random in crate::testing::draws(23, 10_000) {
            let sample = sample_bsdf(&white, at(0.3), random.x, Vec2::new(random.y, random.z));
            assert_eq!(sample.weight, Vec3::ONE, "{sample:?}");
        }
    }
}
