// Answers questions about ray cones, one a thread.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/ray_cone.glsl"

layout(local_size_x = 64) in;

struct Path {
    float pixel_spread;
    float first;
    float pdf;
    float samples;
    float second;
    float cosine;
    float area_world;
    float area_coordinates;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Paths { Path entries[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Answers { vec3 entries[]; };

layout(push_constant, scalar) uniform Push {
    uint64_t paths;
    uint64_t answers;
    uint count;
    uint padding;
} push;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Path path = Paths(push.paths).entries[i];
    RayCone cone = travelled(camera_cone(path.pixel_spread), path.first);
    cone = travelled(scattered(cone, path.pdf, path.samples), path.second);
    float texels = cone_texels(cones_along(cone, path.cosine, path.area_world), path.area_coordinates);
    Answers(push.answers).entries[i] = vec3(cone.width, cone.spread, texels);
}
