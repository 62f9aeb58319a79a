// From object to eye space (OpenGL 1.5, section 2.11).

#ifndef AFTERGLOW_FIXED_TRANSFORM_GLSL
#define AFTERGLOW_FIXED_TRANSFORM_GLSL

#include "state.glsl"
#include "tables.glsl"

// A point as three coordinates; points at infinity stay directions.
vec3 dehomogenized(vec4 point) {
    return point.w == 0.0 || point.w == 1.0 ? point.xyz : point.xyz / point.w;
}

vec3 normal_eye(GlobalState state, mat3 normal_matrix, vec3 normal_object) {
    vec3 normal = normal_matrix * normal_object;
    if (state.normalize == NORMALIZE_FULLY) {
        float square = dot(normal, normal);
        normal = square > 0.0 ? normal * inversesqrt(square) : normal;
    }
    return normal;
}

// OpenGL's clip space, z from -w to w, to Vulkan's, z from 0 to w.
vec4 vulkan_clip(vec4 clip) {
    return vec4(clip.xy, (clip.z + clip.w) * 0.5, clip.w);
}

#endif
