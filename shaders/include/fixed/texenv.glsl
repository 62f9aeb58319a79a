// Texture environments (OpenGL 1.5, section 3.8.13).
//
// Texels come expanded: alpha is (0, 0, 0, A), luminance (L, L, L, 1), intensity (I, I, I, I), RGB (R, G, B, 1).

#ifndef AFTERGLOW_FIXED_TEXENV_GLSL
#define AFTERGLOW_FIXED_TEXENV_GLSL

#include "state.glsl"

// Whether a texture of this base format has colour, and whether it has alpha.
bool has_color(uint base_format) {
    return base_format != BASE_FORMAT_ALPHA;
}
bool has_alpha(uint base_format) {
    return base_format != BASE_FORMAT_LUMINANCE && base_format != BASE_FORMAT_RGB;
}

// One of two colours, both of which are computed.
vec4 chosen(bool first_one, vec4 first, vec4 second) {
    return mix(second, first, bvec4(first_one));
}

// The modes are all computed and one is chosen: where the mode is a constant, compilers drop the others at once.
vec4 simple_environment(uint mode, uint base_format, vec4 previous, vec4 texel, vec4 constant) {
    bool intensity = base_format == BASE_FORMAT_INTENSITY;
    vec4 product = previous * texel;
    vec4 decal = vec4(mix(previous.rgb, texel.rgb, base_format == BASE_FORMAT_RGB ? 1.0 : texel.a), previous.a);
    vec4 blended = mix(previous, constant, texel);
    vec4 sum = previous + texel;
    vec4 color = product;
    color = chosen(mode == ENV_MODE_REPLACE, texel, color);
    color = chosen(mode == ENV_MODE_DECAL, decal, color);
    color = chosen(mode == ENV_MODE_BLEND, vec4(blended.rgb, intensity ? blended.a : product.a), color);
    color = chosen(mode == ENV_MODE_ADD, vec4(sum.rgb, intensity ? sum.a : product.a), color);
    return mix(previous, color, bvec4(bvec3(has_color(base_format)), has_alpha(base_format)));
}

vec3 color_operand(uint operand, vec4 source) {
    vec3 value = mix(source.rgb, source.aaa, bvec3((operand & 2u) != 0u));
    return mix(value, 1.0 - value, bvec3((operand & 1u) != 0u));
}

float alpha_operand(uint operand, vec4 source) {
    return mix(source.a, 1.0 - source.a, operand != 0u);
}

// The combine functions, on three components of colour and one of alpha; dot products are of colours.
vec4 combined(uint function, vec4 arg0, vec4 arg1, vec4 arg2) {
    vec4 value = arg0;
    value = chosen(function == COMBINE_MODULATE, arg0 * arg1, value);
    value = chosen(function == COMBINE_ADD, arg0 + arg1, value);
    value = chosen(function == COMBINE_ADD_SIGNED, arg0 + arg1 - 0.5, value);
    value = chosen(function == COMBINE_INTERPOLATE, mix(arg1, arg0, arg2), value);
    value = chosen(function == COMBINE_SUBTRACT, arg0 - arg1, value);
    return chosen(function >= COMBINE_DOT3_RGB, vec4(4.0 * dot(arg0.rgb - 0.5, arg1.rgb - 0.5)), value);
}

vec4 combine_environment(
    UnitState state, vec4 texels[TEXTURE_UNITS], uint unit, vec4 previous, vec4 primary, vec4 constant
) {
    // By COMBINE_SOURCE_ numbers.
    vec4 sources[COMBINE_SOURCE_TEXTURE0 + TEXTURE_UNITS] = vec4[](previous, texels[unit], constant, primary, vec4(0.0),
        vec4(1.0), vec4(0.0), vec4(0.0), texels[0], texels[1], texels[2], texels[3]);
    vec4 args[3];
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        args[i] = vec4(color_operand(state.operand_rgb[i], sources[state.source_rgb[i]]),
            alpha_operand(state.operand_alpha[i], sources[state.source_alpha[i]]));
    }
    vec3 color = combined(state.combine_rgb, args[0], args[1], args[2]).rgb * float(1u << state.scale_rgb);
    float alpha = combined(state.combine_alpha, args[0], args[1], args[2]).a * float(1u << state.scale_alpha);
    return vec4(color, mix(alpha, color.x, state.combine_rgb == COMBINE_DOT3_RGBA));
}

// Whether nothing that comes before a unit shows in its colour.
bool hides_previous(UnitState state) {
    return state.env_mode == ENV_MODE_REPLACE
        || (state.env_mode == ENV_MODE_COMBINE && state.combine_rgb == COMBINE_REPLACE);
}

// The colour after one unit. `texels` are those of all units.
vec4 apply_environment(
    UnitState state, vec4 texels[TEXTURE_UNITS], uint unit, vec4 previous, vec4 primary, vec4 constant
) {
    if (state.target == 0u) {
        return previous;
    }
    vec4 color = state.env_mode == ENV_MODE_COMBINE
        ? combine_environment(state, texels, unit, previous, primary, constant)
        : simple_environment(state.env_mode, effective_base_format(state), previous, texels[unit], constant);
    return clamp(color, 0.0, 1.0);
}

#endif
