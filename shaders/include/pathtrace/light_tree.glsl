// One light of many, by walks down a tree: at each turn the side is taken that may bring more, with a chance in proportion
// (Conty Estevez and Kulla, Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG 2018).

#ifndef AFTERGLOW_PATHTRACE_LIGHT_TREE_GLSL
#define AFTERGLOW_PATHTRACE_LIGHT_TREE_GLSL

#include "lights.glsl"

// More turns than any tree has.
#define MOST_TURNS 32u

LightNode light_node(ViewRecord view, uint node) {
    return LightNodeTable(view.light_nodes).entries[node];
}

// The cosine of the angle by which a exceeds b, given cosines and sines; 1 where it does not.
float cos_of_excess(float cos_a, float sin_a, float cos_b, float sin_b) {
    return cos_a >= cos_b ? 1.0 : cos_a * cos_b + sin_a * sin_b;
}

float sin_from_cos(float cosine) {
    return sqrt(max(1.0 - cosine * cosine, 0.0));
}

// What the lights of a node may bring to a surface that faces `normal`: not 0 where any of them brings something.
float node_importance(LightNode node, vec3 start, vec3 normal) {
    vec3 center = 0.5 * (node.least + node.greatest);
    vec3 half_size = 0.5 * (node.greatest - node.least);
    vec3 way = center - start;
    float radius2 = dot(half_size, half_size);
    float away2 = dot(way, way);
    if (away2 <= radius2) {
        // Inside of what surrounds them they may be anywhere.
        float near = sqrt(radius2);
        return node.power / max(dot(node.attenuation, vec3(1.0, near, radius2)), 1e-20);
    }
    float away = sqrt(away2);
    vec3 direction = way / away;
    // The angle that their surrounding sphere takes up.
    float sin_size = sqrt(radius2 / away2);
    float cos_size = sqrt(max(1.0 - radius2 / away2, 0.0));
    float cos_here = dot(normal, direction);
    float facing_here = cos_of_excess(cos_here, sin_from_cos(cos_here), cos_size, sin_size);
    float facing_there = 1.0;
    if (node.cos_spread > -1.0) {
        float cos_there = -dot(node.axis, direction);
        float sin_spread = sin_from_cos(node.cos_spread);
        float sin_there = sin_from_cos(cos_there);
        float cos_left = cos_of_excess(cos_there, sin_there, node.cos_spread, sin_spread);
        facing_there = cos_of_excess(cos_left, sin_from_cos(cos_left), cos_size, sin_size);
    }
    float falloff = max(dot(node.attenuation, vec3(1.0, away, away2)), 1e-20);
    return node.power * max(facing_here, 0.0) * max(facing_there, 0.0) / falloff;
}

// The chance that a walk at an inner node turns to its first child; below 0 where neither side brings anything.
float chance_of_first(ViewRecord view, uint node, uint second, vec3 start, vec3 normal) {
    float first_brings = node_importance(light_node(view, node + 1u), start, normal);
    float second_brings = node_importance(light_node(view, second), start, normal);
    float sum = first_brings + second_brings;
    return sum > 0.0 ? first_brings / sum : -1.0;
}

// A light with a place, and the chance of it; 0 if none brings anything. `random` in [0, 1).
uint tree_light(ViewRecord view, vec3 start, vec3 normal, float random, out float chance) {
    uint node = 0u;
    chance = 1.0;
    for (uint turn = 0u; turn < MOST_TURNS; ++turn) {
        uint next = light_node(view, node).next;
        if ((next & LIGHT_LEAF) != 0u) {
            return next & ~LIGHT_LEAF;
        }
        float first = chance_of_first(view, node, next, start, normal);
        if (first < 0.0) {
            break;
        }
        bool is_first = random < first;
        float own = is_first ? first : 1.0 - first;
        random = min((is_first ? random : random - first) / own, 0.99999994);
        chance *= own;
        node = is_first ? node + 1u : next;
    }
    chance = 0.0;
    return 0u;
}

// The chance with which a walk ends at a light.
float tree_chance(ViewRecord view, uint trail, vec3 start, vec3 normal) {
    if (trail == NO_TRAIL) {
        return 0.0;
    }
    uint node = 0u;
    float chance = 1.0;
    for (uint turn = 0u; turn < MOST_TURNS; ++turn) {
        uint next = light_node(view, node).next;
        if ((next & LIGHT_LEAF) != 0u) {
            break;
        }
        float first = chance_of_first(view, node, next, start, normal);
        bool is_first = (trail >> turn & 1u) == 0u;
        chance *= first < 0.0 ? 0.0 : is_first ? first : 1.0 - first;
        node = is_first ? node + 1u : next;
    }
    return chance;
}

#endif
