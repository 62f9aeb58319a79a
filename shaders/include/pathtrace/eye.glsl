// Where pixels look: from the eye, or side by side where the projection is orthographic. Positions are relative to the eye.

#ifndef AFTERGLOW_PATHTRACE_EYE_GLSL
#define AFTERGLOW_PATHTRACE_EYE_GLSL

#include "../fixed/lighting.glsl"
#include "ray_cone.glsl"
#include "tables.glsl"

bool looks_parallel(ViewRecord view) {
    return (view.traits & TRACE_PARALLEL) != 0u;
}

// A pixel's centre at depth 1 or, where pixels look side by side, on the near plane.
vec3 pixel_place(ViewRecord view, vec2 pixel) {
    return view.pixel_origin + view.pixel_right * pixel.x + view.pixel_down * pixel.y;
}

// The unit vector from what is seen to who sees it.
vec3 to_eye(ViewRecord view, vec3 position) {
    return looks_parallel(view) ? -view.forward : unit_vector(-position);
}

// How far along the view a position is: from the eye or, where pixels look side by side, from the near plane.
float seen_depth(ViewRecord view, vec3 position) {
    return dot(view.forward, looks_parallel(view) ? position - view.pixel_origin : position);
}

// What a pixel shows, by its depth.
vec3 seen_position(ViewRecord view, vec2 pixel, float depth) {
    vec3 place = pixel_place(view, pixel);
    return looks_parallel(view) ? place + view.forward * depth : place * depth;
}

// A pixel's height so far along the view.
float seen_height(ViewRecord view, float depth) {
    return looks_parallel(view) ? view.pixel_spread : view.pixel_spread * depth;
}

// Where a position was seen in the frame before, pixels from the upper left corner, in sight or not; false if it was behind the eye.
bool place_before(ViewRecord view, vec3 position, out vec2 place) {
    vec4 at = vec4(position, 1.0);
    mat4 rows = view.clip_before;
    vec4 clip = vec4(dot(rows[0], at), dot(rows[1], at), dot(rows[2], at), dot(rows[3], at));
    place = (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * vec2(view_size(view));
    return clip.w > 0.0;
}

// The cone of a pixel's ray, so far from where it starts.
RayCone seen_cone(ViewRecord view, float away) {
    return looks_parallel(view) ? RayCone(view.pixel_spread, 0.0) : travelled(camera_cone(view.pixel_spread), away);
}

#endif
