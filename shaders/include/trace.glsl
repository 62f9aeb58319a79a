// Rays through the world, by the backend that a pass is compiled for. A pass that shoots rays is one source, PASS.glsl, and
// two stubs that include it: PASS.comp (software: bvh.glsl) and PASS.rgen, which begins with
//     #extension GL_EXT_ray_tracing : require
//     #define BACKEND_HARDWARE
// The source takes its pixel from invocation() and calls trace() from one place, in a loop; only PASS.comp has a local
// size, and neither may use shared memory. Shaders of pass/trace complete the pipeline of the second (TraceProgram in
// core/render/src/pathtrace/pipelines.rs makes either of both).
//
// In software the includer defines accept_hit (see bvh.glsl); in hardware trace.rahit has pathtrace/accept.glsl's.

#ifndef AFTERGLOW_TRACE_GLSL
#define AFTERGLOW_TRACE_GLSL

#ifdef BACKEND_HARDWARE

#include "ray.glsl"
#include "trace_payload.glsl"

layout(location = 0) rayPayloadEXT TracePayload met;

uvec2 invocation() {
    return gl_LaunchIDEXT.xy;
}

// As below. Of hits at the same t the driver chooses one, and t may be equal to neither end.
bool trace(uint64_t world, vec3 origin, vec3 direction, float reach, uint mask, bool any_hit, out Hit hit) {
    // What is not finite is undefined behaviour here, and meets nothing in software.
    float size = dot(abs(direction), vec3(1.0)) + dot(abs(origin), vec3(1.0));
    bool is_sound = reach > 0.0 && size <= 1e30 && direction != vec3(0.0);
    met.instance = NO_INSTANCE;
    if (is_sound) {
        uint flags = any_hit ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
        traceRayEXT(accelerationStructureEXT(world), flags, mask, 0u, 0u, 0u, origin, 0.0, direction, min(reach, 1e30), 0);
    }
    hit = Hit(met.t, met.barycentrics, met.primitive, met.instance, met.front != 0u);
    return met.instance != NO_INSTANCE;
}

#else

// Whether the world holds spheres, which costs every ray.
layout(constant_id = 0) const bool HAS_SPHERES = true;

#define BVH_SPHERES HAS_SPHERES
#include "bvh.glsl"

// Which of the pass's invocations this is, a pixel's x and y; it may lie outside of the picture.
uvec2 invocation() {
    return gl_GlobalInvocationID.xy;
}

// The closest hit in (0, reach], or some hit where any_hit is set, among instances that share a bit with `mask`.
// `direction` may have any length but 0. Of hits at the same t the one with the lesser (instance, primitive) counts.
bool trace(uint64_t world, vec3 origin, vec3 direction, float reach, uint mask, bool any_hit, out Hit hit) {
    return bvh_trace(world, origin, 0.0, direction, reach, mask, any_hit, hit);
}

#endif

#endif
