// One step of an edge-avoiding a-trous filter over indirect light (Dammertz and others, Edge-Avoiding
// A-Trous Wavelet Transform for fast Global Illumination Filtering, HPG 2010): surfaces guide it, not light.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// B3 spline.
const float KERNEL[3] = float[3](0.375, 0.25, 0.0625);
// How far from the plane of the middle a surface may lie, in distances between taps.
const float PLANE_TOLERANCE = 1.0;
const float NORMAL_EXPONENT = 32.0;

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
    SurfaceTexel middle = surfaces.entries[index];
    vec4 color = source.entries[index];
    if (surface_kind(middle) != SURFACE_NONE) {
        vec3 normal = unpack_unit_vector(middle.normal);
        vec3 plane = unpack_unit_vector(middle.geometric);
        float tolerance = PLANE_TOLERANCE * float(push.step) * view.pixel_spread * length(middle.start);
        float weight = KERNEL[0] * KERNEL[0];
        color *= weight;
        for (int y = -2; y <= 2; ++y) {
            for (int x = -2; x <= 2; ++x) {
                ivec2 at = pixel + ivec2(x, y) * int(push.step);
                if ((x == 0 && y == 0) || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) {
                    continue;
                }
                uint tap = uint(at.y * size.x + at.x);
                SurfaceTexel other = surfaces.entries[tap];
                if (surface_kind(other) != surface_kind(middle)) {
                    continue;
                }
                float facing = max(dot(normal, unpack_unit_vector(other.normal)), 0.0);
                float distance_to_plane = abs(dot(plane, other.start - middle.start));
                float share = KERNEL[abs(x)] * KERNEL[abs(y)] * pow(facing, NORMAL_EXPONENT)
                    * exp(-distance_to_plane / max(tolerance, 1e-12));
                color += share * source.entries[tap];
                weight += share;
            }
        }
        color /= weight;
    }
    ColorTexels(push.target).entries[index] = color;
}
