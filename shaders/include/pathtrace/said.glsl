// What the program says of a surface's material (GL_AFTERGLOW_scene_hints), its maps read with the coordinates of
// texture unit 0 as they are given.

#ifndef AFTERGLOW_PATHTRACE_SAID_GLSL
#define AFTERGLOW_PATHTRACE_SAID_GLSL

#include "../bindless.glsl"
#include "color.glsl"
#include "vertices.glsl"

vec2 map_coordinates(ViewRecord view, DrawReference draw, uint triangle, vec3 weights) {
    vec4 given = CurrentTable(FrameTable(view.frame).entries[0].current).entries[draw.it.current].texture[0].coefficients;
    vec4 coordinates = attribute_at(draw, triangle, weights, SLOT_TEXTURE0, given);
    return coordinates.xy / coordinates.w;
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
