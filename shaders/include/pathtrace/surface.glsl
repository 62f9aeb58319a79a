// Packing of what a pixel shows.

#ifndef AFTERGLOW_PATHTRACE_SURFACE_GLSL
#define AFTERGLOW_PATHTRACE_SURFACE_GLSL

#include "color.glsl"
#include "packing.glsl"
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

// The kind is a SURFACE_ constant, the mask that of the instances which rays from here see, the edge as edge.glsl has it.
uint pack_properties(float fog, float roughness, uint kind, uint mask, uint edge) {
    return packUnorm4x8(vec4(fog, roughness, 0.0, 0.0)) | kind << 16 | mask << 20 | edge << 24;
}

// How much of a surface the program's fog leaves.
float surface_fog(SurfaceTexel surface) {
    return unpackUnorm4x8(surface.properties).x;
}

float surface_roughness(SurfaceTexel surface) {
    return unpackUnorm4x8(surface.properties).y;
}

uint surface_kind(SurfaceTexel surface) {
    return (surface.properties >> 16) & 15u;
}

uint surface_ray_mask(SurfaceTexel surface) {
    return (surface.properties >> 20) & 15u;
}

uint surface_edge(SurfaceTexel surface) {
    return surface.properties >> 24;
}

// Whether a surface scatters light diffusely: metals do not.
bool has_diffuse_lobe(SurfaceTexel surface) {
    return surface.albedo != 0u || surface.specular == 0u;
}

// What specular light is divided by on its way, so that what varies in the material stays sharp.
vec3 specular_share(SurfaceTexel surface) {
    return surface.specular == 0u ? vec3(1.0) : max(linear_from_srgb(unpack_unorm11(surface.specular)), 0.02);
}

// Whether traced light takes the place of baked light.
bool is_relit(ViewRecord view) {
    return view.bounce.x >= 0.0;
}

#endif
