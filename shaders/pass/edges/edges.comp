// Mixes the colours at both sides of an edge by how much of a pixel each has. Alpha, depth and what is drawn later stay.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/color.glsl"
#include "pathtrace/composed.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 5) uniform utexture2D visibility_images[];
layout(set = 0, binding = 4, rgba8) uniform image2D color_images[];

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Share of its depth by which a surface is clearly before another one.
const float CLEARLY = 0.02;

SurfaceTexel surface_of(ViewRecord view, ivec2 pixel) {
    return SurfaceTexels(view.surfaces).entries[pixel.y * int(view.width) + pixel.x];
}

// What is not traced is behind everything.
float depth_of(vec4 composed) {
    return composed.w == 0.0 ? 1e30 : composed.w;
}

// How far an edge lies from its own pixel's middle towards a side; 2 if none does.
float towards(uint edge, ivec2 side) {
    bool is_down = (edge & EDGE_DOWN) != 0u;
    float offset = edge_offset(edge) * float(is_down ? side.y : side.x);
    return edge == NO_EDGE || is_down != (side.y != 0) || offset < 0.0 ? 2.0 : offset;
}

// Whether two pixels show one draw's surface, which only happens to be made of several triangles.
bool is_one_surface(ViewRecord view, ivec2 pixel, ivec2 other, SurfaceTexel own, SurfaceTexel others) {
    uint draw = texelFetch(visibility_images[view.visibility], pixel, 0).x;
    uint other_draw = texelFetch(visibility_images[view.visibility], other, 0).x;
    return draw == other_draw && draw != 0u && dot(unpack_unit_vector(own.geometric), unpack_unit_vector(others.geometric)) > 0.9
        && abs(dot(unpack_unit_vector(own.geometric), others.start - own.start)) < 0.02 * length(own.start);
}

// How much of a pixel belongs to what its neighbour at a side shows.
float share_of(ViewRecord view, ivec2 pixel, ivec2 side, SurfaceTexel own, float depth, float other_depth) {
    SurfaceTexel others = surface_of(view, pixel + side);
    float own_edge = other_depth > depth * (1.0 - CLEARLY) ? towards(surface_edge(own), side) : 2.0;
    float others_edge = other_depth < depth * (1.0 + CLEARLY) ? towards(surface_edge(others), -side) : 0.0;
    float share = max(max(0.5 - own_edge, 0.0), others_edge > 1.0 ? 0.0 : max(others_edge - 0.5, 0.0));
    return share > 0.0 && !is_one_surface(view, pixel, pixel + side, own, others) ? share : 0.0;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), view_size(view)))) {
        return;
    }
    vec4 composed = read_composed(view, uvec2(pixel));
    SurfaceTexel own = surface_of(view, pixel);
    uint index = uint(pixel.y) * view.width + uint(pixel.x);
    vec3 radiance = view.radiance == 0ul ? vec3(0.0) : RadianceTexels(view.radiance).entries[index].squares;
    vec3 color = composed.rgb;
    vec4 sum = vec4(0.0);
    vec3 sum_radiance = vec3(0.0);
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0);
        ivec2 other = pixel + side;
        if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(view_size(view))))) {
            continue;
        }
        vec4 others = read_composed(view, uvec2(other));
        if (composed.w == 0.0 && others.w == 0.0) {
            continue;
        }
        float share = share_of(view, pixel, side, own, depth_of(composed), depth_of(others));
        if (share > 0.0) {
            sum += share * vec4(others.rgb, 1.0);
            if (view.radiance != 0ul) {
                uint there = uint(other.y) * view.width + uint(other.x);
                sum_radiance += share * RadianceTexels(view.radiance).entries[there].squares;
            }
        }
    }
    if (sum.w > 0.0) {
        // Two edges may claim more than there is.
        float scale = min(1.0, 0.75 / sum.w);
        color = color * (1.0 - scale * sum.w) + scale * sum.rgb;
        radiance = radiance * (1.0 - scale * sum.w) + scale * sum_radiance;
    }
    if (view.radiance != 0ul) {
        RadianceTexels(view.radiance).entries[index].mean = radiance;
    }
    if (composed.w != 0.0 || sum.w > 0.0 || view.paint == PAINT_SKY) {
        float alpha = imageLoad(color_images[view.color], pixel).a;
        imageStore(color_images[view.color], pixel, vec4(srgb_from_linear(color), alpha));
    }
}
