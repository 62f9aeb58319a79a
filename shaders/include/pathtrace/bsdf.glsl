// How surfaces reflect: a Lambertian lobe and a GGX lobe without multiple scattering, evaluated and sampled. Directions are
// unit vectors of a local frame whose z is the normal: `wo` goes to the viewer, `wi` to the light.
// Values hold the cosine to the light. The twin of core/sampling/src/bsdf.rs and microfacet.rs: same names, same order of
// operations.
//
// F D G / (4 cos_o cos_i) is never computed so. With separable Smith shadowing, G1(o) / cos_o is
// 2 / (cos_o + sqrt(alpha^2 + (1 - alpha^2) cos_o^2)), which is finite at grazing; and half vectors near the normal enter by
// their x and y, since the cosine of a small angle has no digits left for alpha^2 = 1e-6.

#ifndef AFTERGLOW_PATHTRACE_BSDF_GLSL
#define AFTERGLOW_PATHTRACE_BSDF_GLSL

#include "color.glsl"
#include "sampling.glsl"

struct Bsdf {
    vec3 diffuse; // share reflected by the Lambertian lobe
    vec3 specular; // Schlick's F0; 0: there is no specular lobe
    float alpha; // of GGX, from `alpha_of`
};

struct BsdfSample {
    vec3 wi;
    vec3 weight; // value over density; 0 where nothing is reflected that way
    float pdf; // of the mixture of both lobes, per steradian
    bool is_specular; // which lobe was followed
};

#define ONE_OVER_PI 0.318309886184
// Luminance below this is black: devices may flush what comes of it.
#define LEAST_LUMINANCE 1e-20
// Share of the samples that each lobe has at least; bounds what a sample can weigh.
#define LEAST_LOBE_CHANCE 0.05

// Roughness squared, at least 1e-3 (so that D stays below 4e5), whatever roughness is.
float alpha_of(float roughness) {
    // Not max(): what that makes of NaN is not defined.
    float sane = roughness > 0.0 ? min(roughness, 1.0) : 0.0;
    return max(sane * sane, 1e-3);
}

// Schlick, An Inexpensive BRDF Model for Physically-Based Rendering, 1994.
vec3 schlick(vec3 f0, float cos_half) {
    float away = clamp(1.0 - cos_half, 0.0, 1.0);
    float away_2 = away * away;
    return f0 + (1.0 - f0) * (away_2 * away_2 * away);
}

// D of a half vector, given the squares of its sine and cosine to the normal (Walter and others, Microfacet
// Models for Refraction, 2007, equation 33).
float ggx_of_squares(float alpha, float sin2, float cos2) {
    float alpha2 = alpha * alpha;
    float stretched = sin2 + alpha2 * cos2;
    return ONE_OVER_PI * alpha2 / (stretched * stretched);
}

// D by the cosine alone. Exact for that cosine; but near 1 its last digit is much at small alpha.
float ggx_d(float alpha, float cos_h) {
    return ggx_of_squares(alpha, max((1.0 - cos_h) * (1.0 + cos_h), 0.0), cos_h * cos_h);
}

// 2 cos / G1.
float smith_denominator(float alpha, float cos_direction) {
    float alpha2 = alpha * alpha;
    return cos_direction + sqrt(alpha2 + (1.0 - alpha2) * cos_direction * cos_direction);
}

// Share of the microfacets that are seen from a direction above the horizon (Walter and others 2007, equation 34).
float smith_g1(float alpha, float cos_direction) {
    return cos_direction > 0.0 ? min(2.0 * cos_direction / smith_denominator(alpha, cos_direction), 1.0) : 0.0;
}

// A microfacet's normal, as likely as it is seen from `wo`: the reflected directions of a stretched hemisphere
// make a cap (Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023).
vec3 sample_visible_normal(vec3 wo, float alpha, vec2 random) {
    vec3 view = normalize(vec3(alpha * wo.xy, wo.z));
    vec3 reflected = cap_direction_z(1.0 + view.z, random);
    // At the cap's rim both can cancel altogether.
    vec3 half_way = vec3(reflected.xy + view.xy, max(reflected.z + view.z, 1e-7));
    return normalize(vec3(alpha * half_way.xy, half_way.z));
}

