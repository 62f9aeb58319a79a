// How much light has changed since the frame before, stratum by stratum.

#ifndef AFTERGLOW_DENOISE_GRADIENTS_GLSL
#define AFTERGLOW_DENOISE_GRADIENTS_GLSL

#include "guide.glsl"

// No texel of a stratum was there in the frame before.
#define NONE_CHOSEN 9u

uvec2 strata_size(ViewRecord view) {
    return (light_size(view) + STRATUM_EDGE - 1u) / STRATUM_EDGE;
}

uint stratum_index(ViewRecord view, ivec2 stratum) {
    return uint(stratum.y) * strata_size(view).x + uint(stratum.x);
}

// Luminance of direct, indirect and specular light in nine bits each, a common exponent of four (2^-7 to 2^8), and whether older numbers
// were used.
uint pack_luminances(vec3 luminances, bool is_again) {
    float greatest = max(luminances.x, max(luminances.y, luminances.z));
    uint exponent = uint(clamp(int(floatBitsToUint(greatest) >> 23) - 119, 0, 15));
    uvec3 steps = uvec3(min(luminances * exp2(16.0 - float(exponent)) + 0.5, 511.0));
    return steps.x | steps.y << 9 | steps.z << 18 | exponent << 27 | (is_again ? 1u << 31 : 0u);
}

vec3 unpack_luminances(uint word) {
    float unit = exp2(float((word >> 27) & 15u) - 16.0);
    return vec3(word & 511u, (word >> 9) & 511u, (word >> 18) & 511u) * unit;
}

bool was_again(uint word) {
    return word >> 31 != 0u;
}

// Changes of luminance of direct, indirect and specular light, and the greater of both luminances.
struct Gradient {
    vec3 change;
    vec3 most;
};

Gradient read_gradient(uint64_t gradients, uint index) {
    uint halves[3] = Gradients(gradients).entries[index].halves;
    vec2 a = unpackHalf2x16(halves[0]);
    vec2 b = unpackHalf2x16(halves[1]);
    vec2 c = unpackHalf2x16(halves[2]);
    return Gradient(vec3(a.x, a.y, b.x), vec3(b.y, c.x, c.y));
}

void write_gradient(uint64_t gradients, uint index, Gradient gradient) {
    Gradients(gradients).entries[index].halves = uint[3](packHalf2x16(gradient.change.xy),
        packHalf2x16(vec2(gradient.change.z, gradient.most.x)), packHalf2x16(gradient.most.yz));
}

// What of a texel's history is not believed, of direct, indirect and specular light, from 0 to 1.
vec3 disbelief(ViewRecord view, uvec2 texel) {
    // Between the strata's middles.
    vec2 at = (vec2(texel) + 0.5) / float(STRATUM_EDGE) - 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 share = at - vec2(first);
    vec3 change = vec3(0.0);
    vec3 most = vec3(0.0);
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 stratum = clamp(first + corner, ivec2(0), ivec2(strata_size(view)) - 1);
        Gradient gradient = read_gradient(view.gradients, stratum_index(view, stratum));
        vec2 nearness = mix(1.0 - share, share, vec2(corner));
        change += nearness.x * nearness.y * gradient.change;
        most += nearness.x * nearness.y * gradient.most;
    }
    vec3 ratio = abs(change) / max(most, 1e-5);
    // Small changes are what the surface's own movement makes.
    return clamp((ratio - 0.02) * vec3(1.5, 2.5, 1.5), 0.0, 1.0);
}

#endif
