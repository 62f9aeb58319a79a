// One step of an edge-avoiding a-trous filter over indirect light (Dammertz and others, Edge-Avoiding
// A-Trous Wavelet Transform for fast Global Illumination Filtering, HPG 2010): surfaces guide it, not light. Both bands of
// light are filtered, so that what faces a little aside helps and yet no edge between normals is lost.
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

float eighth_power(float x) {
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
    IndirectTexels source = IndirectTexels(push.source);
    uint index = uint(pixel.y * size.x + pixel.x);
    IndirectTexel middle = source.entries[index];
    if (middle.depth != 0.0) {
        vec3 normal = unpack_unit_vector(surfaces.entries[index].normal);
        float depth = abs(middle.depth);
        vec3 position = seen_position(view, vec2(pixel), depth);
        float tolerance = 1.0 / (PLANE_TOLERANCE * float(push.step) * seen_height(view, depth));
        float weight = KERNEL[0];
        middle.color *= weight;
        middle.towards *= weight;
        [[dont_unroll]] for (int i = 0; i < 9; ++i) {
            ivec2 offset = ivec2(i % 3, i / 3) - 1;
            ivec2 at = pixel + offset * int(push.step);
            if (i == 4 || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) {
                continue;
            }
            uint tap = uint(at.y * size.x + at.x);
            IndirectTexel other = source.entries[tap];
            if (sign(other.depth) != sign(middle.depth)) {
                continue;
            }
            float from_plane = abs(dot(normal, seen_position(view, vec2(at), abs(other.depth)) - position));
            float facing = max(dot(normal, unpack_unit_vector(surfaces.entries[tap].normal)), 0.0);
            float share = KERNEL[abs(offset.x) + abs(offset.y)] * eighth_power(facing)
                * max(1.0 - from_plane * tolerance, 0.0);
            middle.color += share * other.color;
            middle.towards += share * other.towards;
            weight += share;
        }
        middle.color /= weight;
        middle.towards /= weight;
    }
    IndirectTexels(push.target).entries[index] = middle;
}
