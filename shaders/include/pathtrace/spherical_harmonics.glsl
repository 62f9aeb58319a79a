// Indirect light in two bands of spherical harmonics: what a surface gets along the normal where it was gathered, and how its
// luminance grows along each axis. The twin of core/sampling/src/spherical_harmonics.rs.

#ifndef AFTERGLOW_PATHTRACE_SPHERICAL_HARMONICS_GLSL
#define AFTERGLOW_PATHTRACE_SPHERICAL_HARMONICS_GLSL

#include "color.glsl"

// Of radiance a + dot(b, w) over a hemisphere, cosine-distributed directions w have mean radiance times w of b / 4 aside of the
// normal, and irradiance over pi grows by 2/3 b along the normal.
const float TOWARDS_SCALE = 8.0 / 3.0;

// What a direction in which light was found adds to the second band, before the mean and TOWARDS_SCALE: no part along the normal,
// where the first band is exact.
vec3 aside_of(vec3 direction, vec3 normal) {
    return direction - normal * dot(normal, direction);
}

// Irradiance over pi where a surface faces along a unit vector. One band's colour is for both; how much more comes from one side
// than from the other is limited, because few samples say it loudly.
vec3 irradiance_facing(vec3 color, vec3 towards, vec3 normal) {
    float brightness = luminance(color);
    return brightness > 0.0 ? color * clamp(1.0 + dot(towards, normal) / brightness, 0.25, 4.0) : color;
}

#endif
