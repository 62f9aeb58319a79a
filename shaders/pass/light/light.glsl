// Light that reaches each pixel's surface, by rays: one ray at a time, from one place in the code. light.comp and light.rgen
// are this pass for the two backends of trace.glsl.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "trace.glsl"
#include "denoise/channels.glsl"
#include "denoise/gradients.glsl"
#include "pathtrace/eye.glsl"
#include "pathtrace/finite.glsl"
#include "pathtrace/reservoir.glsl"
#include "pathtrace/spherical_harmonics.glsl"

// How dark things that touch a surface with baked light make it.
const float CONTACT_STRENGTH = 0.85;

// Of baked surfaces among things that move: how much of the sky's and the recovered lights' light is left, and what these
// would bring if nothing moved.
struct Shade {
    float contact;
    vec3 direct;
    vec3 unmoved;
};

// Sums over the samples of a pixel.
struct Sums {
    Channels light;
    // Luminance of indirect light times where it comes from, aside of the normal; and of what is open.
    vec3 towards;
    vec3 towards_open;
    // Sum of how far specular rays went, and how many of them met something.
    vec2 reflected;
    Shade shade;
};

// A sample's light, limited so that rare paths leave no bright dots; counted where it was.
vec3 limited(ViewRecord view, vec3 light) {
    FiniteRadiance finite = finite_radiance(light);
    light = finite.value;
    float brightest = max(light.x, max(light.y, light.z));
    if (!finite.was_finite) {
        atomicAdd(Counters(view.counters).entries[0].non_finite, 1u);
        return vec3(0.0);
    }
    if ((view.traits & TRACE_UNLIMITED) != 0u || brightest <= view.most_radiance) {
        return light;
    }
    vec3 kept = light * (view.most_radiance / brightest);
    atomicAdd(Counters(view.counters).entries[0].limited, 1u);
    atomicAdd(Counters(view.counters).entries[0].removed, uint(min(luminance(light - kept) * 16.0, 65536.0) + 0.5));
    return kept;
}

// Stages of a sample of a surface with baked light: contact, then one of the lights that were baked: first what stands still is
// asked whether it hides it, then what moves.
#define STAGE_CONTACT 0u
#define STAGE_STILL 1u
#define STAGE_MOVED 2u

RayPlan plan_shade(ViewRecord view, inout Path path, PathRandom random, RayPlan asked) {
    path.mask = path.stage == STAGE_STILL ? MASK_STATIC : MASK_MOVING;
    if (path.stage == STAGE_MOVED) {
        return asked;
    }
    vec4 numbers = path_numbers(view, random, path.stage);
    if (path.stage == STAGE_CONTACT) {
        vec3 direction = cosine_direction(path.at.normal, numbers.xy);
        return RayPlan(direction, view.contact_reach, false, true, vec3(0.0), vec3(0.0), 0.0, false);
    }
    bool is_far = view.far_count != 0u && (placed_count(view) == 0u || numbers.x < 0.5);
    float chance = 0.0;
    bool is_both = view.far_count != 0u && placed_count(view) != 0u;
    float number = is_both ? fract(2.0 * numbers.x) : numbers.x;
    uint light = is_far ? chosen_far(view, path.at.normal, number, chance)
        : chosen_placed(view, path.at.position, path.at.normal, number, chance);
    float weight = chance > 0.0 ? (is_both ? 2.0 : 1.0) / chance : 0.0;
    return shadow_plan(path, Asked(light_sample(light_source(view, light), path.at.position, numbers.yz), chance, weight));
}

void take_shade(ViewRecord view, inout Path path, inout RayPlan asked, RayPlan plan, bool met, float away, inout Shade shade) {
    if (path.stage == STAGE_CONTACT) {
        shade.contact += met ? 1.0 - CONTACT_STRENGTH * (1.0 - away / plan.reach) : 1.0;
    } else if (plan.is_worth_it && !met) {
        vec3 brought = limited(view, plan.diffuse);
        shade.unmoved += path.stage == STAGE_STILL ? brought : vec3(0.0);
        shade.direct += path.stage == STAGE_MOVED ? brought : vec3(0.0);
    }
    asked = path.stage == STAGE_STILL && !met ? plan : RayPlan(path.at.normal, 0.0, true, false, vec3(0.0), vec3(0.0), 0.0, false);
    path.is_over = path.stage == STAGE_MOVED || view.light_count == 0u;
    ++path.stage;
}

// `aside` is where the sample left the surface to, without its part along the normal.
void add_sample(ViewRecord view, Channels light, vec3 aside, inout Sums sums) {
    vec3 indirect = limited(view, light.indirect);
    sums.light.direct += limited(view, light.direct);
    sums.light.indirect += indirect;
    sums.light.specular += limited(view, light.specular);
    sums.light.open += light.open;
    sums.light.sky += light.sky;
    sums.towards += luminance(indirect) * aside;
    vec3 open = light.sky + (is_relit(view) ? vec3(0.0) : light.open * view.ambient);
    sums.towards_open += luminance(open) * aside;
}

