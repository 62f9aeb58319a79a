// From what a program says of a surface to what light does there.

#ifndef AFTERGLOW_PATHTRACE_MATERIALS_GLSL
#define AFTERGLOW_PATHTRACE_MATERIALS_GLSL

#include "bsdf.glsl"
#include "color.glsl"
#include "tables.glsl"

// Albedo that light is carried on with, at most: closed white rooms have an end.
const float MOST_ALBEDO = 0.98;
// What water reflects straight on.
const float WATER = 0.02;
// What a surface that is no metal reflects straight on.
const float DIELECTRIC = 0.04;

// The lobe that is as wide as OpenGL's highlight and reflects as much: Blinn's exponent by the roughness (Walter and others,
// Microfacet Models for Refraction, 2007), normalised as in Akenine-Moeller and others, Real-Time Rendering, section 9.8.
// `specular` is linear. The program sees the falloff in sRGB, where 1 / 2.2 of an exponent falls as far. What reflects less
// than water does has no lobe: OpenGL's highlights do not grow at grazing angles, and Fresnel's law would make a wet road of
// each dull one.
vec4 highlight_lobe(ViewRecord view, vec3 specular, float shininess) {
    float exponent = 2.2 * clamp(shininess, 0.0, 128.0);
    float alpha = sqrt(2.0 / (exponent + 2.0));
    vec3 facing = specular * view.highlight * 8.0 / (exponent + 8.0);
    return luminance(facing) < WATER ? vec4(0.0) : vec4(facing, sqrt(alpha));
}

// Diffuse albedo, reflectance straight on, and roughness of a material by its albedo (linear), roughness and metallic.
Bsdf rough_bsdf(vec3 albedo, float roughness, float metallic) {
    return Bsdf(albedo * (1.0 - metallic), mix(vec3(DIELECTRIC), albedo, metallic), alpha_of(roughness));
}

Bsdf diffuse_bsdf(vec3 albedo) {
    return Bsdf(albedo, vec3(0.0), 1.0);
}

#endif
