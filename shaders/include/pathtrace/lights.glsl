// Light sources as places see them, without what stands between.

#ifndef AFTERGLOW_PATHTRACE_LIGHTS_GLSL
#define AFTERGLOW_PATHTRACE_LIGHTS_GLSL

#include "../fixed/lighting.glsl"
#include "../ray.glsl"
#include "color.glsl"
#include "sampling.glsl"
#include "tables.glsl"

// Beyond the farthest coordinates that structures hold, 1e11.
#define LONGEST_RAY 1e13
#define PI 3.14159265358979

// A point of a light as a place sees it.
struct LightSample {
    vec3 direction; // unit vector to it
    float reach;    // how far a ray goes until it is there
    vec3 brought;   // its radiance over the density by solid angle with which it was chosen
    float density;  // that density, where rays can meet the light; else 0
};

LightSource light_source(ViewRecord view, uint light) {
    return LightSourceTable(view.lights).entries[light];
}

// How much of an OpenGL light's colour reaches a place so far from it, by falloff and spot (OpenGL 1.5, section 2.14.1).
float program_strength(LightSource light, vec3 direction, float away) {
    float strength = 1.0 / max(dot(light.attenuation, vec3(1.0, away, away * away)), 1e-6);
    if (light.spot_cos_cutoff > -1.0) {
        float along = dot(-direction, light.spot_axis);
        strength *= along < light.spot_cos_cutoff ? 0.0 : power(along, light.spot_exponent);
    }
    return strength;
}

LightSample no_light() {
    return LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0);
}

// A disc infinitely far. Its irradiance is pi times its colour, whatever its size.
LightSample far_sample(LightSource light, vec2 random) {
    float sin2 = light.radius * light.radius;
    vec3 brought = PI * light.color;
    if (sin2 == 0.0) {
        return LightSample(light.position, LONGEST_RAY, brought, 0.0);
    }
    // Radiance colour / sin2, over all of the cap.
    brought *= 2.0 * cap_one_minus_cos(sin2) / sin2;
    return LightSample(cap_direction(light.position, sin2, random), LONGEST_RAY, brought, 1.0 / cap_solid_angle(sin2));
}

// A light as OpenGL has it: as bright as from its middle, its shadow as soft as a disc's.
LightSample point_sample(LightSource light, vec3 start, vec2 random) {
    vec3 to_center = light.position - start;
    float away = length(to_center);
    vec3 direction = unit_vector(to_center);
    float strength = program_strength(light, direction, away);
    vec3 to_point = to_center + tangents(direction) * (disc_point(random) * light.radius);
    // What holds the light, a lamp or a flame, must not hide it.
    float reach = max(length(to_point) - 1.5 * light.radius, 0.0);
    return LightSample(unit_vector(to_point), reach, PI * strength * light.color, 0.0);
}

// From a start to a point that lies on a light whose surface faces `normal` there: not all of the way, so that the light
// does not hide itself.
void go_to(vec3 start, vec3 point, vec3 normal, inout LightSample result) {
    vec3 way = offset_ray(point, normal) - start;
    result.reach = length(way);
    result.direction = unit_vector(way);
}

// The part of a sphere that a place outside of it sees, uniform by solid angle.
LightSample sphere_sample(LightSource light, vec3 start, vec2 random) {
    vec3 to_center = light.position - start;
    float away2 = dot(to_center, to_center);
    float radius2 = light.radius * light.radius;
    if (!(away2 > radius2)) {
        return no_light();
    }
    float sin2 = radius2 / away2;
    vec3 direction = cap_direction(to_center * inversesqrt(away2), sin2, random);
    float middle = dot(to_center, direction);
    vec3 aside = direction * middle - to_center;
    float depth = sqrt(max(radius2 - dot(aside, aside), 0.0));
    vec3 normal = unit_vector(aside - direction * depth);
    float solid_angle = cap_solid_angle(sin2);
    LightSample result = LightSample(direction, 0.0, light.color * solid_angle, 1.0 / solid_angle);
    go_to(start, light.position + normal * light.radius, normal, result);
    return result;
}

