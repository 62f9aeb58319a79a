// Light from all directions in two bands of real spherical harmonics. The twin of core/sampling/src/spherical_harmonics.rs.

#ifndef AFTERGLOW_PATHTRACE_SPHERICAL_HARMONICS_GLSL
#define AFTERGLOW_PATHTRACE_SPHERICAL_HARMONICS_GLSL

// Coefficients of radiance, linear RGB: Y00, then Y1-1, Y10, Y11, which go with y, z, x.
struct SphericalHarmonics {
    vec3 coefficients[4];
};

#define SH_BAND_0 0.282094791774
#define SH_BAND_1 0.488602511903

// What radiance that comes from a unit direction adds to the coefficients; samples are to be divided by their
// density in solid angle.
SphericalHarmonics project(vec3 direction, vec3 radiance) {
    return SphericalHarmonics(vec3[4](SH_BAND_0 * radiance, SH_BAND_1 * direction.y * radiance,
        SH_BAND_1 * direction.z * radiance, SH_BAND_1 * direction.x * radiance));
}

// Radiance from a unit direction, as smooth as two bands are; may be negative.
vec3 evaluate(SphericalHarmonics sh, vec3 direction) {
    vec3 linear = sh.coefficients[1] * direction.y + sh.coefficients[2] * direction.z + sh.coefficients[3] * direction.x;
    return SH_BAND_0 * sh.coefficients[0] + SH_BAND_1 * linear;
}

// Irradiance of a surface that faces along a unit vector: bands are convolved with the clamped cosine, whose
// factors are pi and 2 pi / 3 (Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001,
// equation 8). May be negative opposite to strong light.
vec3 irradiance(SphericalHarmonics sh, vec3 normal) {
    vec3 linear = sh.coefficients[1] * normal.y + sh.coefficients[2] * normal.z + sh.coefficients[3] * normal.x;
    return 3.14159265359 * SH_BAND_0 * sh.coefficients[0] + 2.09439510239 * SH_BAND_1 * linear;
}

#endif
