// Lights that pixels keep from frame to frame and lend to their neighbours (Bitterli and others, Spatiotemporal Reservoir
// Resampling for Real-Time Ray Tracing with Dynamic Direct Lighting, SIGGRAPH 2020). What is kept is a light and the numbers
// that choose its point: at another surface the same numbers choose the point that is seen from there, so nothing has to be
// weighed for the change of place.

#ifndef AFTERGLOW_PATHTRACE_RESERVOIR_GLSL
#define AFTERGLOW_PATHTRACE_RESERVOIR_GLSL

#include "eye.glsl"
#include "path.glsl"

// Neighbours that are asked for theirs.
#define NEIGHBOURS 4u
// How far away they are, pixels.
const float NEIGHBOUR_RADIUS = 24.0;
// Candidates that an earlier frame's choice counts for, in numbers of this frame's.
const float MOST_HISTORY = 20.0;
// What surfaces have in common that lend each other lights.
const float LEAST_COSINE = 0.9;
const float PLANE_SHARE = 0.05;

// A pixel's surface, its diffuse lobe white.
SurfacePoint seen_point(SurfaceTexel surface) {
    SurfacePoint seen = shining_point(vec3(0.0), NO_LIGHT);
    seen.start = surface.start;
    seen.position = surface.start;
    seen.normal = unpack_unit_vector(surface.normal);
    seen.geometric = unpack_unit_vector(surface.geometric);
    vec3 specular = linear_from_srgb(unpack_unorm11(surface.specular));
    seen.bsdf = Bsdf(vec3(has_diffuse_lobe(surface) ? 1.0 : 0.0), specular, alpha_of(surface_roughness(surface)));
    seen.is_end = false;
    return seen;
}

// What a light's point brings to a surface that is seen along `to_viewer`.
float brings_to(ViewRecord view, SurfacePoint at, vec3 to_viewer, ReservoirTexel kept) {
    LightSample to = light_sample(light_source(view, kept.light), at.position, unpackUnorm2x16(kept.point));
    return brings(path_from(at, to_viewer, 0u, camera_cone(0.0)), to);
}

// A choice among candidates that are added one by one.
struct Reservoir {
    ReservoirTexel kept;
    float sum;
    float random; // chooses, stretched again after each choice
};

const ReservoirTexel NOTHING_KEPT = ReservoirTexel(0u, 0u, 0.0, 0.0, 0.0);

Reservoir new_reservoir(float random) {
    return Reservoir(NOTHING_KEPT, 0.0, random);
}

// Adds a candidate that brings `brings` here, with its share of the sum.
void add_candidate(ReservoirTexel candidate, float brings, float share, inout Reservoir reservoir) {
    if (!(share > 0.0)) {
        return;
    }
    reservoir.sum += share;
    float chance = share / reservoir.sum;
    if (reservoir.random < chance) {
        reservoir.kept = candidate;
        reservoir.kept.brings = brings;
        reservoir.random /= chance;
    } else {
        reservoir.random = (reservoir.random - chance) / max(1.0 - chance, 1e-7);
    }
}

// The choice, its weight such that what it brings times the weight is the sum on average.
ReservoirTexel chosen(Reservoir reservoir, float count) {
    ReservoirTexel kept = reservoir.kept;
    kept.weight = kept.brings > 0.0 ? reservoir.sum / kept.brings : 0.0;
    kept.count = count;
    return kept;
}

// Whether two surfaces are near enough in place and direction; `other` is relative to the same origin.
bool is_alike(SurfacePoint at, vec3 other, vec3 other_normal, uint kind, uint other_kind) {
    float away = length(at.start);
    return kind == other_kind && dot(at.normal, other_normal) > LEAST_COSINE
        && abs(dot(at.geometric, other - at.start)) < PLANE_SHARE * away;
}

// Whether a texel can be used: its light may have gone.
bool is_sound(ViewRecord view, ReservoirTexel texel) {
    return texel.weight > 0.0 && texel.weight < 1e18 && texel.brings > 0.0 && texel.light < view.light_count;
}

// A choice among candidates of this frame's own.
ReservoirTexel own_choice(ViewRecord view, Path path, PathRandom random, uint dimension, uint candidates) {
    vec4 numbers = path_numbers(view, random, dimension);
    Reservoir reservoir = new_reservoir(numbers.x);
    [[dont_unroll]] for (uint i = 0u; i < candidates; ++i) {
        float chance;
        float number = (float(i) + numbers.y) / float(candidates);
        ReservoirTexel candidate = NOTHING_KEPT;
        candidate.light = chosen_placed(view, path.at.position, path.at.normal, number, chance);
        candidate.point = packUnorm2x16(path_numbers(view, random, dimension + 1u + i).xy);
        if (chance > 0.0) {
            float own = brings_to(view, path.at, path.to_viewer, candidate);
            add_candidate(candidate, own, own / (chance * float(candidates)), reservoir);
        }
    }
    return chosen(reservoir, float(candidates));
}

