// What the program says of a surface's material (GL_AFTERGLOW_scene_hints), or what replaces it, maps read with the
// coordinates of a texture unit as they are given.

#ifndef AFTERGLOW_PATHTRACE_SAID_GLSL
#define AFTERGLOW_PATHTRACE_SAID_GLSL

#include "../bindless.glsl"
#include "color.glsl"
#include "ray_cone.glsl"
#include "vertices.glsl"

vec2 map_coordinates(ViewRecord view, DrawReference draw, uint triangle, vec3 weights) {
    uint unit = maps_unit(draw.it.maps);
    vec4 given = CurrentTable(FrameTable(view.frame).entries[0].current).entries[draw.it.current].texture[unit].coefficients;
    vec4 coordinates = attribute_at(draw, triangle, weights, SLOT_TEXTURE0 + unit, given);
    return texture_place(coordinates);
}

// Twice a triangle's area in the coordinates of its maps.
float map_area(ViewRecord view, DrawReference draw, uint triangle) {
    vec4 at[3] = corner_coordinates(view, draw, triangle, maps_unit(draw.it.maps));
    return coordinates_area(texture_place(at[0]), texture_place(at[1]), texture_place(at[2]));
}

// Texels along a map's longer side, as a power of two.
float map_size(uint map) {
    uint image = map & 0xfffffu;
    uint filtering = map >> 20;
    ivec2 size = textureSize(sampler2D(textures_2d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]), 0);
    return log2(float(max(size.x, size.y)));
}

// A map's texel where so many (as a power of two) lie along a unit of its coordinates.
vec4 map_texel(uint map, vec2 coordinates, float texels) {
    uint image = map & 0xfffffu;
    uint filtering = map >> 20;
    return textureLod(sampler2D(textures_2d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]), coordinates,
        max(map_size(map) - texels, 0.0));
}

// A normal map's texel with all of its components, from 0 to 1.
vec3 map_normal(DrawReference draw, vec2 coordinates, float texels) {
    vec3 texel = map_texel(draw.it.normal_map, coordinates, texels).rgb;
    if (maps_normal_of_two(draw.it.maps) != 0u) {
        vec2 across = texel.xy * 2.0 - 1.0;
        texel.z = 0.5 + 0.5 * sqrt(max(1.0 - dot(across, across), 0.0));
    }
    return texel;
}

// Perceptual roughness and metallic, wherever maps have them.
vec2 said_roughness_metallic(DrawReference draw, vec2 coordinates, float texels) {
    vec2 said = vec2(draw.it.roughness, draw.it.metallic);
    vec2 varied = vec2(1.0);
    if (draw.it.metallic_roughness_map != NO_MAP) {
        varied = map_texel(draw.it.metallic_roughness_map, coordinates, texels).gb;
    }
    if (maps_roughness_in_emission(draw.it.maps) != 0u) {
        varied.x = map_texel(draw.it.emission_map, coordinates, texels).a;
    }
    if (maps_metal_in_normal(draw.it.maps) != 0u) {
        varied.y = map_texel(draw.it.normal_map, coordinates, texels).a;
    }
    return said * varied;
}

// Radiance that is given off.
vec3 said_emission(ViewRecord view, DrawReference draw, uint triangle, vec3 weights, float texels) {
    vec3 emission = draw.it.emission;
    if (draw.it.emission_map != NO_MAP) {
        vec2 coordinates = map_coordinates(view, draw, triangle, weights);
        emission *= linear_from_srgb(map_texel(draw.it.emission_map, coordinates, texels).rgb);
    }
    return emission;
}

#endif
