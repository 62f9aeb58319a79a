// A bottom level whose triangles moved, second step: a level of its nodes gets boxes around what lies below. Levels come
// from the deepest to the root, so that boxes of children are there.
//
// Nothing depends on the order of threads, and nothing is rounded: least and greatest coordinates are found among integers
// that sort like the floats. So the nodes are the twin's.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "refit.glsl"

const uint WIDTH = 4u;
// Nodes of a workgroup; a thread is a child of a node.
const uint NODES = gl_WorkGroupSize.x / WIDTH;
// Words of a node: planes along x, y, z, each the least ones and then the greatest; references; nothing.
const uint PLANE_WORDS = 6u * WIDTH;

// A box as integers that sort like its coordinates.
struct Box {
    ivec3 least;
    ivec3 greatest;
};

const Box EMPTY = Box(ivec3(0x7fffffff), ivec3(0x80000000));

// From floats to integers that sort like them, and back; both zeros are one.
ivec3 sortable(uvec3 bits) {
    ivec3 whole = ivec3(mix(bits, uvec3(0u), equal(bits, uvec3(0x80000000u))));
    return whole ^ ((whole >> 31) & 0x7fffffff);
}

uvec3 float_bits(ivec3 sorted) {
    return uvec3(sorted ^ ((sorted >> 31) & 0x7fffffff));
}

Box around(Box one, Box other) {
    return Box(min(one.least, other.least), max(one.greatest, other.greatest));
}

// Of so many leaf records from the one at `place` on, in units of 16 bytes.
Box box_of_records(uint place, uint count) {
    Box box = EMPTY;
    for (uint number = 0u; number < count; ++number) {
        Words record = Words(push.structure + uint64_t(place) * 16ul + uint64_t(number * RECORD_BYTES));
        for (uint corner = 0u; corner < 9u; corner += 3u) {
            ivec3 at = sortable(uvec3(record.entries[corner], record.entries[corner + 1u], record.entries[corner + 2u]));
            box = around(box, Box(at, at));
        }
    }
    return box;
}

// Of all children of the node at `place`; a slot that holds nothing has a box that adds nothing.
Box box_of_node(uint place) {
    Words node = Words(push.structure + uint64_t(place) * 16ul);
    Box box = EMPTY;
    for (uint slot = 0u; slot < WIDTH; ++slot) {
        uvec3 least = uvec3(node.entries[slot], node.entries[2u * WIDTH + slot], node.entries[4u * WIDTH + slot]);
        uvec3 greatest = uvec3(node.entries[WIDTH + slot], node.entries[3u * WIDTH + slot], node.entries[5u * WIDTH + slot]);
        box = around(box, Box(sortable(least), sortable(greatest)));
    }
    return box;
}

float half_area(Box box) {
    vec3 sides = uintBitsToFloat(float_bits(box.greatest)) - uintBitsToFloat(float_bits(box.least));
    return sides.x * sides.y + sides.y * sides.z + sides.z * sides.x;
}

// What rays through each child cost.
shared float shared_cost[NODES][WIDTH];

void main() {
    uint slot = gl_LocalInvocationID.x % WIDTH;
    uint local = gl_LocalInvocationID.x / WIDTH;
    uint number = gl_WorkGroupID.x * NODES + local;
    bool is_there = number < push.count;
    uint node_number = is_there ? Words(push.order).entries[push.first + number] : 0u;
    Words node = Words(push.structure + uint64_t(node_number * NODE_BYTES));
    Words costs = Words(push.costs);

    float cost = 0.0;
    uint child = is_there ? node.entries[PLANE_WORDS + slot] : BVH_NOTHING;
    if (child != BVH_NOTHING) {
        uint place = child & BVH_PLACE_MASK;
        Box box;
        if (child >> 31 == 0u) {
            box = box_of_node(place);
            cost = half_area(box) + uintBitsToFloat(costs.entries[place / BVH_NODE_UNITS]);
        } else {
            uint count = (child >> BVH_PLACE_BITS & 3u) + 1u;
            box = box_of_records(place, count);
            cost = half_area(box) * float(count);
        }
        uvec3 least = float_bits(box.least);
        uvec3 greatest = float_bits(box.greatest);
        for (uint axis = 0u; axis < 3u; ++axis) {
            node.entries[2u * axis * WIDTH + slot] = least[axis];
            node.entries[(2u * axis + 1u) * WIDTH + slot] = greatest[axis];
        }
    }
    shared_cost[local][slot] = cost;
    barrier();

    // In the order of slots, so that the sum is always the same.
    if (is_there && slot == 0u) {
        for (uint other = 1u; other < WIDTH; ++other) {
            cost += shared_cost[local][other];
        }
        costs.entries[node_number] = floatBitsToUint(cost);
        if (node_number == 0u) {
            Words(push.answer).entries[0] = floatBitsToUint(cost);
        }
    }
}
