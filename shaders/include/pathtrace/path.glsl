// Paths of light, from the eye: at each surface lights are asked, and the material sends a ray on; what both could have found
// is shared by their densities (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, chapter 9). The two
// lobes of a material are two integrals, each with its own densities.
//
// An includer goes through stages in a loop with one call of trace():
//     RayPlan plan = plan_ray(view, path, random);
//     bool met = plan.is_worth_it && trace(view.world, path.at.start, plan.direction, plan.reach, path.mask, plan.is_shadow, hit);
//     take_ray(view, path, plan, met, hit, channels);
// until `path.is_over`.

#ifndef AFTERGLOW_PATHTRACE_PATH_GLSL
#define AFTERGLOW_PATHTRACE_PATH_GLSL

#include "light_tree.glsl"
#include "point.glsl"
#include "random.glsl"
#include "sky.glsl"

// Dimensions of a surface's numbers: the next ray, the far light, then those of each asked light.
#define DIMENSIONS 32u
#define DIMENSION_FAR 1u
#define DIMENSION_ASKED 2u
#define DIMENSIONS_ASKED 5u
// Most candidates of which a light is kept.
#define MOST_CANDIDATES 8u
// Surfaces after which a path may end at random.
#define ROULETTE_FROM 4u

struct RayPlan {
    vec3 direction;
    float reach;
    bool is_shadow;
    bool is_worth_it;
    // Of a shadow ray: what the light brings by each lobe if nothing hides it. Of the next ray: what of the light found there
    // is carried on (`diffuse`).
    vec3 diffuse;
    vec3 specular;
    // Of the next ray.
    float density;
    bool is_specular;
};

// Light of a sample by the way that it came: straight from lights by the first surface's diffuse lobe, by way of other
// surfaces and the sky, and by its specular lobe.
struct Channels {
    vec3 direct;
    vec3 indirect;
    vec3 specular;
    // What reaches the pixel of a radiance that is where the diffuse lobe's first ray has met nothing; 0 if it has.
    vec3 open;
    // The sky's light that comes so.
    vec3 sky;
};

