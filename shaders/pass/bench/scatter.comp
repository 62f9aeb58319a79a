// From the primary hits on: one cosine-distributed ray each, or one to a lamp, for measurements. Where a primary ray
// met nothing, the ray is one that meets nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "ray.glsl"
#include "bench/rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Positions {
    vec3 position[];
};

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Indices {
    uvec3 triangle[];
};

layout(push_constant, scalar) uniform Constants {
    Rays primary;
    Answers answers;
    Positions positions;
    Indices indices;
    Rays scattered;
    uint count;
    uint to_lamp; // or all about
    vec3 lamp;
};

// PCG-RXS-M-XS (O'Neill 2014) of consecutive states, in [0, 1).
float random(inout uint state) {
    state = state * 747796405u + 2891336453u;
    uint word = (state >> ((state >> 28) + 4u) ^ state) * 277803737u;
    return float((word >> 22 ^ word) >> 8) / 16777216.0;
}

vec3 on_sphere(inout uint state) {
    float z = random(state) * 2.0 - 1.0;
    float angle = random(state) * 6.2831853;
    float across = sqrt(max(1.0 - z * z, 0.0));
    return vec3(across * cos(angle), across * sin(angle), z);
}

void main() {
    uint index = gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
    if (index >= count) {
        return;
    }
    Answer met = answers.answer[index];
    if ((met.found_and_front & 1u) == 0u) {
        scattered.ray[index] = RayRecord(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0);
        return;
    }
    uvec3 corners = indices.triangle[met.primitive];
    vec3 a = positions.position[corners.x];
    vec3 along_b = positions.position[corners.y] - a;
    vec3 along_c = positions.position[corners.z] - a;
    vec3 normal = normalize(cross(along_b, along_c));
    normal *= dot(normal, primary.ray[index].direction) < 0.0 ? 1.0 : -1.0;
    vec3 start = offset_ray(a + along_b * met.barycentrics.x + along_c * met.barycentrics.y, normal);
    uint state = index * 2u + 1u;
    vec3 direction = to_lamp != 0u ? lamp - start : normalize(normal + 0.999 * on_sphere(state));
    scattered.ray[index] = RayRecord(start, 0.0, direction, to_lamp != 0u ? 1.0 : 1.0 / 0.0);
}