bool has_diffuse(Bsdf bsdf) {
    return luminance(bsdf.diffuse) >= LEAST_LUMINANCE;
}

bool has_specular(Bsdf bsdf) {
    return luminance(bsdf.specular) >= LEAST_LUMINANCE;
}

// The unit vector between two directions above the horizon.
vec3 half_vector(vec3 wo, vec3 wi) {
    vec3 sum = wo + wi;
    float length2 = dot(sum, sum);
    return length2 > 1e-20 ? sum * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
}

// Density of visible normals' reflections, per steradian, at a half vector: D G1(o) / (4 cos_o).
float reflection_pdf(float alpha, float cos_o, vec3 half_way) {
    float normals = ggx_of_squares(alpha, dot(half_way.xy, half_way.xy), half_way.z * half_way.z);
    return normals / (2.0 * smith_denominator(alpha, cos_o));
}

bool above_horizon(vec3 wo, vec3 wi) {
    return wo.z > 0.0 && wi.z > 0.0;
}

float diffuse_pdf(vec3 wi) {
    return ONE_OVER_PI * max(wi.z, 0.0);
}

// Per steradian; what is reflected below the horizon is lost, so that over the hemisphere this is less than 1.
float specular_pdf(Bsdf bsdf, vec3 wo, vec3 wi) {
    if (!has_specular(bsdf) || !above_horizon(wo, wi)) {
        return 0.0;
    }
    return reflection_pdf(bsdf.alpha, wo.z, half_vector(wo, wi));
}

// Lambert's BRDF times the cosine.
vec3 diffuse_value(Bsdf bsdf, vec3 wi) {
    return bsdf.diffuse * diffuse_pdf(wi);
}

// F D G / (4 cos_o): the BRDF times the cosine.
vec3 specular_value(Bsdf bsdf, vec3 wo, vec3 wi) {
    if (!has_specular(bsdf) || !above_horizon(wo, wi)) {
        return vec3(0.0);
    }
    vec3 half_way = half_vector(wo, wi);
    vec3 reflected = schlick(bsdf.specular, dot(wo, half_way));
    return reflected * smith_g1(bsdf.alpha, wi.z) * reflection_pdf(bsdf.alpha, wo.z, half_way);
}

// How often the specular lobe is followed.
float specular_chance(Bsdf bsdf, vec3 wo) {
    if (!has_specular(bsdf)) {
        return 0.0;
    }
    if (!has_diffuse(bsdf)) {
        return 1.0;
    }
    float specular = luminance(schlick(bsdf.specular, wo.z));
    float chance = specular / (specular + luminance(bsdf.diffuse));
    return clamp(chance, LEAST_LOBE_CHANCE, 1.0 - LEAST_LOBE_CHANCE);
}

// Density of `sample_bsdf`, per steradian.
float bsdf_pdf(Bsdf bsdf, vec3 wo, vec3 wi) {
    float chance = specular_chance(bsdf, wo);
    return chance * specular_pdf(bsdf, wo, wi) + (1.0 - chance) * diffuse_pdf(wi);
}

// A direction to the light: `choice` chooses the lobe, `random` the direction.
BsdfSample sample_bsdf(Bsdf bsdf, vec3 wo, float choice, vec2 random) {
    BsdfSample result;
    result.is_specular = choice < specular_chance(bsdf, wo);
    if (result.is_specular) {
        vec3 normal = sample_visible_normal(wo, bsdf.alpha, random);
        result.wi = 2.0 * dot(wo, normal) * normal - wo;
    } else {
        vec2 disc = disc_point(random);
        result.wi = vec3(disc, sqrt(max(1.0 - dot(disc, disc), 0.0)));
    }
    result.pdf = wo.z > 0.0 ? bsdf_pdf(bsdf, wo, result.wi) : 0.0;
    vec3 value = diffuse_value(bsdf, result.wi) + specular_value(bsdf, wo, result.wi);
    result.weight = result.pdf > 0.0 ? value / result.pdf : vec3(0.0);
    return result;
}

#endif
