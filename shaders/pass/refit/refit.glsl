// What both steps of a refit share. `core/bvh/src/layout.rs` says what the bytes of a structure mean, and
// `core/bvh/src/refit.rs` is the twin of these steps.

#ifndef AFTERGLOW_PASS_REFIT_GLSL
#define AFTERGLOW_PASS_REFIT_GLSL

#include "bvh_layout.glsl"
#include "generated/pathtrace.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { RefitPush push; };

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint entries[]; };

const uint NODE_BYTES = 16u * BVH_NODE_UNITS;
const uint RECORD_BYTES = 16u * BVH_TRIANGLE_UNITS;

#endif