// The ray of a path's stage. Where lights are kept over time, the first surface asks by those.
RayPlan plan_seen(ViewRecord view, inout Path path, PathRandom random, uvec2 pixel, uint kind) {
    bool is_kept = view.reservoirs != 0ul && path.surfaces == 0u && path.stage < view.asked;
    if (!is_kept) {
        return plan_ray(view, path, random);
    }
    uint dimension = DIMENSION_ASKED + DIMENSIONS_ASKED * path.stage;
    Asked asked = chosen_among_neighbours(view, path, random, dimension, pixel, kind);
    asked.weight /= float(view.asked);
    return shadow_plan(path, asked);
}

// The samples of a pixel. `seen` reflects what it is asked for: its albedo meets the light when the picture is made.
Sums gather(ViewRecord view, SurfacePoint seen, uvec2 pixel, uint kind, uint mask, Random numbers, uint samples) {
    Sums sums = Sums(no_channels(), vec3(0.0), vec3(0.0), vec2(0.0), Shade(0.0, vec3(0.0), vec3(0.0)));
    bool is_baked = kind == SURFACE_BAKED;
    PathRandom random = PathRandom(numbers, view.seed);
    vec3 to_viewer = to_eye(view, seen.start);
    RayCone cone = seen_cone(view, length(seen.start));
    Path path = path_from(seen, to_viewer, mask, cone);
    Channels light = no_channels();
    RayPlan asked = RayPlan(seen.normal, 0.0, true, false, vec3(0.0), vec3(0.0), 0.0, false);
    uint done = 0u;
    uint rays = 0u;
    [[dont_unroll]] for (uint i = samples * most_rays(view); i != 0u && done < samples; --i) {
        RayPlan plan;
        if (is_baked) {
            plan = plan_shade(view, path, random, asked);
        } else {
            plan = plan_seen(view, path, random, pixel, kind);
        }
        Hit hit;
        bool met = false;
        if (plan.is_worth_it) {
            met = trace(view.world, path.at.start, plan.direction, plan.reach, path.mask, plan.is_shadow, hit);
            ++rays;
        }
        if (is_baked) {
            take_shade(view, path, asked, plan, met, hit.t, sums.shade);
        } else {
            if (path.surfaces == 0u && plan.is_specular && met) {
                sums.reflected += vec2(hit.t, 1.0);
            }
            take_ray(view, path, plan, met, hit, light);
        }
        if (path.is_over) {
            add_sample(view, light, aside_of(path.left, seen.normal), sums);
            light = no_channels();
            path = path_from(seen, to_viewer, mask, cone);
            ++random.random.sample_index;
            ++done;
            if (done == view.samples) {
                // What is spent besides is of another sequence: the pixel's own goes on in the next frame.
                random.random.pixel = hash(random.random.pixel);
            }
        }
    }
    atomicAdd(Counters(view.counters).entries[0].rays, rays);
    return sums;
}

// How much of a baked surface's light is left where moving things take some of it away. The bake adds up as the
// program stored it, which is not linear light.
vec3 light_left(ViewRecord view, Shade shade, float samples) {
    vec3 contact = vec3(shade.contact / samples);
    if (view.light_count == 0u) {
        return contact;
    }
    vec3 diffuse = max(view.ambient + view.sky, 1e-3);
    vec3 left = (diffuse * contact + shade.direct / samples) / (diffuse + shade.unmoved / samples);
    return pow(clamp(left, 0.0, 1.0), vec3(2.2));
}

// A pixel's light, and how far its specular rays went.
struct Found {
    LightTexel light;
    float reflected;
};