Channels no_channels() {
    return Channels(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

struct Path {
    SurfacePoint at;
    vec3 to_viewer;
    RayCone cone;      // of the ray that has come here, where it ends
    uint mask;         // of instances that rays from here meet
    vec3 carried;      // what of the light found here reaches the first surface
    uint surfaces;     // before this one
    uint stage;        // 0.. lights with a place, the far lights, the next ray
    bool is_specular;  // it left the first surface by its specular lobe
    bool is_over;
    vec3 left;         // where it left the first surface to
};

// Samples that share what a surface's next ray stands for. Where they are independent, pictures are to have no bias: there
// they are taken to be so many that their cones are narrower than those of pixels.
float cone_samples(ViewRecord view) {
    return (view.traits & TRACE_INDEPENDENT) != 0u ? 16777216.0 : float(view.samples);
}

// How the numbers of a sample are made.
struct PathRandom {
    Random random;
    uint seed;
};

vec4 path_numbers(ViewRecord view, PathRandom random, uint dimension) {
    if ((view.traits & TRACE_INDEPENDENT) != 0u) {
        return independent(random.random.pixel, random.random.sample_index, dimension, random.seed);
    }
    return vec4(random_2d(random.random, 2u * dimension), random_2d(random.random, 2u * dimension + 1u));
}

// A path of which `at` is the first surface, met by a ray with this cone.
Path path_from(SurfacePoint at, vec3 to_viewer, uint mask, RayCone cone) {
    return Path(at, to_viewer, cone, mask, vec3(1.0), 0u, 0u, false, at.is_end, vec3(0.0));
}

uint placed_count(ViewRecord view) {
    return view.light_count - view.far_count;
}

// Whether each light with a place is asked at this surface.
bool asks_each(ViewRecord view, uint surfaces) {
    return surfaces == 0u && placed_count(view) <= view.asked;
}

// How many lights with a place are asked.
uint asked_count(ViewRecord view, uint surfaces) {
    return min(placed_count(view), surfaces == 0u ? view.asked : 1u);
}

// The chance with which a light with a place is the one that is asked.
float placed_chance(ViewRecord view, uint surfaces, LightSource light, vec3 start, vec3 normal) {
    if (asks_each(view, surfaces)) {
        return 1.0;
    }
    if ((view.traits & TRACE_UNIFORM_LIGHTS) != 0u) {
        return 1.0 / float(placed_count(view));
    }
    return tree_chance(view, light.trail, start, normal);
}

uint chosen_placed(ViewRecord view, vec3 start, vec3 normal, float random, out float chance) {
    if ((view.traits & TRACE_UNIFORM_LIGHTS) == 0u) {
        return tree_light(view, start, normal, random, chance);
    }
    uint count = placed_count(view);
    chance = 1.0 / float(count);
    return view.far_count + min(uint(random * float(count)), count - 1u);
}

// A vector in the frame in which the normal is z.
vec3 in_frame(mat2x3 frame, vec3 normal, vec3 vector) {
    return vec3(dot(frame[0], vector), dot(frame[1], vector), dot(normal, vector));
}

// A light with the densities of its choice.
struct Asked {
    LightSample to;
    // The chance of the light.
    float chance;
    // What its light is multiplied by in place of 1 over the chance.
    float weight;
};

// What a light's sample brings by each lobe, shared with the rays that the lobes send themselves.
void by_lobes(Path path, Asked asked, out vec3 diffuse, out vec3 specular) {
    diffuse = vec3(0.0);
    specular = vec3(0.0);
    SurfacePoint at = path.at;
    mat2x3 frame = tangents(at.normal);
    vec3 wi = in_frame(frame, at.normal, asked.to.direction);
    if (!(wi.z > 0.0) || dot(at.geometric, asked.to.direction) <= 0.0) {
        return;
    }
    vec3 wo = in_frame(frame, at.normal, path.to_viewer);
    float by_light = asked.chance * asked.to.density;
    float chance = specular_chance(at.bsdf, wo);
    vec3 brought = asked.to.brought * asked.weight;
    float share = by_light > 0.0 ? balance(by_light, (1.0 - chance) * diffuse_pdf(wi)) : 1.0;
    diffuse = brought * diffuse_value(at.bsdf, wi) * share;
    if (chance > 0.0) {
        share = by_light > 0.0 ? balance(by_light, chance * specular_pdf(at.bsdf, wo, wi)) : 1.0;
        specular = brought * specular_value(at.bsdf, wo, wi) * share;
    }
}

// What a light's sample is kept by: what it brings unshadowed.
float brings(Path path, LightSample to) {
    SurfacePoint at = path.at;
    mat2x3 frame = tangents(at.normal);
    vec3 wi = in_frame(frame, at.normal, to.direction);
    if (!(wi.z > 0.0)) {
        return 0.0;
    }
    vec3 value = diffuse_value(at.bsdf, wi);
    if (at.bsdf.specular != vec3(0.0)) {
        value += specular_value(at.bsdf, in_frame(frame, at.normal, path.to_viewer), wi);
    }
    return luminance(to.brought * value);
}

// One of several candidates, by what they bring unshadowed (Talbot, Cline and Egbert, Importance Resampling for Global
// Illumination, EGSR 2005).
Asked resampled(ViewRecord view, Path path, PathRandom random, uint dimension, uint part, uint parts) {
    vec4 choice = path_numbers(view, random, dimension);
    uint candidates = clamp(view.candidates, 1u, MOST_CANDIDATES);
    Asked kept = Asked(no_light(), 0.0, 0.0);
    float sum = 0.0;
    float kept_brings = 0.0;
    vec4 points = vec4(0.0);
    [[dont_unroll]] for (uint i = 0u; i < candidates; ++i) {
        if ((i & 1u) == 0u) {
            points = path_numbers(view, random, dimension + 1u + i / 2u);
        }
        // One number for all walks: what has a share of all light has its share of the candidates.
        float number = (float(part) + (float(i) + choice.x) / float(candidates)) / float(parts);
        float chance;
        uint light = chosen_placed(view, path.at.position, path.at.normal, number, chance);
        if (!(chance > 0.0)) {
            continue;
        }
        LightSample to = light_sample(light_source(view, light), path.at.position, (i & 1u) == 0u ? points.xy : points.zw);
        float own = brings(path, to);
        float weight = own / chance;
        sum += weight;
        // Reservoir sampling with one number, stretched again after each choice.
        float share = weight > 0.0 ? weight / sum : 0.0;
        if (choice.y < share) {
            kept = Asked(to, chance, 0.0);
            kept_brings = own;
            choice.y /= share;
        } else {
            choice.y = (choice.y - share) / max(1.0 - share, 1e-7);
        }
    }
    kept.weight = kept_brings > 0.0 ? sum / (kept_brings * float(candidates)) : 0.0;
    return kept;
}

// The ray starts off the surface that asks and ends where the light's point is.
RayPlan shadow_plan(Path path, Asked asked) {
    vec3 way = asked.to.direction * asked.to.reach + (path.at.position - path.at.start);
    RayPlan plan = RayPlan(unit_vector(way), length(way), true, false, vec3(0.0), vec3(0.0), 0.0, false);
    if (asked.weight > 0.0) {
        by_lobes(path, asked, plan.diffuse, plan.specular);
        plan.is_worth_it = plan.diffuse + plan.specular != vec3(0.0);
    }
    return plan;
}

RayPlan plan_placed(ViewRecord view, Path path, PathRandom random, uint dimension, uint count) {
    dimension += DIMENSION_ASKED + DIMENSIONS_ASKED * path.stage;
    if (asks_each(view, path.surfaces)) {
        LightSource light = light_source(view, view.far_count + path.stage);
        vec4 numbers = path_numbers(view, random, dimension);
        return shadow_plan(path, Asked(light_sample(light, path.at.position, numbers.xy), 1.0, 1.0));
    }
    Asked asked = resampled(view, path, random, dimension, path.stage, count);
    asked.weight /= float(count);
    return shadow_plan(path, asked);
}

RayPlan plan_far(ViewRecord view, Path path, PathRandom random, uint dimension) {
    vec4 numbers = path_numbers(view, random, dimension + DIMENSION_FAR);
    float chance;
    uint light = chosen_far(view, path.at.normal, numbers.x, chance);
    float weight = chance > 0.0 ? 1.0 / chance : 0.0;
    return shadow_plan(path, Asked(far_sample(light_source(view, light), numbers.yz), chance, weight));
}

// The next ray, by one of the lobes.
RayPlan plan_next(ViewRecord view, Path path, PathRandom random, uint dimension) {
    vec4 numbers = path_numbers(view, random, dimension);
    SurfacePoint at = path.at;
    mat2x3 frame = tangents(at.normal);
    vec3 wo = in_frame(frame, at.normal, path.to_viewer);
    float chance = specular_chance(at.bsdf, wo);
    RayPlan plan = RayPlan(at.normal, LONGEST_RAY, false, false, vec3(0.0), vec3(0.0), 0.0, numbers.z < chance);
    vec3 wi;
    if (plan.is_specular) {
        vec3 middle = sample_visible_normal(wo, at.bsdf.alpha, numbers.xy);
        wi = reflect(-wo, middle);
        plan.diffuse = schlick(at.bsdf.specular, dot(wo, middle)) * (smith_g1(at.bsdf.alpha, wi.z) / chance);
        plan.density = chance * specular_pdf(at.bsdf, wo, wi);
    } else {
        wi = cosine_direction(vec3(0.0, 0.0, 1.0), numbers.xy);
        plan.diffuse = at.bsdf.diffuse / (1.0 - chance);
        plan.density = (1.0 - chance) * diffuse_pdf(wi);
    }
    plan.direction = frame * wi.xy + at.normal * wi.z;
    vec3 carried = path.carried * plan.diffuse;
    if (path.surfaces >= ROULETTE_FROM && (view.traits & TRACE_ROULETTE) != 0u) {
        // Survival by what is carried bounds what is carried.
        float survival = min(max(carried.x, max(carried.y, carried.z)), 1.0);
        carried = numbers.w < survival ? carried / survival : vec3(0.0);
    }
    plan.diffuse = carried;
    plan.is_worth_it = wi.z > 0.0 && dot(at.geometric, plan.direction) > 0.0 && carried != vec3(0.0);
    return plan;
}

// The ray of the path's stage. Stages without a light are passed by.
RayPlan plan_ray(ViewRecord view, inout Path path, PathRandom random) {
    uint dimension = path.surfaces * DIMENSIONS;
    uint asked = asked_count(view, path.surfaces);
    if (path.stage < asked) {
        return plan_placed(view, path, random, dimension, asked);
    }
    if (path.stage == asked) {
        if (view.far_count != 0u) {
            return plan_far(view, path, random, dimension);
        }
        ++path.stage;
    }
    return plan_next(view, path, random, dimension);
}

void add_light(Path path, vec3 diffuse, vec3 specular, inout Channels channels) {
    diffuse *= path.carried;
    specular *= path.carried;
    if (path.surfaces == 0u) {
        channels.direct += diffuse;
        channels.specular += specular;
    } else if (path.is_specular) {
        channels.specular += diffuse + specular;
    } else {
        channels.indirect += diffuse + specular;
    }
}

// Light that the next ray has found, `is_lamp` from something that was asked too.
void add_found(Path path, RayPlan plan, vec3 radiance, bool is_lamp, inout Channels channels) {
    vec3 light = plan.diffuse * radiance;
    if (path.surfaces == 0u ? plan.is_specular : path.is_specular) {
        channels.specular += light;
    } else if (path.surfaces == 0u && is_lamp) {
        channels.direct += light;
    } else {
        channels.indirect += light;
    }
}

// How much of what a ray has found of a light is its own to bring.
float found_share(ViewRecord view, Path path, RayPlan plan, uint light, float away) {
    LightSource source = light_source(view, light);
    float chance = placed_chance(view, path.surfaces, source, path.at.position, path.at.normal);
    return balance(plan.density, chance * light_density(source, path.at.position, plan.direction, away));
}

// Far lights' discs, as a ray sees them that has met nothing.
vec3 far_radiance(ViewRecord view, Path path, RayPlan plan) {
    vec3 radiance = vec3(0.0);
    for (uint i = 0u; i < view.far_count; ++i) {
        LightSource light = light_source(view, i);
        if (light.radius > 0.0 && sees_far(light, plan.direction)) {
            float sin2 = light.radius * light.radius;
            float chance = far_importance(light, path.at.normal) / far_sum(view, path.at.normal);
            radiance += light.color / sin2 * balance(plan.density, chance / cap_solid_angle(sin2));
        }
    }
    return radiance;
}

// Takes what the next ray has met, and goes there.
void go_on(ViewRecord view, inout Path path, RayPlan plan, bool met, Hit hit, inout Channels channels) {
    bool is_first = path.surfaces == 0u;
    path.left = is_first ? plan.direction : path.left;
    if (!plan.is_worth_it || !met) {
        path.is_over = true;
        if (plan.is_worth_it) {
            add_found(path, plan, far_radiance(view, path, plan), true, channels);
            vec3 sky = sky_radiance(view, plan.direction, plan.density);
            // At the first surface the includer knows what else there is where nothing is.
            if (is_first && !plan.is_specular) {
                channels.open += plan.diffuse;
                channels.sky += plan.diffuse * sky;
            } else {
                add_found(path, plan, sky + view.ambient, false, channels);
            }
        }
        return;
    }
    RayCone cone = travelled(scattered(path.cone, plan.density, cone_samples(view)), hit.t);
    SurfacePoint point = surface_point(view, hit, plan.direction, cone);
    float share = point.light == NO_LIGHT ? 1.0 : found_share(view, path, plan, point.light, hit.t);
    add_found(path, plan, point.emission * share, point.light != NO_LIGHT, channels);
    bool is_last = path.surfaces + 1u >= view.most_surfaces;
    if (is_last && !point.is_end) {
        // Further surfaces are not gone to: the program's ambient light stands for them.
        add_found(path, plan, point.bsdf.diffuse * view.ambient, false, channels);
    }
    path.is_specular = is_first ? plan.is_specular : path.is_specular;
    path.at = point;
    path.to_viewer = -plan.direction;
    path.cone = cone;
    path.mask = MASK_STATIC | MASK_MOVING;
    path.carried = plan.diffuse;
    path.surfaces += 1u;
    path.stage = 0u;
    path.is_over = is_last || point.is_end;
}

// Takes what a ray has met, and moves on to the next stage.
void take_ray(ViewRecord view, inout Path path, RayPlan plan, bool met, Hit hit, inout Channels channels) {
    if (!plan.is_shadow) {
        go_on(view, path, plan, met, hit, channels);
        return;
    }
    if (plan.is_worth_it && !met) {
        add_light(path, plan.diffuse, plan.specular, channels);
    }
    ++path.stage;
}

// Rays of a sample, at most.
uint most_rays(ViewRecord view) {
    return view.asked + 2u + 3u * view.most_surfaces;
}

#endif
