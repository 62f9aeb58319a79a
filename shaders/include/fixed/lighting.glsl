// Light of a vertex (OpenGL 1.5, section 2.14.1).

#ifndef AFTERGLOW_FIXED_LIGHTING_GLSL
#define AFTERGLOW_FIXED_LIGHTING_GLSL

#include "state.glsl"
#include "tables.glsl"
#include "transform.glsl"

struct LitColors {
    vec4 primary;
    vec3 secondary;
};

// The material of a side (0 front, 1 back), with `color` in place of what follows the colour.
MaterialFace followed_material(GlobalState state, MaterialFace material, uint side, vec4 color) {
    if ((state.color_material_faces & (1u << side)) == 0u) {
        return material;
    }
    switch (state.color_material_mode) {
        case COLOR_MATERIAL_AMBIENT_AND_DIFFUSE:
            material.ambient = color;
            material.diffuse = color;
            break;
        case COLOR_MATERIAL_AMBIENT: material.ambient = color; break;
        case COLOR_MATERIAL_DIFFUSE: material.diffuse = color; break;
        case COLOR_MATERIAL_SPECULAR: material.specular = color; break;
        default: material.emission = color; break;
    }
    return material;
}

// x to the power of y, 1 where y is 0 (as the specification defines it, and GLSL does not).
float power(float x, float y) {
    return y == 0.0 ? 1.0 : x > 0.0 ? pow(x, y) : 0.0;
}

// A vector of length 1, or 0 where there is no direction.
vec3 unit_vector(vec3 vector) {
    float square = dot(vector, vector);
    return square > 0.0 ? vector * inversesqrt(square) : vec3(0.0);
}

// What one light adds to a side whose normal is `normal`, in eye space.
void add_light(
    GlobalState state, Light light, bool positional, bool spot, MaterialFace material, vec3 position, vec3 normal,
    inout vec3 primary, inout vec3 specular
) {
    vec3 to_light = positional ? light.position.xyz / light.position.w - position : light.position.xyz;
    float reach = length(to_light);
    to_light = unit_vector(to_light);
    float strength = 1.0;
    if (positional) {
        strength = 1.0 / dot(light.attenuation, vec3(1.0, reach, reach * reach));
    }
    if (spot) {
        float along = dot(-to_light, unit_vector(light.spot_direction));
        strength *= along < light.spot_cos_cutoff ? 0.0 : power(along, light.spot_exponent);
    }
    float facing = max(dot(normal, to_light), 0.0);
    primary += strength * (material.ambient.rgb * light.ambient.rgb + facing * material.diffuse.rgb * light.diffuse.rgb);
    if (facing > 0.0) {
        vec3 to_viewer = state.local_viewer ? unit_vector(-position) : vec3(0.0, 0.0, 1.0);
        float glint = max(dot(normal, unit_vector(to_light + to_viewer)), 0.0);
        specular += strength * power(glint, material.shininess) * material.specular.rgb * light.specular.rgb;
    }
}

// The colours of a side before they are clamped.
LitColors light_side(
    GlobalState state, LightsTable lights, uint index, MaterialFace material, vec3 position, vec3 normal
) {
    vec3 primary = material.emission.rgb + material.ambient.rgb * lights.entries[index].scene_ambient.rgb;
    vec3 specular = vec3(0.0);
    [[unroll]] for (uint i = 0u; i < LIGHTS; ++i) {
        if ((state.lights & (1u << i)) != 0u) {
            add_light(state, lights.entries[index].lights[i], (state.positional & (1u << i)) != 0u,
                (state.spots & (1u << i)) != 0u, material, position, normal, primary, specular);
        }
    }
    LitColors colors;
    colors.primary = vec4(state.separate_specular ? primary : primary + specular, material.diffuse.a);
    colors.secondary = state.separate_specular ? specular : vec3(0.0);
    return colors;
}

#endif
