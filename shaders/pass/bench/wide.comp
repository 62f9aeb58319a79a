// One ray a thread through bvh.glsl, all of it opaque triangles, for measurements.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

bool accept_hit(uint instance, uint primitive, vec2 barycentrics) {
    return true;
}

#define BVH_SPHERES false
#include "bvh.glsl"
#include "bench/rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool ANY_HIT = false;

layout(push_constant, scalar) uniform Constants {
    uint64_t structure;
    Rays rays;
    Answers answers;
    uint count;
};

void main() {
    uint index = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
    if (index >= count) {
        return;
    }
    RayRecord ray = rays.ray[index];
    Hit hit;
    bool found = bvh_trace(structure, ray.origin, ray.t_min, ray.direction, ray.t_max, 1u, ANY_HIT, hit);
    answers.answer[index] = Answer(hit.t, hit.barycentrics, hit.primitive, hit.instance, uint(found) | uint(hit.front) << 1);
}
