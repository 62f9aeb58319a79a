// The colour that the program gives to what a ray meets, found from the same state that the draw is
// rasterized with. Texels are as wide as the ray's cone, and coordinates as they are given.

#ifndef AFTERGLOW_PATHTRACE_HIT_GLSL
#define AFTERGLOW_PATHTRACE_HIT_GLSL

#include "../bindless.glsl"
#include "../fixed/texenv.glsl"
#include "ray_cone.glsl"
#include "vertices.glsl"

// Of a list of layers no more than these are looked at.
#define MOST_LAYERS 6u
// Cones along any triangle (`cones_along`), as a power of two, so that the finest level is read.
#define FINEST_CONES 64.0

UnitState unit_state(DrawReference draw, uint unit) {
    uint first = UNIT_FIRST_WORD(unit);
    return decode_unit(uint[UNIT_WORDS](draw.it.state[first], draw.it.state[first + 1u], draw.it.state[first + 2u]));
}

// The texel of a unit that is as wide as a cone of which so many lie along the triangle (`cones_along`); white if it is
// not two-dimensional.
vec4 unit_texel(ViewRecord view, DrawReference draw, uint triangle, vec3 weights, UnitState state, uint unit, float cones) {
    if (state.target != TARGET_D2 || state.base_format == BASE_FORMAT_DEPTH) {
        return vec4(1.0);
    }
    vec4 at[3] = corner_coordinates(view, draw, triangle, unit);
    vec4 coordinates = at[0] * weights.x + at[1] * weights.y + at[2] * weights.z;
    float texels = cone_texels(cones, coordinates_area(texture_place(at[0]), texture_place(at[1]), texture_place(at[2])));
    uint image = draw.it.textures[unit] & 0xfffffu;
    uint filtering = draw.it.textures[unit] >> 20;
    ivec2 size = textureSize(sampler2D(textures_2d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]), 0);
    float level = max(log2(float(max(size.x, size.y))) - texels, 0.0);
    return textureLod(sampler2D(textures_2d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]),
        texture_place(coordinates), level);
}

