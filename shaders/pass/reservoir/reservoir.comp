// Which light of many each pixel keeps, before any ray is sent.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "trace.glsl"
#include "pathtrace/reservoir.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    uint index = pixel.y * view.width + pixel.x;
    SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[index];
    uint kind = surface_kind(surface);
    ReservoirTexel kept = NOTHING_KEPT;
    if (kind != SURFACE_NONE && kind != SURFACE_BAKED) {
        // Other numbers than those of paths, and in each frame others.
        uint seed = hash(view.seed + 0x5eed0u + hash(view.frame_number));
        PathRandom random = PathRandom(Random(hash(index + seed), 0u), seed);
        Path path = path_from(seen_point(surface), to_eye(view, surface.start), 0u, camera_cone(0.0));
        kept = chosen_over_time(view, path, random, kind);
    }
    Reservoirs(view.reservoirs).entries[index] = kept;
}
