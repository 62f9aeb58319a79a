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

vec4 simple_environment(uint mode, uint base_format, vec4 previous, vec4 texel, vec4 constant) {
    vec3 color = previous.rgb;
    float alpha = previous.a;
    switch (mode) {
        case ENV_MODE_REPLACE:
            color = texel.rgb;
            alpha = texel.a;
            break;
        case ENV_MODE_DECAL:
            color = mix(previous.rgb, texel.rgb, base_format == BASE_FORMAT_RGB ? 1.0 : texel.a);
            break;
        case ENV_MODE_BLEND:
            color = mix(previous.rgb, constant.rgb, texel.rgb);
            alpha = base_format == BASE_FORMAT_INTENSITY ? mix(previous.a, constant.a, texel.a) : previous.a * texel.a;
            break;
        case ENV_MODE_ADD:
            color = previous.rgb + texel.rgb;
            alpha = base_format == BASE_FORMAT_INTENSITY ? previous.a + texel.a : previous.a * texel.a;
            break;
        default:
            color = previous.rgb * texel.rgb;
            alpha = previous.a * texel.a;
            break;
    }
    return vec4(has_color(base_format) ? color : previous.rgb,
        has_alpha(base_format) && mode != ENV_MODE_DECAL ? alpha : previous.a);
}

vec4 combine_source(uint source, vec4 texels[TEXTURE_UNITS], uint unit, vec4 previous, vec4 primary, vec4 constant) {
    switch (source) {
        case COMBINE_SOURCE_PREVIOUS: return previous;
        case COMBINE_SOURCE_TEXTURE: return texels[unit];
        case COMBINE_SOURCE_CONSTANT: return constant;
        case COMBINE_SOURCE_PRIMARY: return primary;
        case COMBINE_SOURCE_ZERO: return vec4(0.0);
        case COMBINE_SOURCE_ONE: return vec4(1.0);
        case COMBINE_SOURCE_TEXTURE0 + 1u: return texels[1];
        case COMBINE_SOURCE_TEXTURE0 + 2u: return texels[2];
        case COMBINE_SOURCE_TEXTURE0 + 3u: return texels[3];
        default: return texels[0];
    }
}

vec3 color_operand(uint operand, vec4 source) {
    switch (operand) {
        case 0u: return source.rgb;
        case 1u: return 1.0 - source.rgb;
        case 2u: return source.aaa;
        default: return vec3(1.0 - source.a);
    }
}

float alpha_operand(uint operand, vec4 source) {
    return operand == 0u ? source.a : 1.0 - source.a;
}

// The combine functions, on three components or on one in all of them.
vec3 combined(uint function, vec3 arg0, vec3 arg1, vec3 arg2) {
    switch (function) {
        case COMBINE_REPLACE: return arg0;
        case COMBINE_MODULATE: return arg0 * arg1;
        case COMBINE_ADD: return arg0 + arg1;
        case COMBINE_ADD_SIGNED: return arg0 + arg1 - 0.5;
        case COMBINE_INTERPOLATE: return arg0 * arg2 + arg1 * (1.0 - arg2);
        case COMBINE_SUBTRACT: return arg0 - arg1;
        default: return vec3(4.0 * dot(arg0 - 0.5, arg1 - 0.5));
    }
}

vec4 combine_environment(
    UnitState state, vec4 texels[TEXTURE_UNITS], uint unit, vec4 previous, vec4 primary, vec4 constant
) {
    vec3 color_args[3];
    vec3 alpha_args[3];
    [[unroll]] for (uint i = 0u; i < 3u; ++i) {
        vec4 color_source = combine_source(state.source_rgb[i], texels, unit, previous, primary, constant);
        vec4 alpha_source = combine_source(state.source_alpha[i], texels, unit, previous, primary, constant);
        color_args[i] = color_operand(state.operand_rgb[i], color_source);
        alpha_args[i] = vec3(alpha_operand(state.operand_alpha[i], alpha_source));
    }
    vec3 color = combined(state.combine_rgb, color_args[0], color_args[1], color_args[2]);
    color *= float(1u << state.scale_rgb);
    float alpha = combined(state.combine_alpha, alpha_args[0], alpha_args[1], alpha_args[2]).x;
    alpha *= float(1u << state.scale_alpha);
    return vec4(color, state.combine_rgb == COMBINE_DOT3_RGBA ? color.x : alpha);
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