float sphere_density(LightSource light, vec3 start) {
    vec3 to_center = light.position - start;
    float away2 = dot(to_center, to_center);
    float radius2 = light.radius * light.radius;
    return away2 > radius2 ? 1.0 / cap_solid_angle(radius2 / away2) : 0.0;
}

// A point of a triangle, uniform by area.
LightSample triangle_sample(LightSource light, vec3 start, vec2 random) {
    vec3 normal = cross(light.edge_1, light.edge_2);
    float area_doubled = length(normal);
    if (!(area_doubled > 0.0)) {
        return no_light();
    }
    normal /= area_doubled;
    vec2 at = triangle_barycentrics(random);
    vec3 point = light.position + light.edge_1 * at.x + light.edge_2 * at.y;
    vec3 way = point - start;
    float away2 = dot(way, way);
    float facing = -dot(normal, way) * inversesqrt(away2);
    if (light.kind == LIGHT_TRIANGLE_BOTH && facing < 0.0) {
        normal = -normal;
        facing = -facing;
    }
    if (!(facing > 0.0)) {
        return no_light();
    }
    float solid_angle = 0.5 * area_doubled * facing / away2;
    LightSample result = LightSample(vec3(0.0), 0.0, light.color * solid_angle, 1.0 / solid_angle);
    go_to(start, point, normal, result);
    return result;
}

float triangle_density(LightSource light, vec3 direction, float away) {
    vec3 normal = cross(light.edge_1, light.edge_2);
    float facing = abs(dot(normal, direction));
    return facing > 0.0 ? 2.0 * away * away / facing : 0.0;
}

// A point of a light.
LightSample light_sample(LightSource light, vec3 start, vec2 random) {
    switch (light.kind) {
        case LIGHT_FAR: return far_sample(light, random);
        case LIGHT_POINT: return point_sample(light, start, random);
        case LIGHT_SPHERE: return sphere_sample(light, start, random);
        default: return triangle_sample(light, start, random);
    }
}

// The density by solid angle with which `light_sample` would have chosen what a ray along a unit vector has met so far away.
float light_density(LightSource light, vec3 start, vec3 direction, float away) {
    return light.kind == LIGHT_SPHERE ? sphere_density(light, start) : triangle_density(light, direction, away);
}

// What a far light would bring to a surface, as far as choosing among them is concerned.
float far_importance(LightSource light, vec3 normal) {
    return luminance(light.color) * clamp(dot(normal, light.position) + light.radius, 0.0, 1.0);
}

// The chance that a far light is the one that is asked; the sum over all of them is `sum`.
float far_sum(ViewRecord view, vec3 normal) {
    float sum = 0.0;
    for (uint i = 0u; i < view.far_count; ++i) {
        sum += far_importance(light_source(view, i), normal);
    }
    return sum;
}

// One of the far lights by what it would bring; `chance` is 0 if none brings anything.
uint chosen_far(ViewRecord view, vec3 normal, float random, out float chance) {
    float sum = far_sum(view, normal);
    float left = random * sum;
    uint chosen = 0u;
    float importance = 0.0;
    for (uint i = 0u; i < view.far_count; ++i) {
        float own = far_importance(light_source(view, i), normal);
        if (own > 0.0) {
            chosen = i;
            importance = own;
            if (left < own) {
                break;
            }
        }
        left -= own;
    }
    chance = sum > 0.0 ? importance / sum : 0.0;
    return chosen;
}

// Radiance of a far light where a ray along a unit vector goes.
bool sees_far(LightSource light, vec3 direction) {
    vec3 apart = direction - light.position;
    // The chord of an angle: no cosine near 1.
    return dot(apart, apart) <= 2.0 * cap_one_minus_cos(light.radius * light.radius);
}

// Irradiance over pi of a point that nothing shadows.
vec3 open_light(ViewRecord view, vec3 position, vec3 normal) {
    vec3 sum = view.sky + view.ambient;
    for (uint i = 0u; i < view.light_count; ++i) {
        LightSample to = light_sample(light_source(view, i), position, vec2(0.5));
        sum += to.brought * (max(dot(normal, to.direction), 0.0) / PI);
    }
    return sum;
}

#endif
