// Rays through the world, by the backend that the pass is compiled for.

#ifndef AFTERGLOW_TRACE_GLSL
#define AFTERGLOW_TRACE_GLSL

#include "bvh.glsl"

// Which of the pass's invocations this is, a pixel's x and y.
uvec2 invocation() {
    return gl_GlobalInvocationID.xy;
}

// The closest hit in (0, reach], or some hit where any_hit is set, among instances that share a bit with `mask`.
// `direction` may have any length but 0. Call it from one place, in a loop.
bool trace(uint64_t world, vec3 origin, vec3 direction, float reach, uint mask, bool any_hit, out Hit hit) {
    return bvh_trace(world, origin, 0.0, direction, reach, mask, any_hit, hit);
}

#endif
