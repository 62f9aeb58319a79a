// Directions and points from random numbers in [0, 1), and how chances of finding the same thing are shared.
// The twin of core/sampling/src/directions.rs, caps.rs and heuristics.rs: same names, same order of operations.

#ifndef AFTERGLOW_PATHTRACE_SAMPLING_GLSL
#define AFTERGLOW_PATHTRACE_SAMPLING_GLSL

// Two vectors that make a right-handed orthonormal basis with a unit vector (Duff and others, Building
// an Orthonormal Basis, Revisited, JCGT 2017).
mat2x3 tangents(vec3 normal) {
    float side = normal.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + normal.z);
    float b = normal.x * normal.y * a;
    return mat2x3(vec3(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x),
        vec3(b, side + normal.y * normal.y * a, -normal.y));
}

// A point of the unit disc (Shirley and Chiu's concentric map).
vec2 disc_point(vec2 random) {
    vec2 square = 2.0 * random - 1.0;
    if (square == vec2(0.0)) {
        return vec2(0.0);
    }
    const float quarter = 0.785398163397;
    bool wide = abs(square.x) > abs(square.y);
    float radius = wide ? square.x : square.y;
    float angle = wide ? quarter * (square.y / square.x) : 2.0 * quarter - quarter * (square.x / square.y);
    return radius * vec2(cos(angle), sin(angle));
}

// A direction about a unit vector, its density proportional to the cosine.
vec3 cosine_direction(vec3 normal, vec2 random) {
    vec2 disc = disc_point(random);
    return tangents(normal) * disc + normal * sqrt(max(1.0 - dot(disc, disc), 0.0));
}

// Caps. A cap of the unit sphere is all directions within an angle of its axis. It is named by the squared sine of that angle,
// which is at most a right one, since that is what a sphere light (squared radius over squared distance) and a sun
// have at hand, and since 1 - cos of a small angle has no digits left.

// 1 - cos of the angle whose squared sine is given: sin^2 / (1 + cos), which never cancels.
float cap_one_minus_cos(float sin2) {
    float bounded = clamp(sin2, 0.0, 1.0);
    return bounded / (1.0 + sqrt(1.0 - bounded));
}

// In steradians.
float cap_solid_angle(float sin2) {
    return 6.28318530718 * cap_one_minus_cos(sin2);
}

// A direction about +z, uniform in solid angle where 1 - cos of its angle to z is at most `one_minus_cos` (2: all
// directions): heights over a cap are uniform, as squared radii over a disc are (Archimedes).
vec3 cap_direction_z(float one_minus_cos, vec2 random) {
    vec2 disc = disc_point(random);
    float height = dot(disc, disc) * one_minus_cos;
    return vec3(disc * sqrt(one_minus_cos * max(2.0 - height, 0.0)), 1.0 - height);
}

// A direction about a unit vector, uniform within the angle whose squared sine is `sin2_max`; its density is 1 over
// `cap_solid_angle`.
vec3 cap_direction(vec3 axis, float sin2_max, vec2 random) {
    vec3 local = cap_direction_z(cap_one_minus_cos(sin2_max), random);
    return tangents(axis) * local.xy + axis * local.z;
}

// Any direction, with density 1 / (4 pi).
vec3 sphere_direction(vec2 random) {
    return cap_direction_z(2.0, random);
}

// Weights of the second and third corner of a point that is uniform over a triangle (Heitz, A Low-Distortion Map Between
// Triangle and Square, 2019).
vec2 triangle_barycentrics(vec2 random) {
    return random.y > random.x ? vec2(0.5 * random.x, random.y - 0.5 * random.x)
                               : vec2(random.x - 0.5 * random.y, 0.5 * random.y);
}

// Multiple importance sampling (Veach and Guibas 1995): the weight of a sample found by one technique with density `own`
// where another finds it with density `other`. Weights of the two add up to 1; 0 where neither finds it.
// Densities are not negative and at most 1e30. Below this they count as none: devices may flush them to 0.
#define LEAST_DENSITY 1.17549435e-38

float balance(float own, float other) {
    float sum = own + other;
    return sum >= LEAST_DENSITY ? own / sum : 0.0;
}

// With exponent 2; of ratios, since squares of densities overflow.
float power_heuristic(float own, float other) {
    float greater = max(own, other);
    if (greater < LEAST_DENSITY) {
        return 0.0;
    }
    float own_share = own / greater;
    float other_share = other / greater;
    return own_share * own_share / (own_share * own_share + other_share * other_share);
}

#endif