// The colour after texturing of `primary`, in sRGB as the program has it. A unit whose texture is baked light is passed
// by, its texel is `light`.
vec4 textured_color(ViewRecord view, DrawReference draw, uint triangle, vec3 weights, float cones, vec4 primary,
    inout vec3 light) {
    vec4 texels[TEXTURE_UNITS] = vec4[TEXTURE_UNITS](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    EnvironmentTable environments = EnvironmentTable(FrameTable(view.frame).entries[0].environments);
    vec4 color = primary;
    // The first pass reads texels: an environment may use those of later units.
    [[dont_unroll]] for (uint i = 0u; i < 2u * TEXTURE_UNITS; ++i) {
        uint unit = i % TEXTURE_UNITS;
        UnitState state = unit_state(draw, unit);
        if (state.target == 0u) {
            continue;
        }
        bool is_light = draw.it.bake == unit + 1u;
        if (i < TEXTURE_UNITS) {
            texels[unit] = unit_texel(view, draw, triangle, weights, state, unit, cones);
        } else if (is_light) {
            float scale = state.env_mode == ENV_MODE_COMBINE ? float(1u << state.scale_rgb) : 1.0;
            light *= texels[unit].rgb * scale;
            color = hides_previous(state) ? vec4(1.0) : color;
        } else {
            vec4 constant = environments.entries[draw.it.environment].env_color[unit];
            color = apply_environment(state, texels, unit, color, primary, constant);
        }
    }
    return color;
}

vec3 blend_factor(uint factor, vec4 source, vec4 destination) {
    vec3 value = vec3(1.0);
    switch (factor) {
        case BLEND_FACTOR_ZERO: value = vec3(0.0); break;
        case BLEND_FACTOR_SOURCE_COLOR:
        case BLEND_FACTOR_ONE_MINUS_SOURCE_COLOR: value = source.rgb; break;
        case BLEND_FACTOR_DESTINATION_COLOR:
        case BLEND_FACTOR_ONE_MINUS_DESTINATION_COLOR: value = destination.rgb; break;
        case BLEND_FACTOR_SOURCE_ALPHA:
        case BLEND_FACTOR_ONE_MINUS_SOURCE_ALPHA: value = source.aaa; break;
        case BLEND_FACTOR_DESTINATION_ALPHA:
        case BLEND_FACTOR_ONE_MINUS_DESTINATION_ALPHA: value = destination.aaa; break;
        default: break;
    }
    bool is_inverse = factor == BLEND_FACTOR_ONE_MINUS_SOURCE_COLOR || factor == BLEND_FACTOR_ONE_MINUS_DESTINATION_COLOR
        || factor == BLEND_FACTOR_ONE_MINUS_SOURCE_ALPHA || factor == BLEND_FACTOR_ONE_MINUS_DESTINATION_ALPHA;
    return is_inverse ? 1.0 - value : value;
}

// A layer over what is below it. All equations but addition are rare enough to be taken for it.
vec4 blended(uint word, vec4 source, vec4 destination) {
    if (blend_enabled(word) == 0u) {
        return source;
    }
    vec3 color = source.rgb * blend_factor(blend_source(word), source, destination)
        + destination.rgb * blend_factor(blend_destination(word), source, destination);
    return vec4(clamp(color, 0.0, 1.0), destination.a);
}

// The program's colour of a surface without lighting, all its layers together, in sRGB. Materials are not in it. Baked
// light that traced light takes the place of is not in it either, but in `light`: white where there is none.
vec3 unlit_color(ViewRecord view, uint draw, uint triangle, vec3 weights, float cones, out vec3 light, out bool has_light) {
    vec4 color = vec4(1.0);
    light = vec3(1.0);
    has_light = false;
    [[dont_unroll]] for (uint n = 0u; n < MOST_LAYERS; ++n) {
        DrawReference layer = surface_draw(view, draw);
        GlobalState state = global_state(layer);
        uint bake = layer.it.bake;
        has_light = has_light || bake != BAKE_NONE;
        vec4 primary = vec4(1.0);
        if (!state.lighting) {
            primary = clamp(vertex_color(view, layer, state, triangle, weights), 0.0, 1.0);
        }
        if (bake == BAKE_COLORS) {
            light *= primary.rgb;
            primary.rgb = vec3(1.0);
        }
        vec4 own = textured_color(view, layer, triangle, weights, cones, primary, light);
        if (bake == BAKE_LAYER || bake == BAKE_DOUBLED_LAYER) {
            light *= own.rgb * (bake == BAKE_LAYER ? 1.0 : 2.0);
        } else {
            color = n == 0u ? own : blended(layer.it.blend, own, color);
        }
        if (layer.it.next_layer == draw) {
            break;
        }
        draw = layer.it.next_layer;
    }
    return color.rgb;
}

// Whether the point of a triangle that a ray meets is there, and no hole by alpha test or blending. Only unit 0's
// texel counts, of the finest level whatever the ray stands for: many rays find the share of holes, which a threshold on the
// mean of texels does not tell.
bool is_solid(ViewRecord view, uint draw, uint triangle, vec3 weights) {
    DrawReference surface = surface_draw(view, draw);
    UnitState unit = unit_state(surface, 0u);
    if (unit.target == 0u || !has_alpha(unit.base_format)) {
        return true;
    }
    float alpha = unit_texel(view, surface, triangle, weights, unit, 0u, FINEST_CONES).a;
    uint function = global_state(surface).alpha_func;
    if (function == COMPARE_ALWAYS) {
        return alpha >= 0.5;
    }
    EnvironmentTable environments = EnvironmentTable(FrameTable(view.frame).entries[0].environments);
    return compare_passes(function, alpha, environments.entries[surface.it.environment].alpha_reference);
}

#endif
