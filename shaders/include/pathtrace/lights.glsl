// Light sources as points of surfaces see them, without what stands between.

#ifndef AFTERGLOW_PATHTRACE_LIGHTS_GLSL
#define AFTERGLOW_PATHTRACE_LIGHTS_GLSL

#include "../fixed/lighting.glsl"
#include "color.glsl"
#include "sampling.glsl"
#include "tables.glsl"

#define LONGEST_RAY 1e9

// How much of a light's colour reaches a place, by falloff and spot as OpenGL has them (OpenGL 1.5, section
// 2.14.1); the unit vector to a point of the light, and how far that is. `random` chooses the point; 0.5 is the
// middle.
float light_towards(LightSource light, vec3 position, vec2 random, out vec3 direction, out float reach) {
    vec2 disc = disc_point(random) * light.radius;
    if (light.has_place == 0u) {
        direction = normalize(light.position + tangents(light.position) * disc);
        reach = LONGEST_RAY;
        return 1.0;
    }
    vec3 to_center = light.position - position;
    float away = length(to_center);
    direction = unit_vector(to_center);
    float strength = 1.0 / max(dot(light.attenuation, vec3(1.0, away, away * away)), 1e-6);
    if (light.spot_cos_cutoff > -1.0) {
        float along = dot(-direction, light.spot_axis);
        strength *= along < light.spot_cos_cutoff ? 0.0 : power(along, light.spot_exponent);
    }
    vec3 to_point = to_center + tangents(direction) * disc;
    reach = length(to_point);
    direction = unit_vector(to_point);
    // What holds the light, a lamp or a flame, must not hide it.
    reach = max(reach - 1.5 * light.radius, 0.0);
    return strength;
}

// A light with a chance proportional to what it would bring unshadowed; `random` in [0, 1).
uint chosen_light(ViewRecord view, vec3 position, vec3 normal, float random, out float inverse_chance) {
    float sum = 0.0;
    float chosen_brings = 0.0;
    uint chosen = view.light_count;
    for (uint i = 0u; i < view.light_count; ++i) {
        vec3 direction;
        float reach;
        LightSource light = LightSourceTable(view.lights).entries[i];
        float strength = light_towards(light, position, vec2(0.5), direction, reach);
        float brings = strength * luminance(light.color) * max(dot(normal, direction), 0.0);
        sum += brings;
        // Reservoir sampling with one number, stretched again after each choice.
        float chance = sum > 0.0 ? brings / sum : 0.0;
        if (random < chance) {
            chosen = i;
            chosen_brings = brings;
            random /= chance;
        } else {
            random = (random - chance) / max(1.0 - chance, 1e-6);
        }
    }
    inverse_chance = chosen_brings > 0.0 ? sum / chosen_brings : 0.0;
    return chosen;
}

// Irradiance over pi of a point that nothing shadows.
vec3 open_light(ViewRecord view, vec3 position, vec3 normal) {
    vec3 sum = view.sky + view.ambient;
    for (uint i = 0u; i < view.light_count; ++i) {
        vec3 direction;
        float reach;
        LightSource light = LightSourceTable(view.lights).entries[i];
        float strength = light_towards(light, position, vec2(0.5), direction, reach);
        sum += strength * light.color * max(dot(normal, direction), 0.0);
    }
    return sum;
}

#endif
