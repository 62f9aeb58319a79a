// What the shaders of a ray-tracing pipeline hand to each other.

#ifndef AFTERGLOW_TRACE_PAYLOAD_GLSL
#define AFTERGLOW_TRACE_PAYLOAD_GLSL

#include "trace_hit.glsl"

// A hit; instances' ids have 24 bits.
struct TracePayload {
    float t;
    vec2 barycentrics;
    uint primitive;
    uint instance; // NO_INSTANCE where nothing was met
    uint front;
};

const uint NO_INSTANCE = 0xffffffffu;
// Of spheres met from outside and from inside, as gl_HitKindEXT has it for triangles.
const uint SPHERE_FRONT = 0u;
const uint SPHERE_BACK = 1u;

#endif
