// The yardstick of measurements: one ray a thread through a plain binary BVH, boxes in f32, one level.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "ray.glsl"
#include "bench/rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Four units a node: least corner and reference of the left child, its greatest corner, then the same
// of the right child. A reference is a node's unit, or 1 << 31 | count << 27 | first triangle.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Units {
    uvec4 unit[];
};

layout(push_constant, scalar) uniform Constants {
    Units nodes;
    Rays rays;
    Answers answers;
    uint count;
};

layout(constant_id = 0) const bool ANY_HIT = false;

float box_entry(uvec4 low, uvec4 high, vec3 origin, vec3 inverse, float t_min, float t_max) {
    vec3 a = (uintBitsToFloat(low.xyz) - origin) * inverse;
    vec3 b = (uintBitsToFloat(high.xyz) - origin) * inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float entry = max(max(near.x, near.y), max(near.z, t_min));
    float leave = min(min(far.x, far.y), min(far.z, t_max));
    return entry <= leave * 1.0000004 ? entry : -1.0;
}

void main() {
    uint index = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
    if (index >= count) {
        return;
    }
    RayRecord ray = rays.ray[index];
    RayShear shear = ray_shear(ray.direction);
    vec3 inverse = 1.0 / mix(ray.direction, vec3(1e-24), lessThan(abs(ray.direction), vec3(1e-24)));
    Answer answer = Answer(ray.t_max, vec2(0.0), 0u, 0u, 0u);
    uint first_triangle = nodes.unit[0].w;
    uint stack[64];
    uint height = 0u;
    uint reference = 1u;
    for (uint step = 0u; step < 262144u; ++step) {
        if ((reference & 0x80000000u) == 0u) {
            uvec4 low_left = nodes.unit[reference], high_left = nodes.unit[reference + 1u];
            uvec4 low_right = nodes.unit[reference + 2u], high_right = nodes.unit[reference + 3u];
            float left = box_entry(low_left, high_left, ray.origin, inverse, ray.t_min, answer.t);
            float right = box_entry(low_right, high_right, ray.origin, inverse, ray.t_min, answer.t);
            if (left >= 0.0 && right >= 0.0) {
                bool left_first = left <= right;
                stack[height++] = left_first ? low_right.w : low_left.w;
                reference = left_first ? low_left.w : low_right.w;
                continue;
            }
            if (left >= 0.0 || right >= 0.0) {
                reference = left >= 0.0 ? low_left.w : low_right.w;
                continue;
            }
        } else {
            uint first = reference & 0x7ffffffu;
            uint end = first + (reference >> 27 & 15u);
            for (uint triangle = first; triangle < end; ++triangle) {
                uint at = first_triangle + triangle * 3u;
                uvec4 x = nodes.unit[at], y = nodes.unit[at + 1u], z = nodes.unit[at + 2u];
                TriangleHit met;
                bool inside = intersect_triangle(ray.origin, shear, uintBitsToFloat(x.xyz),
                    uintBitsToFloat(uvec3(x.w, y.xy)), uintBitsToFloat(uvec3(y.zw, z.x)), met);
                if (inside && met.t > ray.t_min && met.t < answer.t) {
                    answer = Answer(met.t, met.barycentrics, z.y, 0u, 1u | uint(met.front) << 1);
                }
            }
            if (ANY_HIT && answer.found_and_front != 0u) {
                break;
            }
        }
        if (height == 0u) {
            break;
        }
        reference = stack[--height];
    }
    answers.answer[index] = answer;
}
