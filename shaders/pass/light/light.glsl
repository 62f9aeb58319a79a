// Light that reaches each pixel's surface, by rays: one ray at a time, from one place in the code. light.comp and light.rgen
// are this pass for the two backends of trace.glsl.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "trace.glsl"
#include "pathtrace/accept.glsl"
#include "pathtrace/color.glsl"
#include "pathtrace/hit.glsl"
#include "pathtrace/lights.glsl"
#include "pathtrace/random.glsl"
#include "pathtrace/said.glsl"
#include "pathtrace/sampling.glsl"
#include "pathtrace/surface.glsl"

// Radiance that one sample brings at most: rare paths must not leave bright dots.
const float MOST_RADIANCE = 16.0;
// How dark things that touch a surface with baked light make it.
const float CONTACT_STRENGTH = 0.85;

// A surface that light is found for: the pixel's, or one that a ray has met.
struct Place {
    vec3 start;
    vec3 normal;
    vec3 geometric;
    uint mask;
    // What of its light reaches the pixel; 0 where there is none to be found.
    vec3 weight;
};

// What a ray has met: its light that needs no ray, and where it can find more. Where baked light is known, that is what is
// reflected: it has come from everywhere.
vec3 met_light(ViewRecord view, Hit hit, vec3 direction, out Place place) {
    uint triangle;
    uint draw_index = member_of(view, hit.instance, hit.primitive, triangle);
    DrawReference draw = surface_draw(view, draw_index);
    vec3 weights = corner_weights(hit.barycentrics);
    vec4 positions[3] = corner_positions(draw, triangle);
    vec3 first = world_position(draw, positions[0]);
    vec3 edge_1 = world_position(draw, positions[1]) - first;
    vec3 edge_2 = world_position(draw, positions[2]) - first;
    vec3 normal = unit_vector(cross(edge_1, edge_2));
    normal = dot(normal, direction) > 0.0 ? -normal : normal;
    vec3 position = first + edge_1 * weights.y + edge_2 * weights.z;
    place.start = offset_ray(position, normal) + normal * start_distance(draw, dehomogenized(positions[0]));
    place.normal = normal;
    place.geometric = normal;
    place.mask = MASK_STATIC | MASK_MOVING;
    place.weight = vec3(0.0);
    vec3 baked;
    bool is_baked;
    vec3 color = unlit_color(view, draw_index, triangle, weights, baked, is_baked);
    vec3 emission = vec3(0.0);
    GlobalState state = global_state(draw);
    if (state.lighting) {
        vec4 followed = state.color_material_faces == 0u ? vec4(0.0) : vertex_color(view, draw, state, triangle, weights);
        MaterialFace material = point_material(view, draw, state, followed);
        emission = linear_from_srgb(color * clamp(material.emission.rgb, 0.0, 1.0));
        color *= clamp(material.diffuse.rgb, 0.0, 1.0);
    }
    color = linear_from_srgb(color);
    if (is_baked) {
        return color * baked * view.bake_scale + emission;
    }
    if (draw.it.kind != SURFACE_LIT) {
        // Full-bright surfaces among relit ones are lights already, or none.
        return emission + (is_relit(view) && draw.it.kind == SURFACE_BAKED ? vec3(0.0) : color);
    }
    emission += said_emission(view, draw, triangle, weights, RAY_TEXELS);
    place.weight = color;
    return color * view.ambient + emission;
}

// The ray that a stage of a sample sends.
struct RayPlan {
    vec3 direction;
    float reach;
    vec3 color; // of the light at its end
    vec3 specular;
    bool is_worth_it;
};

// Sums over samples. Of baked surfaces: `direct` is what recovered lights bring, `unmoved` what they would bring if nothing
// moved.
struct Sums {
    vec3 direct;
    vec3 indirect;
    vec3 specular;
    vec3 unmoved;
    // Rays that bounced and met nothing.
    float missed;
};

RayPlan plan_contact(Place place, vec2 numbers, float reach) {
    return RayPlan(cosine_direction(place.normal, numbers), reach, vec3(0.0), vec3(0.0), true);
}

RayPlan plan_bounce(Place place, vec2 numbers) {
    vec3 direction = cosine_direction(place.normal, numbers);
    return RayPlan(direction, LONGEST_RAY, vec3(0.0), vec3(0.0), dot(place.geometric, direction) > 0.0);
}

