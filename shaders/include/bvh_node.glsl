// The bytes of a two-level BVH: one file knows them. Written by core/bvh (src/layout.rs says what
// each field means); nodes, triangles and instances are found by offsets in units of 16 bytes from
// the start of their structure.

#ifndef AFTERGLOW_BVH_NODE_GLSL
#define AFTERGLOW_BVH_NODE_GLSL

#include "ray.glsl"

// Whether structures may hold spheres.
#ifndef BVH_SPHERES
#define BVH_SPHERES true
#endif

const uint BVH_NODE_UNITS = 5u;
const uint BVH_TRIANGLE_UNITS = 3u;
const uint BVH_INSTANCE_UNITS = 7u;
const uint BVH_STACK_ENTRIES = 32u;
const uint BVH_MAX_STEPS = 262144u;

const uint BVH_FLAG_ALPHA_TESTED = 1u;
const uint BVH_FLAG_TWO_SIDED = 2u;
const uint BVH_FLAG_IDENTITY = 4u;
const uint BVH_FLAG_SPHERE = 8u;

// 64-bit loads: lavapipe gathers component by component, and others merge them anyway.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer BvhUnits {
    u64vec2 unit[];
};

// A unit's four words.
uvec4 bvh_words(u64vec2 unit) {
    return uvec4(unpackUint2x32(unit.x), unpackUint2x32(unit.y));
}

// A ray as nodes and triangles see it, in the world or in an object.
struct BvhRay {
    vec3 origin;
    vec3 inverse;
    RayShear shear;
    uint order; // bit 2, 1, 0 set where x, y, z of the direction are not negative
};

// Components of a direction nearer to 0 than this (2^-80) count as this.
const float BVH_LEAST_COMPONENT = 8.271806e-25;
// Rounding of a slab's distances, relative to their terms (2^-21).
const float BVH_SLAB_ERROR = 4.7683716e-7;

BvhRay bvh_ray(vec3 origin, vec3 direction) {
    uvec3 sign_bits = floatBitsToUint(direction) & 0x80000000u;
    vec3 least = uintBitsToFloat(sign_bits | floatBitsToUint(BVH_LEAST_COMPONENT));
    vec3 safe = mix(direction, least, lessThan(abs(direction), vec3(BVH_LEAST_COMPONENT)));
    uvec3 positive = (sign_bits >> 31) ^ 1u;
    uint order = positive.x << 2 | positive.y << 1 | positive.z;
    return BvhRay(origin, 1.0 / safe, ray_shear(direction), order);
}

// Children or leaf records still to visit. In `mask` bits 24..32 are inner children, nearest first
// from bit 31, with the inner mask of their node in bits 0..8; or bits 0..24 are leaf records.
struct BvhGroup {
    uint base;
    uint mask;
};

const BvhGroup BVH_ROOT = BvhGroup(0u, 0x80000000u);

// As one word of the stack.
uint64_t bvh_pack(BvhGroup group) {
    return packUint2x32(uvec2(group.base, group.mask));
}

BvhGroup bvh_unpack(uint64_t word) {
    uvec2 parts = unpackUint2x32(word);
    return BvhGroup(parts.x, parts.y);
}

bool bvh_has_nodes(BvhGroup group) {
    return group.mask > 0x00ffffffu;
}

// Takes the nearest inner child; returns where it lies.
uint bvh_take_node(inout BvhGroup group, uint order) {
    uint bit = uint(findMSB(group.mask));
    uint inner_mask = group.mask & 0xffu;
    group.mask &= ~(1u << bit);
    uint slot = (bit - 24u) ^ order;
    uint before = uint(bitCount(inner_mask & ~(0xffffffffu << slot)));
    return group.base + before * BVH_NODE_UNITS;
}

// Takes a leaf record; returns where it lies.
uint bvh_take_leaf(inout BvhGroup group, uint units) {
    uint bit = uint(findMSB(group.mask));
    group.mask &= ~(1u << bit);
    return group.base + bit * units;
}

vec4 bvh_bytes(uint word) {
    return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 0xffu);
}

// The bits of four slots whose boxes the ray meets in t_min..t_max. `first` and `last` are their planes
// along x, y, z in the ray's direction, a byte a slot; `order4` is the ray's order in each byte.
uint bvh_meet_four(uint meta4, uint order4, vec3 scale, vec3 start_near, vec3 start_far, uvec3 first, uvec3 last, float t_min, float t_max) {
    // Signed integers sort like the floats that they are the bits of, down to 0; t_min is not negative.
    ivec4 near = floatBitsToInt(fma(bvh_bytes(first.x), vec4(scale.x), vec4(start_near.x)));
    ivec4 far = floatBitsToInt(fma(bvh_bytes(last.x), vec4(scale.x), vec4(start_far.x)));
    near = max(near, floatBitsToInt(fma(bvh_bytes(first.y), vec4(scale.y), vec4(start_near.y))));
    far = min(far, floatBitsToInt(fma(bvh_bytes(last.y), vec4(scale.y), vec4(start_far.y))));
    near = max(near, floatBitsToInt(fma(bvh_bytes(first.z), vec4(scale.z), vec4(start_near.z))));
    far = min(far, floatBitsToInt(fma(bvh_bytes(last.z), vec4(scale.z), vec4(start_far.z))));
    bvec4 met = lessThanEqual(max(near, ivec4(floatBitsToInt(t_min))), min(far, ivec4(floatBitsToInt(t_max))));

    // Bytes of 24 or more are inner children: their place is by the ray's order.
    uint inner4 = (meta4 & (meta4 << 1)) & 0x10101010u;
    uint place4 = (meta4 ^ (order4 & ((inner4 >> 4) * 0xffu))) & 0x1f1f1f1fu;
    uint bits4 = (meta4 >> 5) & 0x07070707u;
    uvec4 place = uvec4(place4, place4 >> 8, place4 >> 16, place4 >> 24) & 0x1fu;
    uvec4 bits = uvec4(bits4, bits4 >> 8, bits4 >> 16, bits4 >> 24) & 0x7u;
    uvec4 placed = mix(uvec4(0u), bits << place, met);
    return placed.x | placed.y | placed.z | placed.w;
}

