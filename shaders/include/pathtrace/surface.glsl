// Packing of what a pixel shows.

#ifndef AFTERGLOW_PATHTRACE_SURFACE_GLSL
#define AFTERGLOW_PATHTRACE_SURFACE_GLSL

#include "tables.glsl"

// Unit vectors on an octahedron (Cigolle and others, A Survey of Efficient Representations for
// Independent Unit Vectors, JCGT 2014).
uint pack_unit_vector(vec3 unit) {
    vec2 flat_xy = unit.xy / (abs(unit.x) + abs(unit.y) + abs(unit.z));
    vec2 folded = (1.0 - abs(flat_xy.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(flat_xy, vec2(0.0)));
    return packSnorm2x16(unit.z < 0.0 ? folded : flat_xy);
}

vec3 unpack_unit_vector(uint word) {
    vec2 flat_xy = unpackSnorm2x16(word);
    vec3 unit = vec3(flat_xy, 1.0 - abs(flat_xy.x) - abs(flat_xy.y));
    float fold = max(-unit.z, 0.0);
    unit.xy += mix(vec2(fold), vec2(-fold), greaterThanEqual(unit.xy, vec2(0.0)));
    return normalize(unit);
}

// The kind is a SURFACE_ constant, the mask that of the instances which rays from here see.
uint surface_kind(SurfaceTexel surface) {
    return (surface.emission >> 24) & 15u;
}

uint surface_ray_mask(SurfaceTexel surface) {
    return surface.emission >> 28;
}

// Whether a surface scatters light diffusely: metals do not.
bool has_diffuse_lobe(SurfaceTexel surface) {
    return (surface.albedo & 0xffffffu) != 0u || (surface.specular & 0xffffffu) == 0u;
}

// Whether traced light takes the place of baked light.
bool is_relit(ViewRecord view) {
    return view.bounce.x >= 0.0;
}

// Three components of [0, 1] and a byte above them.
uint pack_color(vec3 color, uint byte) {
    return packUnorm4x8(vec4(color, 0.0)) | byte << 24;
}

vec3 unpack_color(uint word) {
    return unpackUnorm4x8(word).rgb;
}

float unpack_fourth(uint word) {
    return unpackUnorm4x8(word).a;
}

#endif