// The pixel that showed a place in the frame before; false if none did.
bool pixel_before(ViewRecord view, vec3 position, out uvec2 pixel) {
    vec2 place;
    bool is_before = place_before(view, position, place);
    vec2 size = vec2(view_size(view));
    pixel = uvec2(clamp(place, vec2(0.0), size - 1.0));
    return is_before && all(greaterThan(place, vec2(0.0))) && all(lessThan(place, size));
}

// Two choices for one surface, one of them made for `other`: each has the share that the balance heuristic gives it.
ReservoirTexel merged(ViewRecord view, Path path, ReservoirTexel own, ReservoirTexel old, SurfacePoint other, vec3 other_viewer, float random) {
    Reservoir reservoir = new_reservoir(random);
    float count = own.count + old.count;
    if (own.weight > 0.0) {
        float there = brings_to(view, other, other_viewer, own);
        float share = own.count * own.brings / (own.count * own.brings + old.count * there);
        add_candidate(own, own.brings, share * own.brings * own.weight, reservoir);
    }
    if (is_sound(view, old)) {
        float here = brings_to(view, path.at, path.to_viewer, old);
        float share = old.count * old.brings / (own.count * here + old.count * old.brings);
        add_candidate(old, here, share * here * old.weight, reservoir);
    }
    return chosen(reservoir, count);
}

// A pixel's choice with what the frame before has kept there.
ReservoirTexel chosen_over_time(ViewRecord view, Path path, PathRandom random, uint kind) {
    uint candidates = clamp(view.candidates, 1u, MOST_CANDIDATES);
    ReservoirTexel own = own_choice(view, path, random, 1u, candidates);
    uvec2 before;
    if (view.reservoirs_before == 0ul || !pixel_before(view, path.at.start, before)) {
        return own;
    }
    uint index = before.y * view.width + before.x;
    SurfaceTexel surface = SurfaceTexels(view.surfaces_before).entries[index];
    SurfacePoint other = seen_point(surface);
    vec3 other_viewer = to_eye(view, other.start);
    other.start += view.origin_before;
    other.position += view.origin_before;
    if (!is_alike(path.at, other.start, other.normal, kind, surface_kind(surface))) {
        return own;
    }
    ReservoirTexel old = Reservoirs(view.reservoirs_before).entries[index];
    old.count = min(old.count, MOST_HISTORY * float(candidates));
    return merged(view, path, own, old, other, other_viewer, path_numbers(view, random, 0u).x);
}

// A light by the pixel's own choice and some neighbours', each with its share by pairs (Bitterli, Correlations and Reuse
// for Fast and Accurate Physically Based Light Transport, 2022, section 9.1.3).
Asked chosen_among_neighbours(ViewRecord view, Path path, PathRandom random, uint dimension, uvec2 pixel, uint kind) {
    vec4 numbers = path_numbers(view, random, dimension);
    ReservoirTexel own = Reservoirs(view.reservoirs).entries[pixel.y * view.width + pixel.x];
    Reservoir reservoir = new_reservoir(numbers.x);
    // Shares of pairs; their number is known at the end, so the sum is of as many times too much.
    float pairs = 0.0;
    float own_share = 0.0;
    [[dont_unroll]] for (uint i = 0u; i < NEIGHBOURS; ++i) {
        // Spread over the disc by the golden angle.
        float radius = NEIGHBOUR_RADIUS * sqrt((float(i) + numbers.y) / float(NEIGHBOURS));
        float angle = 6.2831853 * (numbers.z + 0.381966 * float(i));
        vec2 place = vec2(pixel) + radius * vec2(cos(angle), sin(angle)) + 0.5;
        if (any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(place, vec2(view_size(view))))) {
            continue;
        }
        uint index = uint(place.y) * view.width + uint(place.x);
        SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[index];
        SurfacePoint other = seen_point(surface);
        if (!is_alike(path.at, other.start, other.normal, kind, surface_kind(surface))) {
            continue;
        }
        ReservoirTexel theirs = Reservoirs(view.reservoirs).entries[index];
        pairs += 1.0;
        float own_count = own.count / float(NEIGHBOURS);
        if (own.weight > 0.0) {
            float there = brings_to(view, other, to_eye(view, other.start), own);
            own_share += own_count * own.brings / (own_count * own.brings + theirs.count * there);
        }
        if (is_sound(view, theirs)) {
            float here = brings_to(view, path.at, path.to_viewer, theirs);
            float share = theirs.count * theirs.brings / (own_count * here + theirs.count * theirs.brings);
            add_candidate(theirs, here, share * here * theirs.weight, reservoir);
        }
    }
    if (own.weight > 0.0) {
        add_candidate(own, own.brings, (pairs > 0.0 ? own_share : 1.0) * own.brings * own.weight, reservoir);
    }
    ReservoirTexel kept = chosen(reservoir, 0.0);
    if (!(kept.weight > 0.0)) {
        return Asked(no_light(), 0.0, 0.0);
    }
    LightSource light = light_source(view, kept.light);
    float chance = placed_chance(view, 0u, light, path.at.position, path.at.normal);
    LightSample to = light_sample(light, path.at.position, unpackUnorm2x16(kept.point));
    return Asked(to, chance, kept.weight / max(pairs, 1.0));
}

#endif