// Reads the node at `place` and finds which children the ray meets.
void bvh_visit(uint64_t structure, uint place, BvhRay ray, float t_min, float t_max, out BvhGroup nodes, out BvhGroup leaves) {
    BvhUnits node = BvhUnits(structure + uint64_t(place) * 16ul);
    uvec4 head = bvh_words(node.unit[0]);
    uvec4 body = bvh_words(node.unit[1]);
    uvec4 planes_0 = bvh_words(node.unit[2]);
    uvec4 planes_1 = bvh_words(node.unit[3]);
    uvec4 planes_2 = bvh_words(node.unit[4]);

    uvec3 exponents = uvec3(head.w, head.w >> 8, head.w >> 16) & 0xffu;
    vec3 scale = uintBitsToFloat(exponents << 23) * ray.inverse;
    vec3 start = (uintBitsToFloat(head.xyz) - ray.origin) * ray.inverse;
    vec3 error = BVH_SLAB_ERROR * (abs(start) + 256.0 * abs(scale));
    vec3 start_near = start - error;
    vec3 start_far = start + error;

    // Planes: low x (2 words, 4 slots each), low y, low z, high x, high y, high z.
    uvec3 low_0 = uvec3(planes_0.x, planes_0.z, planes_1.x);
    uvec3 low_1 = uvec3(planes_0.y, planes_0.w, planes_1.y);
    uvec3 high_0 = uvec3(planes_1.z, planes_2.x, planes_2.z);
    uvec3 high_1 = uvec3(planes_1.w, planes_2.y, planes_2.w);
    bvec3 positive = bvec3((ray.order & 4u) != 0u, (ray.order & 2u) != 0u, (ray.order & 1u) != 0u);
    uint order4 = ray.order * 0x01010101u;
    uint met = bvh_meet_four(body.z, order4, scale, start_near, start_far, mix(high_0, low_0, positive), mix(low_0, high_0, positive), t_min, t_max)
        | bvh_meet_four(body.w, order4, scale, start_near, start_far, mix(high_1, low_1, positive), mix(low_1, high_1, positive), t_min, t_max);

    nodes = BvhGroup(body.x, (met & 0xff000000u) | head.w >> 24);
    leaves = BvhGroup(body.y, met & 0x00ffffffu);
}

// Meets the triangle at `place`, or the sphere beyond t_min; its number and flags are valid where it is met.
bool bvh_meet_triangle(uint64_t structure, uint place, BvhRay ray, float t_min, out TriangleHit hit, out uint primitive, out uint flags) {
    BvhUnits triangle = BvhUnits(structure + uint64_t(place) * 16ul);
    uvec4 first = bvh_words(triangle.unit[0]);
    uvec4 second = bvh_words(triangle.unit[1]);
    uvec4 third = bvh_words(triangle.unit[2]);
    vec3 a = uintBitsToFloat(first.xyz);
    vec3 b = uintBitsToFloat(uvec3(first.w, second.xy));
    vec3 c = uintBitsToFloat(uvec3(second.zw, third.x));
    primitive = third.y;
    flags = third.z;
    if (BVH_SPHERES && (flags & BVH_FLAG_SPHERE) != 0u) {
        SphereHit met;
        bool is_met = intersect_sphere(ray.origin, ray.inverse, ray.shear, t_min, a, b.x, met);
        hit = TriangleHit(met.t, vec2(0.0), met.front);
        return is_met;
    }
    return intersect_triangle(ray.origin, ray.shear, a, b, c, hit);
}

// What traversal needs of an instance.
struct BvhInstance {
    uint64_t blas;
    uint id;
    uint mask;
    uint flags;
};

BvhInstance bvh_instance(uint64_t structure, uint place) {
    uvec4 head = bvh_words(BvhUnits(structure + uint64_t(place) * 16ul).unit[0]);
    return BvhInstance(packUint2x32(head.xy), head.z, head.w & 0xffu, head.w >> 8);
}

// The ray in the object space of the instance at `place`.
BvhRay bvh_ray_in_object(uint64_t structure, uint place, vec3 origin, vec3 direction) {
    BvhUnits instance = BvhUnits(structure + uint64_t(place) * 16ul);
    vec4 x = uintBitsToFloat(bvh_words(instance.unit[1]));
    vec4 y = uintBitsToFloat(bvh_words(instance.unit[2]));
    vec4 z = uintBitsToFloat(bvh_words(instance.unit[3]));
    vec3 origin_object = vec3(dot(x.xyz, origin) + x.w, dot(y.xyz, origin) + y.w, dot(z.xyz, origin) + z.w);
    vec3 direction_object = vec3(dot(x.xyz, direction), dot(y.xyz, direction), dot(z.xyz, direction));
    return bvh_ray(origin_object, direction_object);
}

#endif
