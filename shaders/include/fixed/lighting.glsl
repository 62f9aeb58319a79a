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

// What a light of this strength adds to a side, given the cosines between the side's normal and the directions to the
// light and half-way to the viewer.
void add_to_side(Light light, float strength, MaterialFace material, float facing, float glint, inout LitColors colors) {
    vec3 reflected = material.ambient.rgb * light.ambient.rgb + max(facing, 0.0) * material.diffuse.rgb * light.diffuse.rgb;
    colors.primary.rgb += strength * reflected;
    float shine = facing > 0.0 ? power(max(glint, 0.0), material.shininess) : 0.0;
    colors.secondary += strength * shine * material.specular.rgb * light.specular.rgb;
}

// What one light adds to both sides, of which the back's normal is the other way round. All in eye space.
void add_light(
    GlobalState state, Light light, bool positional, bool spot, MaterialFace front, MaterialFace back, vec3 position,
    vec3 normal, inout LitColors front_colors, inout LitColors back_colors
) {
    vec3 to_light = light.position.xyz;
    float strength = 1.0;
    if (state.positional != 0u && positional) {
        to_light = light.position.xyz / light.position.w - position;
        float reach = length(to_light);
        strength = 1.0 / dot(light.attenuation, vec3(1.0, reach, reach * reach));
    }
    to_light = unit_vector(to_light);
    if (state.spots != 0u && spot) {
        float along = dot(-to_light, unit_vector(light.spot_direction));
        strength *= along < light.spot_cos_cutoff ? 0.0 : power(along, light.spot_exponent);
    }
    vec3 to_viewer = state.local_viewer ? unit_vector(-position) : vec3(0.0, 0.0, 1.0);
    vec3 half_way = unit_vector(to_light + to_viewer);
    add_to_side(light, strength, front, dot(normal, to_light), dot(normal, half_way), front_colors);
    if (state.two_side) {
        add_to_side(light, strength, back, -dot(normal, to_light), -dot(normal, half_way), back_colors);
    }
}

// The colours of both sides before they are clamped; without two-sided lighting the back's are undefined.
void light_vertex(
    GlobalState state, LightsTable lights, uint index, MaterialFace front, MaterialFace back, vec3 position, vec3 normal,
    out LitColors front_colors, out LitColors back_colors
) {
    vec3 ambient = lights.entries[index].scene_ambient.rgb;
    front_colors = LitColors(vec4(front.emission.rgb + front.ambient.rgb * ambient, front.diffuse.a), vec3(0.0));
    back_colors = LitColors(vec4(back.emission.rgb + back.ambient.rgb * ambient, back.diffuse.a), vec3(0.0));
    // Not unrolled: eight lights of two sides make long code, of which drivers would have to drop most.
    for (uint left = state.lights; left != 0u; left &= left - 1u) {
        uint i = uint(findLSB(left));
        add_light(state, lights.entries[index].lights[i], (state.positional & (1u << i)) != 0u,
            (state.spots & (1u << i)) != 0u, front, back, position, normal, front_colors, back_colors);
    }
    if (!state.separate_specular) {
        front_colors = LitColors(vec4(front_colors.primary.rgb + front_colors.secondary, front.diffuse.a), vec3(0.0));
        back_colors = LitColors(vec4(back_colors.primary.rgb + back_colors.secondary, back.diffuse.a), vec3(0.0));
    }
}

#endif
