// Light that is a number. The twin of core/sampling/src/finite.rs.

#ifndef AFTERGLOW_PATHTRACE_FINITE_GLSL
#define AFTERGLOW_PATHTRACE_FINITE_GLSL

// Most that a channel of radiance may be, so that sums of squares of 2^30 samples stay finite.
#define LARGEST_RADIANCE 1e15

struct FiniteRadiance {
    vec3 value;
    bool was_finite; // else the value is 0
    bool was_capped;
};

// By its bits: compilers may take it for granted that nothing is infinite or not a number.
bool is_finite(float value) {
    return (floatBitsToUint(value) & 0x7f800000u) != 0x7f800000u;
}

// Radiance that can be added up: black where a channel is not finite, else each at most `LARGEST_RADIANCE`.
FiniteRadiance finite_radiance(vec3 radiance) {
    if (!(is_finite(radiance.x) && is_finite(radiance.y) && is_finite(radiance.z))) {
        return FiniteRadiance(vec3(0.0), false, false);
    }
    vec3 capped = clamp(radiance, -LARGEST_RADIANCE, LARGEST_RADIANCE);
    return FiniteRadiance(capped, true, capped != radiance);
}

#endif
