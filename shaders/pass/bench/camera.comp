// Rays of a pinhole camera, one a pixel, for measurements. Pixels go in tiles of 8x4, as rays are traced together.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "bench/rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Constants {
    Rays rays;
    uvec2 size; // in pixels, multiples of 8 and 4
    vec3 eye;
    vec3 right;   // half the picture's width, at distance 1
    vec3 up;      // half its height
    vec3 forward; // of length 1
};

void main() {
    uint index = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
    if (index >= size.x * size.y) {
        return;
    }
    uint tile = index / 32u, inside = index % 32u, across = size.x / 8u;
    uvec2 pixel = uvec2(tile % across, tile / across) * uvec2(8u, 4u) + uvec2(inside % 8u, inside / 8u);
    vec2 at = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
    vec3 direction = normalize(forward + at.x * right - at.y * up);
    rays.ray[index] = RayRecord(eye, 0.0, direction, 1.0 / 0.0);
}
