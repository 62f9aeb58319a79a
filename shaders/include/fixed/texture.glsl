// Texels of a unit (OpenGL 1.5, sections 3.8.8 and 3.8.14).
//
// The includer declares the bindless table (bindless.glsl).

#ifndef AFTERGLOW_FIXED_TEXTURE_GLSL
#define AFTERGLOW_FIXED_TEXTURE_GLSL

#include "../bindless.glsl"
#include "state.glsl"

// Where there are no derivatives, the includer defines another way to pick the level.
#ifndef SAMPLE_TEXTURE
#define SAMPLE_TEXTURE(combined, coordinates) texture(combined, coordinates)
#endif

// Where GL_CLAMP wraps a coordinate: bit 0 s, 1 t, 2 r. Its sampler then clamps to the border, which
// linear filtering so meets by half a texel at most.
vec3 clamped_coordinates(uint clamps, vec3 coordinates) {
    bvec3 clamped = bvec3((clamps & 1u) != 0u, (clamps & 2u) != 0u, (clamps & 4u) != 0u);
    return mix(coordinates, clamp(coordinates, 0.0, 1.0), clamped);
}

// A depth texel as the environment sees it.
vec4 depth_texel(UnitState unit, float depth, float reference) {
    float value = unit.compare == 0u
        ? depth : compare_passes(unit.compare - 1u, clamp(reference, 0.0, 1.0), depth) ? 1.0 : 0.0;
    switch (unit.depth_mode) {
        case DEPTH_MODE_INTENSITY: return vec4(value);
        case DEPTH_MODE_ALPHA: return vec4(0.0, 0.0, 0.0, value);
        default: return vec4(value, value, value, 1.0);
    }
}

// The texel of a unit, at coordinates of which q is 1 unless `projective`. `packed` is the image and
// its sampler, as DrawPush.textures holds them.
vec4 sample_unit(UnitState unit, uint packed, uint clamps, vec4 coordinates, bool projective) {
    if (unit.target == 0u) {
        return vec4(0.0);
    }
    uint image = packed & 0xfffffu;
    uint filtering = packed >> 20;
    if (unit.target == TARGET_CUBE) {
        return SAMPLE_TEXTURE(samplerCube(textures_cube[image], samplers[filtering]), coordinates.xyz);
    }
    vec3 at = projective ? coordinates.xyz / coordinates.w : coordinates.xyz;
    vec3 wrapped = clamped_coordinates(clamps, at);
    if (unit.target == TARGET_D3) {
        return SAMPLE_TEXTURE(sampler3D(textures_3d[image], samplers[filtering]), wrapped);
    }
    vec4 texel = SAMPLE_TEXTURE(sampler2D(textures_2d[image], samplers[filtering]), wrapped.xy);
    return unit.base_format == BASE_FORMAT_DEPTH ? depth_texel(unit, texel.x, at.z) : texel;
}

#endif
