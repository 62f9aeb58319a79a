// One step of an edge-avoiding a-trous filter over indirect light (Dammertz and others, Edge-Avoiding
// A-Trous Wavelet Transform for fast Global Illumination Filtering, HPG 2010): surfaces guide it, not light.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/eye.glsl"
#include "pathtrace/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Weights of taps by how many of x and y are not 0.
const float KERNEL[3] = float[3](0.25, 0.125, 0.0625);
// How far from the plane of the middle a surface may lie, in distances between taps.
const float PLANE_TOLERANCE = 1.5;

float thirty_second_power(float x) {
    x *= x;
    x *= x;
    x *= x;
    x *= x;
    return x * x;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(view_size(view));
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    SurfaceTexels surfaces = SurfaceTexels(view.surfaces);
    ColorTexels source = ColorTexels(push.source);
    uint index = uint(pixel.y * size.x + pixel.x);
    vec4 middle = source.entries[index];
    vec3 color = middle.rgb;
    // Depth is 0 where nothing is seen, and negative for the view's second kind of surfaces.
    if (middle.w != 0.0) {
        vec3 normal = unpack_unit_vector(surfaces.entries[index].normal);
        float depth = abs(middle.w);
        vec3 position = seen_position(view, vec2(pixel), depth);
        float tolerance = 1.0 / (PLANE_TOLERANCE * float(push.step) * seen_height(view, depth));
        float weight = KERNEL[0];
        color *= weight;
        [[dont_unroll]] for (int i = 0; i < 9; ++i) {
            ivec2 offset = ivec2(i % 3, i / 3) - 1;
            ivec2 at = pixel + offset * int(push.step);
            if (i == 4 || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) {
                continue;
            }
            uint tap = uint(at.y * size.x + at.x);
            vec4 other = source.entries[tap];
            if (sign(other.w) != sign(middle.w)) {
                continue;
            }
            float from_plane = abs(dot(normal, seen_position(view, vec2(at), abs(other.w)) - position));
            float facing = max(dot(normal, unpack_unit_vector(surfaces.entries[tap].normal)), 0.0);
            float share = KERNEL[abs(offset.x) + abs(offset.y)] * thirty_second_power(facing)
                * max(1.0 - from_plane * tolerance, 0.0);
            color += share * other.rgb;
            weight += share;
        }
        color /= weight;
    }
    ColorTexels(push.target).entries[index] = vec4(color, middle.w);
}
