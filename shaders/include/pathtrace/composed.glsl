// What would be shown, between composition and the smoothing of edges.

#ifndef AFTERGLOW_PATHTRACE_COMPOSED_GLSL
#define AFTERGLOW_PATHTRACE_COMPOSED_GLSL

#include "edge.glsl"
#include "packing.glsl"
#include "surface.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer ComposedTexels { uvec2 halves[]; };

bool smooths_edges(ViewRecord view) {
    return (view.traits & TRACE_SMOOTH_EDGES) != 0u;
}

// Linear colour of [0, 1], and the depth along the view, 0 where nothing is traced.
void write_composed(ViewRecord view, uvec2 pixel, vec3 color, float depth) {
    vec2 far = vec2(color.z, min(depth, MOST_HALF));
    ComposedTexels(view.composed).halves[pixel.y * view.width + pixel.x] = uvec2(packHalf2x16(color.xy), packHalf2x16(far));
}

vec4 read_composed(ViewRecord view, uvec2 pixel) {
    uvec2 halves = ComposedTexels(view.composed).halves[pixel.y * view.width + pixel.x];
    return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
}

#endif
