// Luminance of the traced picture and of the program's own: lit pixels summed over each workgroup, others over
// each moving draw, in integers, whose order does not matter.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/resolve.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(set = 0, binding = 5) uniform utexture2D visibility_images[];
layout(set = 0, binding = 4, rgba8) uniform readonly image2D color_images[];

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Units of a mover's sums.
const float MOVER_SCALE = 256.0;

// Traced and program's luminance of lit pixels.
shared vec2 sums[256];

vec2 pixel_sums(ViewRecord view, uvec2 pixel) {
    uint index = pixel.y * view.width + pixel.x;
    SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[index];
    uint kind = surface_kind(surface);
    bool has_exposure = kind == SURFACE_LIT && !is_relit(view);
    if (!has_exposure && kind != SURFACE_BAKED_MOVER) {
        return vec2(0.0);
    }
    uint draw = texelFetch(visibility_images[view.visibility], ivec2(pixel), 0).x - 1u;
    vec3 program = imageLoad(color_images[view.color], ivec2(pixel)).rgb;
    float fog = surface_fog(surface);
    if (fog < 1.0) {
        program = clamp((program - (1.0 - fog) * fog_color(view, draw)) / max(fog, 0.05), 0.0, 1.0);
    }
    program = linear_from_srgb(program);
    vec3 traced = radiance(surface, light_at(view, surface, pixel), program);
    traced = fog * min(traced, 4.0);
    program *= fog;
    if (has_exposure) {
        return vec2(luminance(traced), luminance(program));
    }
    uvec3 traced_units = uvec3(traced * MOVER_SCALE + 0.5);
    uvec3 program_units = uvec3(program * MOVER_SCALE + 0.5);
    for (uint i = 0u; i < 3u; ++i) {
        atomicAdd(MoverSums(view.movers).entries[draw].traced[i], traced_units[i]);
        atomicAdd(MoverSums(view.movers).entries[draw].program[i], program_units[i]);
    }
    return vec2(0.0);
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uint thread = gl_LocalInvocationIndex;
    bool is_inside = all(lessThan(gl_GlobalInvocationID.xy, view_size(view)));
    sums[thread] = is_inside ? pixel_sums(view, gl_GlobalInvocationID.xy) : vec2(0.0);
    barrier();
    for (uint half_count = 128u; half_count > 0u; half_count >>= 1) {
        if (thread < half_count) {
            sums[thread] += sums[thread + half_count];
        }
        barrier();
    }
    if (thread == 0u) {
        uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
        ExposureSums(view.sums).entries[group] = ExposureSum(sums[0].x, sums[0].y);
    }
}
