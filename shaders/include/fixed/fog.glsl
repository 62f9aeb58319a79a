// Fog (OpenGL 1.5, section 3.10).

#ifndef AFTERGLOW_FIXED_FOG_GLSL
#define AFTERGLOW_FIXED_FOG_GLSL

#include "state.glsl"

// How much of the fragment's own colour remains. `scale` is 1 / (end - start).
float fog_factor(uint mode, float coordinate, float density, float end, float scale) {
    float factor;
    switch (mode) {
        case FOG_LINEAR: factor = (end - coordinate) * scale; break;
        case FOG_EXP: factor = exp(-density * coordinate); break;
        default: factor = exp(-density * coordinate * density * coordinate); break;
    }
    return clamp(factor, 0.0, 1.0);
}

#endif
