// Lights that pixels keep from frame to frame and lend to their neighbours (Bitterli and others, Spatiotemporal Reservoir
// Resampling for Real-Time Ray Tracing with Dynamic Direct Lighting, SIGGRAPH 2020). What is kept is a light and the numbers
// that choose its point: at another surface the same numbers choose the point that is seen from there, so nothing has to be
// weighed for the change of place.

#ifndef AFTERGLOW_PATHTRACE_RESERVOIR_GLSL
#define AFTERGLOW_PATHTRACE_RESERVOIR_GLSL

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
    seen.normal = unpack_unit_vector(surface.normal);
    seen.geometric = unpack_unit_vector(surface.geometric);
    vec3 specular = linear_from_srgb(unpack_color(surface.specular));
    seen.bsdf = Bsdf(vec3(has_diffuse_lobe(surface) ? 1.0 : 0.0), specular, alpha_of(unpack_fourth(surface.specular)));
    seen.is_end = false;
    return seen;
}

// A choice among candidates that are added one by one.
struct Reservoir {
    ReservoirTexel kept;
    LightSample to;
    float kept_brings;
    float sum;
    float count;
    float random; // chooses, stretched again after each choice
};

Reservoir new_reservoir(float random) {
    return Reservoir(ReservoirTexel(0u, 0u, 0.0, 0.0), no_light(), 0.0, 0.0, 0.0, random);
}

// Adds a candidate that stands for `count`. `weight` is what its sample is multiplied by where it comes from.
void add_candidate(ViewRecord view, Path path, uint light, uint point, float weight, float count, inout Reservoir reservoir) {
    reservoir.count += count;
    if (!(weight > 0.0) || light >= view.light_count) {
        return;
    }
    LightSample to = light_sample(light_source(view, light), path.at.start, unpackUnorm2x16(point));
    float own = brings(path, to);
    float share = own * weight * count;
    if (!(share > 0.0)) {
        return;
    }
    reservoir.sum += share;
    float chance = share / reservoir.sum;
    if (reservoir.random < chance) {
        reservoir.kept.light = light;
        reservoir.kept.point = point;
        reservoir.to = to;
        reservoir.kept_brings = own;
        reservoir.random /= chance;
    } else {
        reservoir.random = (reservoir.random - chance) / max(1.0 - chance, 1e-7);
    }
}

// The kept one's weight, if `count` candidates could have brought it.
float kept_weight(Reservoir reservoir, float count) {
    return reservoir.kept_brings > 0.0 && count > 0.0 ? reservoir.sum / (reservoir.kept_brings * count) : 0.0;
}

// Whether a light's point brings anything to a surface: only such could have kept it.
bool could_keep(ViewRecord view, ReservoirTexel kept, vec3 start, vec3 normal) {
    LightSample to = light_sample(light_source(view, kept.light), start, unpackUnorm2x16(kept.point));
    return dot(to.direction, normal) > 0.0 && to.brought != vec3(0.0);
}

// Whether two surfaces are near enough in place and direction; `other` is relative to the same origin.
bool is_alike(SurfacePoint at, vec3 other, vec3 other_normal, uint kind, uint other_kind) {
    float away = length(at.start);
    return kind == other_kind && dot(at.normal, other_normal) > LEAST_COSINE
        && abs(dot(at.geometric, other - at.start)) < PLANE_SHARE * away;
}

// Candidates of this frame's own.
void add_own(ViewRecord view, Path path, PathRandom random, uint dimension, uint candidates, inout Reservoir reservoir) {
    float first = path_numbers(view, random, dimension).z;
    [[dont_unroll]] for (uint i = 0u; i < candidates; ++i) {
        float chance;
        float number = (float(i) + first) / float(candidates);
        uint light = chosen_placed(view, path.at.start, path.at.normal, number, chance);
        uint point = packUnorm2x16(path_numbers(view, random, dimension + 1u + i).xy);
        add_candidate(view, path, light, point, chance > 0.0 ? 1.0 / chance : 0.0, 1.0, reservoir);
    }
}

