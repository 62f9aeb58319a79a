// Light from where rays meet nothing. Where the program draws its sky about the eye, that is found by direction, in a cube with
// coarser and coarser levels. Each side has a border of the texels next to it on other sides, so that between texels one side
// tells all, and nothing shows where sides meet.

#ifndef AFTERGLOW_PATHTRACE_SKY_GLSL
#define AFTERGLOW_PATHTRACE_SKY_GLSL

#include "cube.glsl"
#include "tables.glsl"

// Samples of a pixel that count at least when light is blurred by their number: a sky that few of them see is not all blur.
#define LEAST_SKY_SAMPLES 16.0

// The place of a texel, its border counted, among those of all levels.
uint sky_texel(uint level, uint side, uvec2 at) {
    uint edge = SKY_EDGE >> level;
    // Texels of all levels before, a side: squares of powers of two, borders.
    uint before = (SKY_EDGE * SKY_EDGE - edge * edge) / 3u * 4u + 8u * (SKY_EDGE - edge) + 4u * level;
    uint width = edge + 2u;
    return 6u * before + (side * width + at.y) * width + at.x;
}

vec3 painted_sky(uint64_t map, vec3 direction, uint level) {
    uint side;
    vec2 place = side_place(direction, side);
    float edge = float(SKY_EDGE >> level);
    vec2 at = clamp((place * 0.5 + 0.5) * edge + 0.5, vec2(0.0), vec2(edge + 0.5));
    uvec2 first = uvec2(at);
    vec2 between = at - vec2(first);
    vec3 texels[4];
    [[unroll]] for (uint i = 0u; i < 4u; ++i) {
        texels[i] = SkyTexels(map).entries[sky_texel(level, side, first + uvec2(i & 1u, i >> 1))].rgb;
    }
    return mix(mix(texels[0], texels[1], between.x), mix(texels[2], texels[3], between.x), between.y);
}

// The level whose texels are as large as the directions that a sample of this density stands for, of so many samples (Krivanek
// and Colbert, GPU-Based Importance Sampling, GPU Gems 3, chapter 20).
uint sky_level(float density, float samples) {
    float share = 1.0 / max(density * samples, 1e-10);
    float texel = 4.0 * 3.14159265 / (6.0 * float(SKY_EDGE * SKY_EDGE));
    return uint(clamp(0.5 * log2(share / texel) + 0.5, 0.0, float(SKY_LEVELS - 1u)));
}

vec3 sky_at(ViewRecord view, vec3 direction, uint level) {
    if (view.sky_map == 0ul) {
        return view.sky;
    }
    return max(painted_sky(view.sky_map, direction, level), view.sky_least) * view.sky_scale;
}

// Radiance of the sky along a ray that was sent with this density.
vec3 sky_radiance(ViewRecord view, vec3 direction, float density) {
    uint level = 0u;
    if ((view.traits & TRACE_UNLIMITED) == 0u) {
        level = sky_level(density, max(float(view.samples), LEAST_SKY_SAMPLES));
    }
    return sky_at(view, direction, level);
}

#endif