// The mean of a pixel's samples, as composition takes it.
Found found_light(ViewRecord view, SurfaceTexel surface, uvec2 pixel, Random numbers, uint sample_count) {
    uint kind = surface_kind(surface);
    if (kind == SURFACE_BAKED && view.has_movers == 0u) {
        return Found(LightTexel(vec3(0.0), vec3(1.0), vec3(0.0), vec3(0.0)), 0.0);
    }
    SurfacePoint seen = seen_point(surface);
    Sums sums = gather(view, seen, pixel, kind, surface_ray_mask(surface), numbers, sample_count);
    float samples = float(sample_count);
    if (kind == SURFACE_BAKED) {
        return Found(LightTexel(vec3(0.0), light_left(view, sums.shade, samples), vec3(0.0), vec3(0.0)), 0.0);
    }
    Channels light = sums.light;
    // What is baked has its constant part everywhere; elsewhere it comes from where nothing is.
    bool is_replaced = kind == SURFACE_LIT && is_relit(view);
    // Catchers show how much of the mean light they get.
    vec3 open = kind == SURFACE_CATCHER ? light.open * view.sky : light.sky;
    open += is_replaced ? vec3(0.0) : light.open * view.ambient;
    if (is_replaced) {
        light.indirect = light.indirect * view.bounce + samples * view.ambient;
    }
    if (kind == SURFACE_BAKED_MOVER) {
        // Where nothing was met there may be walls that were not drawn: it is no darker there than elsewhere.
        open = max(open, light.open * light.indirect / max(samples - light.open, 1.0));
    }
    light.indirect += open;
    if (kind == SURFACE_BAKED_MOVER) {
        // Few samples and many lights: it is smoothed with the rest.
        light.indirect += light.direct;
        light.direct = vec3(0.0);
    }
    vec3 scale = vec3(1.0 / samples);
    vec3 light_scale = scale;
    if (kind == SURFACE_CATCHER) {
        light_scale /= max(open_light(view, seen.start, seen.normal), 1e-3);
    }
    // Only surfaces whose indirect light is indirect light alone.
    vec3 towards = vec3(0.0);
    if (kind == SURFACE_LIT) {
        towards = sums.towards * (is_replaced ? luminance(view.bounce) : 1.0) + sums.towards_open;
    }
    LightTexel found = LightTexel(light.direct * light_scale, light.indirect * light_scale,
        light.specular * scale / specular_share(surface), TOWARDS_SCALE * towards * scale);
    return Found(found, sums.reflected.x / max(sums.reflected.y, 1.0));
}

// A pixel's own numbers: a sequence that goes on from frame to frame.
Random own_numbers(ViewRecord view, uint index, uint first) {
    return Random(hash(index + hash(view.seed)), first);
}

// The numbers of a texel of light. One of each stratum is traced with those of its place in the frame before, so that what differs is
// the light.
Random texel_numbers(ViewRecord view, uvec2 texel, uint index, out bool is_again) {
    is_again = false;
    if (view.strata != 0ul) {
        uvec2 stratum = texel / STRATUM_EDGE;
        uvec2 place = texel - STRATUM_EDGE * stratum;
        uint width = (view.light_width + STRATUM_EDGE - 1u) / STRATUM_EDGE;
        StratumTexel chosen = Strata(view.strata).entries[stratum.y * width + stratum.x];
        is_again = chosen.chosen == place.y * STRATUM_EDGE + place.x;
        if (is_again) {
            return own_numbers(view, chosen.before, view.first_sample_before);
        }
    }
    return own_numbers(view, index, view.first_sample);
}

// Samples of a texel: some more where little is known of it, as many as there are to spare for so many.
uint samples_of(ViewRecord view, uint index, bool is_again) {
    if (view.spare_samples == 0u || view.guides == 0ul || is_again || (Guides(view.guides).entries[index].bits & NEEDY_BIT) == 0u) {
        return view.samples;
    }
    uint needy = max(Counters(view.counters).entries[0].needy, 1u);
    // What is left over goes to some of them, by chance.
    uint share = view.spare_samples / needy;
    bool has_one_more = hash(index ^ hash(view.frame_number)) % needy < view.spare_samples % needy;
    return view.samples + min(share + (has_one_more ? 1u : 0u), view.most_spare_samples);
}

// Without a denoiser: samples of frames that do not change add up.
void keep_exactly(ViewRecord view, uint index, LightTexel light) {
    if (view.accumulated != 0u) {
        LightTexel before = LightTexels(view.light).entries[index];
        float share = float(view.samples) / float(view.accumulated + view.samples);
        light.direct = mix(before.direct, light.direct, share);
        light.indirect = mix(before.indirect, light.indirect, share);
        light.specular = mix(before.specular, light.specular, share);
        light.towards = mix(before.towards, light.towards, share);
    }
    LightTexels(view.light).entries[index] = light;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 texel = invocation();
    if (any(greaterThanEqual(texel, light_size(view)))) {
        return;
    }
    uint index = light_index(view, ivec2(texel));
    uvec2 pixel = pixel_of_light(view, texel);
    SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[pixel.y * view.width + pixel.x];
    Found found = Found(LightTexel(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)), 0.0);
    bool is_again = false;
    if (surface_kind(surface) != SURFACE_NONE) {
        Random numbers = texel_numbers(view, texel, index, is_again);
        found = found_light(view, surface, pixel, numbers, samples_of(view, index, is_again));
    }
    LightTexel light = found.light;
    if (view.light != 0ul) {
        keep_exactly(view, index, light);
        return;
    }
    Lit noisy = Lit(vec4(light.direct, 0.0), vec4(light.specular, 0.0), vec4(light.indirect, 0.0), vec4(light.towards, found.reflected));
    write_lit(view, view.noisy, index, noisy, 0.5);
    if (view.luminances != 0ul) {
        vec3 brightness = luminances(noisy);
        Luminances(view.luminances).entries[index].word = pack_luminances(brightness, is_again);
    }
}