// The pixel that showed a place in the frame before; false if none did.
bool pixel_before(ViewRecord view, vec3 position, out uvec2 pixel) {
    vec4 at = vec4(position, 1.0);
    vec4 clip = vec4(dot(view.clip_before[0], at), dot(view.clip_before[1], at), dot(view.clip_before[2], at), dot(view.clip_before[3], at));
    vec2 flat_xy = clip.xy / clip.w;
    pixel = uvec2(clamp((flat_xy * vec2(0.5, -0.5) + 0.5) * vec2(view_size(view)), vec2(0.0), vec2(view_size(view)) - 1.0));
    return clip.w > 0.0 && all(lessThan(abs(flat_xy), vec2(1.0)));
}

// A pixel's choice with what the frame before has kept there.
ReservoirTexel chosen_over_time(ViewRecord view, Path path, PathRandom random, uint kind) {
    uint candidates = clamp(view.candidates, 1u, MOST_CANDIDATES);
    Reservoir reservoir = new_reservoir(path_numbers(view, random, 0u).x);
    add_own(view, path, random, 0u, candidates, reservoir);
    float count = reservoir.count;
    uvec2 before;
    if (view.reservoirs_before != 0ul && pixel_before(view, path.at.start, before)) {
        uint index = before.y * view.width + before.x;
        SurfaceTexel surface = SurfaceTexels(view.surfaces_before).entries[index];
        vec3 start = surface.start + view.origin_before;
        vec3 normal = unpack_unit_vector(surface.normal);
        if (is_alike(path.at, start, normal, kind, surface_kind(surface))) {
            ReservoirTexel old = Reservoirs(view.reservoirs_before).entries[index];
            old.count = min(old.count, MOST_HISTORY * float(candidates));
            add_candidate(view, path, old.light, old.point, old.weight, old.count, reservoir);
            count += could_keep(view, reservoir.kept, start, normal) ? old.count : 0.0;
        }
    }
    reservoir.kept.weight = kept_weight(reservoir, count);
    reservoir.kept.count = reservoir.count;
    return reservoir.kept;
}

// A light by the pixel's own choice and some neighbours'.
Asked chosen_among_neighbours(ViewRecord view, Path path, PathRandom random, uint dimension, uvec2 pixel, uint kind) {
    vec4 numbers = path_numbers(view, random, dimension);
    Reservoir reservoir = new_reservoir(numbers.x);
    uint places[NEIGHBOURS + 1u];
    float counts[NEIGHBOURS + 1u];
    [[dont_unroll]] for (uint i = 0u; i <= NEIGHBOURS; ++i) {
        // Spread over the disc by the golden angle.
        float radius = NEIGHBOUR_RADIUS * sqrt((float(i) - numbers.y) / float(NEIGHBOURS));
        float angle = 6.2831853 * (numbers.z + 0.381966 * float(i));
        vec2 apart = i == 0u ? vec2(0.0) : radius * vec2(cos(angle), sin(angle));
        vec2 most = vec2(view_size(view)) - 1.0;
        uvec2 place = uvec2(clamp(vec2(pixel) + apart + 0.5, vec2(0.0), most));
        uint index = place.y * view.width + place.x;
        SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[index];
        places[i] = index;
        counts[i] = 0.0;
        if (i == 0u || is_alike(path.at, surface.start, unpack_unit_vector(surface.normal), kind, surface_kind(surface))) {
            ReservoirTexel own = Reservoirs(view.reservoirs).entries[index];
            counts[i] = own.count;
            add_candidate(view, path, own.light, own.point, own.weight, own.count, reservoir);
        }
    }
    if (!(reservoir.kept_brings > 0.0)) {
        return Asked(no_light(), 0.0, 0.0);
    }
    float count = counts[0];
    [[dont_unroll]] for (uint i = 1u; i <= NEIGHBOURS; ++i) {
        if (counts[i] > 0.0) {
            SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[places[i]];
            bool could = could_keep(view, reservoir.kept, surface.start, unpack_unit_vector(surface.normal));
            count += could ? counts[i] : 0.0;
        }
    }
    LightSource light = light_source(view, reservoir.kept.light);
    float chance = placed_chance(view, 0u, light, path.at.start, path.at.normal);
    return Asked(reservoir.to, chance, kept_weight(reservoir, count));
}

#endif
