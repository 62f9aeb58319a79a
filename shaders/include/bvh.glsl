// Rays through a two-level BVH. Twin of core/bvh/src/traverse.rs: the same visits in the same order.
//
// The includer enables GL_EXT_buffer_reference, GL_EXT_scalar_block_layout and
// GL_EXT_shader_explicit_arithmetic_types_int64, and defines
//     bool accept_hit(uint instance, uint primitive, vec2 barycentrics);
// which is asked only for triangles and spheres that are flagged alpha-tested, or whose instance is. It may define
// BVH_SPHERES, a constant, as false where no structure holds spheres: rays are faster then. Call bvh_trace from
// one place, in a loop: each call site is compiled anew.

#ifndef AFTERGLOW_BVH_GLSL
#define AFTERGLOW_BVH_GLSL

#include "bvh_node.glsl"
#include "trace_hit.glsl"

bool accept_hit(uint instance, uint primitive, vec2 barycentrics);

// Puts children that wait on the stack; no function, because an array that is passed to one is copied. The builders keep to
// the stack's size; whatever a structure says, nothing is written beside it.
#define BVH_PUSH(reference) stack[height++ & (BVH_STACK_ENTRIES - 1u)] = reference
#define BVH_POP stack[--height & (BVH_STACK_ENTRIES - 1u)]

// Goes to a child that is nearer than the one met before it, which waits.
#define BVH_MEET(met_child) \
    if (met_child != BVH_MISSED) { \
        if (reference != BVH_NOTHING) { \
            BVH_PUSH(reference); \
        } \
        reference = bvh_child(children, met_child); \
    }

// Visits the node at `reference` and goes to the nearest of its children that the ray meets, the others wait, the farthest
// below; where any hit will do, to any.
#define BVH_VISIT(structure, ray) \
    { \
        uvec4 children; \
        ivec4 met = bvh_enter(structure, reference, ray, t_min, hit.t, children); \
        if (!any_hit) { \
            met = bvh_sorted(met); \
        } \
        reference = BVH_NOTHING; \
        BVH_MEET(met.w) \
        BVH_MEET(met.z) \
        BVH_MEET(met.y) \
        BVH_MEET(met.x) \
    }

// The closest hit in (t_min, t_max], t_min not negative, or some hit where any_hit is set, among instances that share a
// bit with `mask`. `direction` may have any length but 0. Back faces count. Of hits at the same t the
// one with the lesser (instance, primitive) counts, so that the answer depends on no tree.
bool bvh_trace(uint64_t tlas, vec3 origin, float t_min, vec3 direction, float t_max, uint mask, bool any_hit, out Hit hit) {
    t_min = max(t_min, 0.0);
    uint stack[BVH_STACK_ENTRIES];
    uint height = 0u;
    uint reference = BVH_ROOT;
    BvhRay world_ray = bvh_ray(origin, direction);
    bool found = false;
    hit = Hit(t_max, vec2(0.0), 0u, 0u, false);

    // A loop for each level: one for both would have to keep both rays at hand. A step visits a node, then meets a leaf
    // record: so few rays wait for others, which have more of either.
    for (uint steps = 0u; steps < BVH_MAX_STEPS; ++steps) {
        if (bvh_is_node(reference)) {
            BVH_VISIT(tlas, world_ray)
        }
        if (bvh_is_leaf(reference)) {
            uint place = reference & BVH_PLACE_MASK;
            BvhInstance entered = bvh_instance(tlas, place);
            BvhRay ray = world_ray;
            if ((entered.flags & BVH_FLAG_IDENTITY) == 0u) {
                ray = bvh_ray_in_object(tlas, place, origin, direction);
            }
            uint floor_height = height;
            reference = (entered.mask & mask) != 0u ? BVH_ROOT : BVH_NOTHING;
            for (; steps < BVH_MAX_STEPS && reference != BVH_NOTHING; ++steps) {
                if (bvh_is_node(reference)) {
                    BVH_VISIT(entered.blas, ray)
                }
                if (bvh_is_leaf(reference)) {
                    TriangleHit met;
                    uint primitive, flags;
                    bool is_met = bvh_meet_triangle(entered.blas, reference & BVH_PLACE_MASK, ray, t_min, met, primitive, flags);
                    bool closer = is_met && met.t > t_min && (met.t < hit.t || met.t == hit.t && (!found
                        || entered.id < hit.instance || entered.id == hit.instance && primitive < hit.primitive));
                    bool tested = ((flags | entered.flags) & BVH_FLAG_ALPHA_TESTED) != 0u;
                    reference = bvh_next_record(reference);
                    if (closer && (!tested || accept_hit(entered.id, primitive, met.barycentrics))) {
                        hit = Hit(met.t, met.barycentrics, primitive, entered.id, met.front);
                        found = true;
                        if (any_hit) {
                            return true;
                        }
                    }
                }
                if (reference == BVH_NOTHING && height != floor_height) {
                    reference = BVH_POP;
                }
            }
        }
        if (reference == BVH_NOTHING) {
            if (height == 0u) {
                break;
            }
            reference = BVH_POP;
        }
    }
    return found;
}

#endif
