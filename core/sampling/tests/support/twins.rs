//! What the shader `evaluate.comp` answers, on the CPU.

use afterglow_sampling::bsdf::{
    Bsdf, bsdf_pdf, diffuse_pdf, diffuse_value, sample_bsdf, specular_chance, specular_pdf, specular_value,
};
use afterglow_sampling::caps::{
    cap_direction, cap_direction_z, cap_one_minus_cos, cap_solid_angle, sphere_direction,
};
use afterglow_sampling::directions::{cosine_direction, disc_point, tangents, triangle_barycentrics};
use afterglow_sampling::finite::finite_radiance;
use afterglow_sampling::heuristics::{balance, power_heuristic};
use afterglow_sampling::microfacet::{alpha_of, ggx_d, sample_visible_normal, schlick, smith_g1};
use afterglow_sampling::random::{Random, independent, pcg4d, random_2d};
use afterglow_sampling::spherical_harmonics::{aside_of, irradiance_facing};
use bytemuck::{Pod, Zeroable};
use glam::{UVec4, Vec2, Vec3, Vec4};

/// What one thread is given.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Input {
    pub wo: [f32; 3],
    pub roughness: f32,
    pub wi: [f32; 3],
    pub choice: f32,
    pub diffuse: [f32; 3],
    pub sin2: f32,
    pub specular: [f32; 3],
    pub own: f32,
    pub axis: [f32; 3],
    pub other: f32,
    pub radiance: [f32; 3],
    pub cos_half: f32,
    pub words: [u32; 4],
    pub random: [f32; 2],
}

/// How near a device's answer must be.
#[derive(Clone, Copy, Debug)]
pub enum Tolerance {
    /// The same bits.
    Bits,
    /// Units in the last place (2^-23) of the largest component.
    Ulps(f32),
    /// So far in each component.
    Absolute(f32),
    /// The same, and of length 1.
    Direction(f32),
}

/// One function's answer.
pub struct Field {
    pub name: &'static str,
    pub tolerance: Tolerance,
    pub words: Vec<u32>,
}

/// Answers in the shader's order.
#[derive(Default)]
pub struct Fields(pub Vec<Field>);

impl Fields {
    fn bits(&mut self, name: &'static str, words: &[u32]) {
        self.0.push(Field { name, tolerance: Tolerance::Bits, words: words.to_vec() });
    }

    fn put(&mut self, name: &'static str, tolerance: Tolerance, values: &[f32]) {
        self.0.push(Field { name, tolerance, words: values.iter().map(|value| value.to_bits()).collect() });
    }

    fn ulps(&mut self, name: &'static str, values: &[f32]) {
        self.put(name, Tolerance::Ulps(ULPS), values);
    }

    /// A unit vector that `ill` times as much may be wrong with as its rounding.
    fn direction(&mut self, name: &'static str, values: Vec3, ill: f32) {
        self.put(name, Tolerance::Direction(DIRECTION * ill), &values.to_array());
    }

    /// How many words come before the next answer.
    fn offset(&self) -> usize {
        self.0.iter().map(|field| field.words.len()).sum()
    }
}

/// Rounding of formulas of a dozen operations: Vulkan allows 2.5 units for a division and a square root each, and products
/// and sums may be fused or not. (On lavapipe whatever no sine enters has the same bits.)
const ULPS: f32 = 16.0;
/// Rounding of a unit vector's component, with sine and cosine from a device's polynomials. Vulkan would allow 2^-11 for these;
/// devices are within a few units in the last place, and densities must not notice.
const DIRECTION: f32 = 2e-6;

/// How much rounding of a point of the disc grows at its rim, where the third coordinate is the root of what is left of 1.
fn at_rim(random: Vec2) -> f32 {
    let disc = disc_point(random);
    1.0 / (1.0 - disc.dot(disc)).max(1e-6).sqrt()
}

/// The same for visible normals, of which also nothing may be left where two vectors cancel.
fn at_normal(wo: Vec3, alpha: f32, random: Vec2) -> f32 {
    let view = (wo * Vec3::new(alpha, alpha, 1.0)).normalize();
    at_rim(random) / (cap_direction_z(1.0 + view.z, random) + view).length().max(1e-6)
}

/// All that the shader should answer. What follows from a sampled direction is computed from the device's own one, since
/// densities of narrow lobes differ much between directions that are the same but for rounding.
pub fn expected(given: &Input, answered: &[u32]) -> Fields {
    let mut fields = Fields::default();
    let bsdf = Bsdf {
        diffuse: given.diffuse.into(),
        specular: given.specular.into(),
        alpha: alpha_of(given.roughness),
    };
    directions(given, bsdf.alpha, &mut fields);
    reflection(given, &bsdf, &mut fields);
    sampled(given, &bsdf, answered, &mut fields);
    numbers(given, &mut fields);
    light(given, &mut fields);
    fields
}