RayPlan plan_shadow(ViewRecord view, Place place, uint light, float inverse_chance, vec2 numbers) {
    RayPlan plan = RayPlan(place.normal, 0.0, vec3(0.0), vec3(0.0), false);
    if (light < view.light_count) {
        LightSource source = LightSourceTable(view.lights).entries[light];
        float strength = inverse_chance * light_towards(source, place.start, numbers, plan.direction, plan.reach);
        plan.color = strength * source.color;
        plan.specular = strength * source.specular;
        plan.is_worth_it = dot(place.normal, plan.direction) > 0.0 && plan.color != vec3(0.0);
    }
    return plan;
}

// One light of all, chosen by what it would bring.
RayPlan plan_any_shadow(ViewRecord view, Place place, float number, vec2 numbers) {
    float inverse_chance;
    uint light = chosen_light(view, place.start, place.normal, number, inverse_chance);
    return plan_shadow(view, place, light, inverse_chance, numbers);
}

// Lights up to which a sample asks each; where there are more, that many rays go to chosen ones.
const uint MOST_ASKED = 4u;

// The shadow ray of a stage in which lights are asked. One `number` chooses for all of them (systematic resampling), so that
// what brings a share of all light has its share of the rays.
RayPlan plan_direct(ViewRecord view, Place place, uint stage, float number, vec2 numbers) {
    if (view.light_count <= MOST_ASKED) {
        return plan_shadow(view, place, stage, 1.0, numbers);
    }
    float inverse_chance;
    float own = (float(stage) + number) / float(MOST_ASKED);
    uint light = chosen_light(view, place.start, place.normal, own, inverse_chance);
    return plan_shadow(view, place, light, inverse_chance / float(MOST_ASKED), numbers);
}

// Samples of a pixel. Of surfaces that lights reach, a sample is a shadow ray to each light, one ray that
// bounces, and a shadow ray from where that ends. Among baked surfaces it is one ray; where the lights are known that were
// baked, one of them as well: first what stands still is asked whether it hides it, then what moves.
Sums gather(ViewRecord view, SurfaceTexel surface, Place seen, uint random_pixel) {
    Sums sums = Sums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
    uint kind = surface_kind(surface);
    bool in_contact = kind == SURFACE_BAKED;
    vec3 to_viewer = unit_vector(-surface.start);
    vec3 specular_color = unpack_color(surface.specular);
    float shininess = unpack_fourth(surface.specular) * 128.0;
    bool is_mover = kind == SURFACE_BAKED_MOVER;
    uint bounce = in_contact || is_mover ? 0u : min(view.light_count, MOST_ASKED);
    bool is_one_ray = (in_contact || is_mover) && view.light_count == 0u;
    uint stages = is_one_ray ? 1u : in_contact ? 3u : bounce + 2u;
    RayPlan asked = RayPlan(seen.normal, 0.0, vec3(0.0), vec3(0.0), false);
    Random random = Random(random_pixel, view.accumulated);
    Place place = seen;
    uint stage = 0u;
    [[dont_unroll]] for (uint i = view.samples * stages; i != 0u; --i) {
        vec2 numbers = random_2d(random, stage);
        RayPlan plan;
        uint mask = place.mask;
        if (in_contact && stage == 0u) {
            plan = plan_contact(place, numbers, view.contact_reach);
        } else if (in_contact && stage == 2u) {
            plan = asked;
        } else if (in_contact) {
            plan = plan_any_shadow(view, place, random_2d(random, 3u).x, numbers);
            mask = MASK_STATIC;
        } else if (stage == bounce) {
            plan = plan_bounce(place, numbers);
        } else {
            if (stage < bounce) {
                plan = plan_direct(view, place, stage, random_2d(random, MOST_ASKED + 2u).x, numbers);
            } else if (place.weight != vec3(0.0)) {
                plan = plan_any_shadow(view, place, random_2d(random, stage + 1u).x, numbers);
            } else {
                plan = RayPlan(place.normal, 0.0, vec3(0.0), vec3(0.0), false);
            }
        }
        Hit hit;
        bool met = false;
        if (plan.is_worth_it) {
            met = trace(view.world, place.start, plan.direction, plan.reach, mask, stage != bounce, hit);
        }
        if (stage == bounce) {
            if (in_contact) {
                sums.indirect += met ? 1.0 - CONTACT_STRENGTH * (1.0 - hit.t / plan.reach) : 1.0;
            } else if (met) {
                sums.indirect += min(met_light(view, hit, plan.direction, place), MOST_RADIANCE);
            } else {
                sums.missed += plan.is_worth_it ? 1.0 : 0.0;
                place.weight = vec3(0.0);
            }
            if (is_mover) {
                place = seen;
                place.weight = vec3(1.0);
            }
        } else if (plan.is_worth_it && !met) {
            vec3 brought = plan.color * dot(place.normal, plan.direction);
            if (in_contact && stage == 1u) {
                sums.unmoved += min(brought, MOST_RADIANCE);
                asked = plan;
            } else if (in_contact || is_mover) {
                sums.direct += min(brought, MOST_RADIANCE);
            } else if (stage < bounce) {
                sums.direct += brought;
                float glint = max(dot(place.normal, unit_vector(plan.direction + to_viewer)), 0.0);
                sums.specular += plan.specular * linear_from_srgb(specular_color * power(glint, shininess));
            } else {
                sums.indirect += min(place.weight * brought, MOST_RADIANCE);
            }
        }
        if (++stage == stages) {
            stage = 0u;
            ++random.sample_index;
            place = seen;
            asked.is_worth_it = false;
        }
    }
    return sums;
}

