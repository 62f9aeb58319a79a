// Radiance of each pixel, its mean over the pixel's square, without any bias, and what its standard error follows from.
// Rays are the camera's own. reference.comp and reference.rgen are this pass for the two backends of trace.glsl.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "trace.glsl"
#include "pathtrace/eye.glsl"
#include "pathtrace/finite.glsl"
#include "pathtrace/path.glsl"

// The dimension of where in the pixel a sample's ray goes, beyond those of all surfaces.
#define DIMENSION_PIXEL 0xffffu

// A sample: the ray of the camera, then the path from where that has ended.
struct Sample {
    Path path;
    Channels channels;
    vec3 seen; // radiance of what the camera sees itself
    bool is_on_path;
};

// The camera's ray; it starts where `own` is.
RayPlan camera_plan(ViewRecord view, uvec2 pixel, PathRandom random, inout Sample own) {
    vec2 at = vec2(pixel) + path_numbers(view, random, DIMENSION_PIXEL).xy - 0.5;
    vec3 place = pixel_place(view, at);
    own.path.at.start = looks_parallel(view) ? place : vec3(0.0);
    vec3 direction = looks_parallel(view) ? view.forward : normalize(place);
    return RayPlan(direction, LONGEST_RAY, false, true, vec3(0.0), vec3(0.0), 0.0, false);
}

void take_camera_ray(ViewRecord view, RayPlan plan, bool met, Hit hit, inout Sample own) {
    if (met) {
        RayCone cone = seen_cone(view, hit.t);
        SurfacePoint point = surface_point(view, hit, plan.direction, cone);
        own.seen = point.emission;
        own.path = path_from(point, -plan.direction, MASK_STATIC | MASK_MOVING, cone);
        own.is_on_path = true;
        return;
    }
    own.seen = sky_at(view, plan.direction, 0u);
    for (uint i = 0u; i < view.far_count; ++i) {
        LightSource light = light_source(view, i);
        own.seen += light.radius > 0.0 && sees_far(light, plan.direction) ? light.color / (light.radius * light.radius) : vec3(0.0);
    }
    own.path.is_over = true;
}

Sample new_sample(ViewRecord view) {
    SurfacePoint eye = shining_point(vec3(0.0), NO_LIGHT);
    Path path = path_from(eye, vec3(0.0), MASK_STATIC | MASK_MOVING, camera_cone(view.pixel_spread));
    path.is_over = false;
    return Sample(path, no_channels(), vec3(0.0), false);
}

// Adds a sample's radiance; one that is no number counts as black, and what squares would overflow as less.
void add_radiance(ViewRecord view, vec3 radiance, uint samples, inout RadianceTexel texel) {
    FiniteRadiance finite = finite_radiance(radiance);
    radiance = finite.value;
    if (!finite.was_finite) {
        atomicAdd(Counters(view.counters).entries[0].non_finite, 1u);
    }
    if (finite.was_capped) {
        atomicAdd(Counters(view.counters).entries[0].limited, 1u);
    }
    vec3 apart = radiance - texel.mean;
    texel.mean += apart / float(samples);
    texel.squares += apart * (radiance - texel.mean);
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = invocation();
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    uint index = pixel.y * view.width + pixel.x;
    RadianceTexel texel = RadianceTexel(vec3(0.0), vec3(0.0));
    if (view.accumulated != 0u) {
        texel = RadianceTexels(view.radiance).entries[index];
    }
    PathRandom random = PathRandom(Random(index, view.accumulated), view.seed);
    Sample own = new_sample(view);
    uint end = view.accumulated + view.samples;
    uint rays = 0u;
    [[dont_unroll]] for (uint i = view.samples * (1u + most_rays(view)); i != 0u && random.random.sample_index < end; --i) {
        RayPlan plan;
        if (own.is_on_path) {
            plan = plan_ray(view, own.path, random);
        } else {
            plan = camera_plan(view, pixel, random, own);
        }
        Hit hit;
        bool met = false;
        if (plan.is_worth_it) {
            met = trace(view.world, own.path.at.start, plan.direction, plan.reach, own.path.mask, plan.is_shadow, hit);
            ++rays;
        }
        if (own.is_on_path) {
            take_ray(view, own.path, plan, met, hit, own.channels);
        } else {
            take_camera_ray(view, plan, met, hit, own);
        }
        if (own.path.is_over) {
            Channels light = own.channels;
            vec3 radiance = own.seen + light.direct + light.indirect + light.specular + light.sky;
            ++random.random.sample_index;
            add_radiance(view, radiance, random.random.sample_index, texel);
            own = new_sample(view);
        }
    }
    atomicAdd(Counters(view.counters).entries[0].rays, rays);
    RadianceTexels(view.radiance).entries[index] = texel;
}
