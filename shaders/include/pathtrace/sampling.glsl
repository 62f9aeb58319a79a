// Directions and points from random numbers.

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

#endif