// How much of a baked surface's light is left where moving things take some of it away. The bake adds up as the
// program stored it, which is not linear light.
vec3 light_left(ViewRecord view, Sums sums) {
    float samples = float(view.samples);
    vec3 contact = sums.indirect / samples;
    if (view.light_count == 0u) {
        return contact;
    }
    vec3 diffuse = max(view.ambient + view.sky, 1e-3);
    vec3 left = (diffuse * contact + sums.direct / samples) / (diffuse + sums.unmoved / samples);
    return pow(clamp(left, 0.0, 1.0), vec3(2.2));
}

// The mean of a pixel's samples, as composition takes it.
LightTexel found_light(ViewRecord view, SurfaceTexel surface, uint index) {
    uint kind = surface_kind(surface);
    if (kind == SURFACE_BAKED && view.has_movers == 0u) {
        return LightTexel(vec3(0.0), vec3(1.0), vec3(0.0));
    }
    Place seen;
    seen.start = surface.start;
    seen.normal = unpack_unit_vector(surface.normal);
    seen.geometric = unpack_unit_vector(surface.geometric);
    seen.mask = surface_ray_mask(surface);
    seen.weight = vec3(0.0);
    Sums sums = gather(view, surface, seen, hash(index + hash(view.seed)));
    if (kind == SURFACE_BAKED) {
        return LightTexel(vec3(0.0), light_left(view, sums), vec3(0.0));
    }
    // What is baked has its constant part everywhere; elsewhere it comes from where nothing is.
    bool is_replaced = kind == SURFACE_LIT && is_relit(view);
    vec3 open = is_replaced ? view.sky : view.sky + view.ambient;
    if (is_replaced) {
        sums.indirect = sums.indirect * view.bounce + float(view.samples) * view.ambient;
    }
    if (kind == SURFACE_BAKED_MOVER) {
        // Where nothing was met there may be walls that were not drawn: it is no darker there than elsewhere.
        open = max(open, sums.indirect / max(float(view.samples) - sums.missed, 1.0));
    }
    sums.indirect += sums.missed * open;
    if (kind == SURFACE_BAKED_MOVER) {
        // Few samples and many lights: it is smoothed with the rest.
        sums.indirect += sums.direct;
        sums.direct = vec3(0.0);
    }
    vec3 scale = vec3(1.0 / float(view.samples));
    vec3 light_scale = scale;
    if (kind == SURFACE_CATCHER) {
        light_scale /= max(open_light(view, seen.start, seen.normal), 1e-3);
    }
    return LightTexel(sums.direct * light_scale, sums.indirect * light_scale, sums.specular * scale);
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = invocation();
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    uint index = pixel.y * view.width + pixel.x;
    SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[index];
    LightTexel light = LightTexel(vec3(0.0), vec3(0.0), vec3(0.0));
    if (surface_kind(surface) != SURFACE_NONE) {
        light = found_light(view, surface, index);
        if (view.accumulated != 0u) {
            LightTexel before = LightTexels(view.light).entries[index];
            float share = float(view.samples) / float(view.accumulated + view.samples);
            light.direct = mix(before.direct, light.direct, share);
            light.indirect = mix(before.indirect, light.indirect, share);
            light.specular = mix(before.specular, light.specular, share);
        }
    }
    LightTexels(view.light).entries[index] = light;
    // Kinds that must not be mixed are told apart by the sign of the depth.
    uint kind = surface_kind(surface);
    float depth = max(dot(view.forward, surface.start), 1e-20);
    bool is_second = kind == SURFACE_CATCHER || kind == SURFACE_BAKED;
    ColorTexels(push.target).entries[index] = vec4(light.indirect, kind == SURFACE_NONE ? 0.0 : is_second ? -depth : depth);
}