fn directions(given: &Input, alpha: f32, fields: &mut Fields) {
    let (axis, random) = (Vec3::from(given.axis), Vec2::from(given.random));
    let [tangent, bitangent] = tangents(axis);
    fields.direction("tangent", tangent, 1.0);
    fields.direction("bitangent", bitangent, 1.0);
    fields.put("disc_point", Tolerance::Absolute(DIRECTION), &disc_point(random).to_array());
    fields.direction("cosine_direction", cosine_direction(axis, random), at_rim(random));
    fields.bits("triangle_barycentrics", &triangle_barycentrics(random).to_array().map(f32::to_bits));
    fields.ulps("cap_one_minus_cos", &[cap_one_minus_cos(given.sin2)]);
    fields.ulps("cap_solid_angle", &[cap_solid_angle(given.sin2)]);
    fields.direction("cap_direction", cap_direction(axis, given.sin2, random), 1.0);
    fields.direction("sphere_direction", sphere_direction(random), at_rim(random));
    let (wo, normal) = (Vec3::from(given.wo), sample_visible_normal(given.wo.into(), alpha, random));
    fields.direction("sample_visible_normal", normal, at_normal(wo, alpha, random));
}

fn reflection(given: &Input, bsdf: &Bsdf, fields: &mut Fields) {
    let (wo, wi) = (Vec3::from(given.wo), Vec3::from(given.wi));
    fields.ulps("alpha_of", &[bsdf.alpha]);
    fields.ulps("schlick", &schlick(bsdf.specular, given.cos_half).to_array());
    fields.ulps("ggx_d", &[ggx_d(bsdf.alpha, given.cos_half)]);
    fields.ulps("smith_g1", &[smith_g1(bsdf.alpha, given.cos_half)]);
    fields.ulps("diffuse_value", &diffuse_value(bsdf, wi).to_array());
    fields.ulps("specular_value", &specular_value(bsdf, wo, wi).to_array());
    fields.ulps("diffuse_pdf", &[diffuse_pdf(wi)]);
    fields.ulps("specular_pdf", &[specular_pdf(bsdf, wo, wi)]);
    fields.ulps("specular_chance", &[specular_chance(bsdf, wo)]);
    fields.ulps("bsdf_pdf", &[bsdf_pdf(bsdf, wo, wi)]);
}

fn sampled(given: &Input, bsdf: &Bsdf, answered: &[u32], fields: &mut Fields) {
    let wo = Vec3::from(given.wo);
    let chosen = sample_bsdf(bsdf, wo, given.choice, given.random.into());
    let own = fields.offset() + 1;
    let wi = Vec3::from_slice(bytemuck::cast_slice(&answered[own..own + 3]));
    let pdf = if wo.z > 0.0 { bsdf_pdf(bsdf, wo, wi) } else { 0.0 };
    let value = diffuse_value(bsdf, wi) + specular_value(bsdf, wo, wi);
    let weight = if pdf > 0.0 { value / pdf } else { Vec3::ZERO };
    fields.bits("sample_bsdf.is_specular", &[chosen.is_specular.into()]);
    let random = Vec2::from(given.random);
    let ill = if chosen.is_specular { 4.0 * at_normal(wo, bsdf.alpha, random) } else { at_rim(random) };
    fields.direction("sample_bsdf.wi", chosen.wi, ill);
    fields.ulps("sample_bsdf.pdf", &[pdf]);
    fields.ulps("sample_bsdf.weight", &weight.to_array());
}

fn numbers(given: &Input, fields: &mut Fields) {
    let [pixel, sample_index, dimension, seed] = given.words;
    fields.ulps("balance", &[balance(given.own, given.other)]);
    fields.ulps("power_heuristic", &[power_heuristic(given.own, given.other)]);
    let finite = finite_radiance(given.radiance.into());
    fields.ulps("finite_radiance", &finite.value.to_array());
    fields.bits(
        "finite_radiance's counts",
        &[u32::from(finite.was_finite) | u32::from(finite.was_capped) << 1],
    );
    fields.bits("pcg4d", &pcg4d(UVec4::from(given.words)).to_array());
    let numbers: Vec4 = independent(pixel, sample_index, dimension, seed);
    fields.bits("independent", &numbers.to_array().map(f32::to_bits));
    let point = random_2d(Random { pixel, sample_index }, dimension);
    fields.bits("random_2d", &point.to_array().map(f32::to_bits));
}

fn light(given: &Input, fields: &mut Fields) {
    let (axis, color, wo) = (Vec3::from(given.axis), Vec3::from(given.diffuse), Vec3::from(given.wo));
    // Terms of either sign: their sum is as near as the largest of them.
    fields.put("aside_of", Tolerance::Absolute(2e-6), &aside_of(axis, wo).to_array());
    let most = color.max_element() * 2e-6;
    let facing = irradiance_facing(color, axis * color.x, wo);
    fields.put("irradiance_facing", Tolerance::Absolute(10.0 * most), &facing.to_array());
}
