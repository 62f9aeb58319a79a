// Reads a two-level BVH, which core/bvh has written (src/layout.rs says what each field means); nodes, triangles and instances
// are found by offsets in units of 16 bytes from the start of their structure.

#ifndef AFTERGLOW_BVH_NODE_GLSL
#define AFTERGLOW_BVH_NODE_GLSL

#include "bvh_layout.glsl"
#include "ray.glsl"

// Whether structures may hold spheres.
#ifndef BVH_SPHERES
#define BVH_SPHERES true
#endif

// Whether a unit is one load, which graphics processors like best, or two: lavapipe gathers component by component.
#ifndef BVH_WHOLE_UNITS
layout(constant_id = 20) const bool BVH_WHOLE_UNITS = false;
#endif

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer BvhUnits {
    uvec4 unit[];
};

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer BvhHalfUnits {
    u64vec2 unit[];
};

// The four words of a structure's unit.
uvec4 bvh_unit(uint64_t structure, uint place) {
    uint64_t at = structure + uint64_t(place) * 16ul;
    if (BVH_WHOLE_UNITS) {
        return BvhUnits(at).unit[0];
    }
    u64vec2 halves = BvhHalfUnits(at).unit[0];
    return uvec4(unpackUint2x32(halves.x), unpackUint2x32(halves.y));
}

// A ray as nodes and triangles see it, in the world or in an object.
struct BvhRay {
    vec3 origin;
    vec3 inverse;
    // Less the origin's distances from 0, a little less for planes that are met first, a little more for the last.
    vec3 start_near;
    vec3 start_far;
    uvec3 first; // units of the planes along x, y, z that are met first
    RayShear shear;
};

// Components of a direction nearer to 0 than this (2^-80) count as this.
const float BVH_LEAST_COMPONENT = 8.271806e-25;
// Rounding of the origin's part of a plane's distance (2^-22), relative.
const float BVH_ORIGIN_ERROR = 2.3841858e-7;
// What planes are moved outwards by, so that a ray along one at 0 stays within it (2^-50).
const float BVH_PLANE_ERROR = 8.881784e-16;
// Rounding of distances, in units in the last place.
const int BVH_DISTANCE_UNITS = 4;

BvhRay bvh_ray(vec3 origin, vec3 direction) {
    uvec3 sign_bits = floatBitsToUint(direction) & 0x80000000u;
    vec3 least = uintBitsToFloat(sign_bits | floatBitsToUint(BVH_LEAST_COMPONENT));
    vec3 safe = mix(direction, least, lessThan(abs(direction), vec3(BVH_LEAST_COMPONENT)));
    vec3 inverse = 1.0 / safe;
    precise vec3 start = -(origin * inverse);
    precise vec3 error = fma(abs(inverse), vec3(BVH_PLANE_ERROR), BVH_ORIGIN_ERROR * abs(start));
    precise vec3 start_near = start - error;
    precise vec3 start_far = start + error;
    return BvhRay(origin, inverse, start_near, start_far, uvec3(0u, 2u, 4u) + (sign_bits >> 31), ray_shear(direction));
}

// References: a node's place; or, with bit 31 set, that of one to four leaf records; or nothing.
bool bvh_is_node(uint reference) {
    return int(reference) >= 0;
}

bool bvh_is_leaf(uint reference) {
    return reference >= 0x80000000u && reference != BVH_NOTHING;
}

// The rest of a leaf of triangles, after its first.
uint bvh_next_record(uint reference) {
    bool is_last = (reference & (3u << BVH_PLACE_BITS)) == 0u;
    return is_last ? BVH_NOTHING : reference - (1u << BVH_PLACE_BITS) + BVH_TRIANGLE_UNITS;
}

// Of a child that a ray does not meet.
const int BVH_MISSED = 0x7fffffff;

