// Rays through a two-level BVH. Twin of core/bvh/src/traverse.rs, step by step.
//
// The includer enables GL_EXT_buffer_reference, GL_EXT_scalar_block_layout and
// GL_EXT_shader_explicit_arithmetic_types_int64, and defines
//     bool accept_hit(uint instance, uint primitive, vec2 barycentrics);
// which is asked only for triangles and spheres that are flagged alpha-tested, or whose instance is. It may define
// BVH_SPHERES, a constant, as false where no structure holds spheres: rays are 8 % faster then. Call bvh_trace from
// one place, in a loop: each call site is compiled anew.

#ifndef AFTERGLOW_BVH_GLSL
#define AFTERGLOW_BVH_GLSL

#include "bvh_node.glsl"
#include "trace_hit.glsl"

bool accept_hit(uint instance, uint primitive, vec2 barycentrics);

// The closest hit in (t_min, t_max], t_min not negative, or some hit where any_hit is set, among instances that share a
// bit with `mask`. `direction` may have any length but 0. Back faces count. Of hits at the same t the
// one with the lesser (instance, primitive) counts, so that the answer depends on no tree.
bool bvh_trace(uint64_t tlas, vec3 origin, float t_min, vec3 direction, float t_max, uint mask, bool any_hit, out Hit hit) {
    t_min = max(t_min, 0.0);
    uint64_t stack[BVH_STACK_ENTRIES];
    uint height = 0u;
    uint64_t structure = tlas;
    BvhRay ray = bvh_ray(origin, direction);
    BvhGroup nodes = BVH_ROOT;
    BvhGroup leaves = BvhGroup(0u, 0u);
    // The instance that the ray is in, and the stack's height where it entered.
    bool inside = false;
    uint floor_height = 0u;
    uint instance = 0u;
    uint instance_flags = 0u;

    bool found = false;
    hit = Hit(t_max, vec2(0.0), 0u, 0u, false);

    for (uint steps = 0u; steps < BVH_MAX_STEPS; ++steps) {
        if (leaves.mask == 0u) {
            if (!bvh_has_nodes(nodes)) {
                if (height == 0u) {
                    break;
                }
                if (inside && height <= floor_height) {
                    inside = false;
                    structure = tlas;
                    ray = bvh_ray(origin, direction);
                }
                nodes = bvh_unpack(stack[--height]);
            }
            if (bvh_has_nodes(nodes)) {
                uint place = bvh_take_node(nodes, ray.order);
                if (bvh_has_nodes(nodes) && height < BVH_STACK_ENTRIES) {
                    stack[height++] = bvh_pack(nodes);
                }
                bvh_visit(structure, place, ray, t_min, hit.t, nodes, leaves);
            } else {
                leaves = nodes;
                nodes = BvhGroup(0u, 0u);
            }
        }

        // One leaf record a step: rays that have none wait for one, and not for the most that any ray has. Where any
        // hit will do, few rays come to leaves, and those end there.
        for (bool more = leaves.mask != 0u; more; more = any_hit && leaves.mask != 0u) {
            if (inside) {
                uint place = bvh_take_leaf(leaves, BVH_TRIANGLE_UNITS);
                TriangleHit met;
                uint primitive, flags;
                if (!bvh_meet_triangle(structure, place, ray, t_min, met, primitive, flags)) {
                    continue;
                }
                bool closer = met.t > t_min && (met.t < hit.t || met.t == hit.t
                    && (!found || instance < hit.instance || instance == hit.instance && primitive < hit.primitive));
                bool tested = ((flags | instance_flags) & BVH_FLAG_ALPHA_TESTED) != 0u;
                if (!closer || (tested && !accept_hit(instance, primitive, met.barycentrics))) {
                    continue;
                }
                hit = Hit(met.t, met.barycentrics, primitive, instance, met.front);
                found = true;
                if (any_hit) {
                    return true;
                }
            } else {
                uint place = bvh_take_leaf(leaves, BVH_INSTANCE_UNITS);
                BvhInstance entered = bvh_instance(structure, place);
                if ((entered.mask & mask) == 0u) {
                    continue;
                }
                if (bvh_has_nodes(nodes) && height < BVH_STACK_ENTRIES) {
                    stack[height++] = bvh_pack(nodes);
                }
                if (leaves.mask != 0u && height < BVH_STACK_ENTRIES) {
                    stack[height++] = bvh_pack(leaves);
                }
                if ((entered.flags & BVH_FLAG_IDENTITY) == 0u) {
                    ray = bvh_ray_in_object(structure, place, origin, direction);
                }
                structure = entered.blas;
                inside = true;
                floor_height = height;
                instance = entered.id;
                instance_flags = entered.flags;
                nodes = BVH_ROOT;
                leaves.mask = 0u;
            }
        }
    }
    return found;
}

#endif
