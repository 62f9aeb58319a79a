// Sizes and bits of a two-level BVH, as core/bvh/src/layout.rs has them.

#ifndef AFTERGLOW_BVH_LAYOUT_GLSL
#define AFTERGLOW_BVH_LAYOUT_GLSL

const uint BVH_NODE_UNITS = 8u;
const uint BVH_TRIANGLE_UNITS = 3u;
const uint BVH_INSTANCE_UNITS = 7u;
const uint BVH_STACK_ENTRIES = 128u;
const uint BVH_MAX_STEPS = 262144u;

const uint BVH_PLACE_BITS = 29u;
const uint BVH_NOTHING = 4294967295u;
const uint BVH_ROOT = 0u;
const uint BVH_PLACE_MASK = (1u << BVH_PLACE_BITS) - 1u;

const uint BVH_FLAG_ALPHA_TESTED = 1u;
const uint BVH_FLAG_TWO_SIDED = 2u;
const uint BVH_FLAG_IDENTITY = 4u;
const uint BVH_FLAG_SPHERE = 8u;

#endif
