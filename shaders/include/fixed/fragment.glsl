// From interpolated attributes to a fragment's colour (OpenGL 1.5, sections 3.8 to 3.11).

#ifndef AFTERGLOW_FIXED_FRAGMENT_GLSL
#define AFTERGLOW_FIXED_FRAGMENT_GLSL

#include "fog.glsl"
#include "tables.glsl"
#include "texenv.glsl"
#include "texture.glsl"

// Texturing, colour sum and fog.
//
// Units that `left_out` has a bit of are passed by. `projective` has a bit for each unit whose q may not be 1, `clamps` three bits a unit (see
// clamped_coordinates); `environments` is where units look up their constant colour.
vec4 shade_fragment(
    GlobalState state, UnitState units[TEXTURE_UNITS], DrawPush push, EnvironmentTable environments, uint clamps,
    uint projective, uint left_out, vec4 primary, vec3 secondary, vec4 coordinates[TEXTURE_UNITS], float fog_coordinate
) {
    vec4 texels[TEXTURE_UNITS];
    [[unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        texels[i] = sample_unit(units[i], push.textures[i], (clamps >> (3u * i)) & 7u, coordinates[i],
            (projective & (1u << i)) != 0u);
    }
    vec4 color = primary;
    [[unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        vec4 own = apply_environment(units[i], texels, i, color, primary,
            environments.entries[push.environment].env_color[i]);
        color = chosen((left_out & (1u << i)) != 0u, color, own);
    }
    if (state.color_sum || (state.lighting && state.separate_specular)) {
        color.rgb = min(color.rgb + secondary, 1.0);
    }
    if (state.fog_mode != FOG_NONE) {
        float own = fog_factor(state.fog_mode, fog_coordinate, push.fog_density, push.fog_end, push.fog_scale);
        color.rgb = mix(push.fog_color.rgb, color.rgb, own);
    }
    return color;
}

#endif