// How far the ray goes until it is in the box of each child of the node at `place`, in t_min..t_max, as integers that sort like
// distances with the child's slot in their last bits; BVH_MISSED where it does not meet it.
ivec4 bvh_enter(uint64_t structure, uint place, BvhRay ray, float t_min, float t_max, out uvec4 children) {
    uvec3 last = ray.first ^ 1u;
    vec4 near_x = uintBitsToFloat(bvh_unit(structure, place + ray.first.x));
    vec4 far_x = uintBitsToFloat(bvh_unit(structure, place + last.x));
    vec4 near_y = uintBitsToFloat(bvh_unit(structure, place + ray.first.y));
    vec4 far_y = uintBitsToFloat(bvh_unit(structure, place + last.y));
    vec4 near_z = uintBitsToFloat(bvh_unit(structure, place + ray.first.z));
    vec4 far_z = uintBitsToFloat(bvh_unit(structure, place + last.z));
    children = bvh_unit(structure, place + 6u);

    // Signed integers sort like the floats that they are the bits of, down to 0; t_min is not negative.
    ivec4 near = floatBitsToInt(fma(near_x, vec4(ray.inverse.x), vec4(ray.start_near.x)));
    ivec4 far = floatBitsToInt(fma(far_x, vec4(ray.inverse.x), vec4(ray.start_far.x)));
    near = max(near, floatBitsToInt(fma(near_y, vec4(ray.inverse.y), vec4(ray.start_near.y))));
    far = min(far, floatBitsToInt(fma(far_y, vec4(ray.inverse.y), vec4(ray.start_far.y))));
    near = max(near, floatBitsToInt(fma(near_z, vec4(ray.inverse.z), vec4(ray.start_near.z))));
    far = min(far, floatBitsToInt(fma(far_z, vec4(ray.inverse.z), vec4(ray.start_far.z))));
    near = max(near, ivec4(floatBitsToInt(t_min)));
    far = min(far, ivec4(floatBitsToInt(t_max)));
    bvec4 met = lessThanEqual(near, far + BVH_DISTANCE_UNITS);
    return mix(ivec4(BVH_MISSED), (near & ~3) | ivec4(0, 1, 2, 3), met);
}

// Four numbers from the least to the greatest.
ivec4 bvh_sorted(ivec4 n) {
    n = ivec4(min(n.xz, n.yw), max(n.xz, n.yw)).xzyw;
    n = ivec4(min(n.xy, n.zw), max(n.xy, n.zw));
    return ivec4(n.x, min(n.y, n.z), max(n.y, n.z), n.w);
}

// The reference of a child that was met.
uint bvh_child(uvec4 children, int met) {
    uvec2 of_two = (met & 2) != 0 ? children.zw : children.xy;
    return (met & 1) != 0 ? of_two.y : of_two.x;
}

// Meets the triangle at `place`, or the sphere beyond t_min; its number and flags are valid where it is met.
bool bvh_meet_triangle(uint64_t structure, uint place, BvhRay ray, float t_min, out TriangleHit hit, out uint primitive,
    out uint flags) {
    uvec4 first = bvh_unit(structure, place);
    uvec4 second = bvh_unit(structure, place + 1u);
    uvec4 third = bvh_unit(structure, place + 2u);
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
    uvec4 head = bvh_unit(structure, place);
    return BvhInstance(packUint2x32(head.xy), head.z, head.w & 0xffu, head.w >> 8);
}

// The ray in the object space of the instance at `place`.
BvhRay bvh_ray_in_object(uint64_t structure, uint place, vec3 origin, vec3 direction) {
    vec4 x = uintBitsToFloat(bvh_unit(structure, place + 1u));
    vec4 y = uintBitsToFloat(bvh_unit(structure, place + 2u));
    vec4 z = uintBitsToFloat(bvh_unit(structure, place + 3u));
    vec3 origin_object = vec3(dot(x.xyz, origin) + x.w, dot(y.xyz, origin) + y.w, dot(z.xyz, origin) + z.w);
    vec3 direction_object = vec3(dot(x.xyz, direction), dot(y.xyz, direction), dot(z.xyz, direction));
    return bvh_ray(origin_object, direction_object);
}

#endif
