// What denoisers keep from frame to frame, and how it is rounded.

#ifndef AFTERGLOW_DENOISE_HISTORY_GLSL
#define AFTERGLOW_DENOISE_HISTORY_GLSL

#include "channels.glsl"
#include "guide.glsl"
#include "../pathtrace/random.glsl"

// Frames from which on a history holds what was gathered alone, and frames up to which it holds what is shown alone.
const float LONG = 12.0;
const float SHORT = 4.0;

vec3 lengths_of(GuideTexel guide) {
    return vec3(max(guide_lengths(guide), uvec3(1u)));
}

// A number of [0, 1), another for each texel, frame and use.
float rounding_number(ViewRecord view, uint index, uint use) {
    return float(hash(index ^ hash(view.frame_number + use)) >> 8) / 16777216.0;
}

// Keeps a texel's light for the next frames: what is shown of it where few have been gathered. What was gathered is not blurred
// anew in each frame.
void keep_history(ViewRecord view, uint index, Lit gathered, Lit shown, vec3 deviation, vec3 lengths) {
    Lit kept = mixed(gathered, shown, clamp((LONG - lengths) / (LONG - SHORT), 0.0, 1.0));
    set_deviations(kept, deviation);
    write_lit(view, view.history, index, kept, rounding_number(view, index, 0x51edu));
}

#endif
