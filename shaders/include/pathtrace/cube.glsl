// Directions on the six sides of a cube about the eye, in the world's axes. Places on a side go from -1 to 1, to the right and
// down as it is seen from the eye.

#ifndef AFTERGLOW_PATHTRACE_CUBE_GLSL
#define AFTERGLOW_PATHTRACE_CUBE_GLSL

// Right, up and forward are right-handed as OpenGL's eye space is, so that front faces stay what they are.
const vec3 SIDE_RIGHT[6] = vec3[6](vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0), vec3(1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0),
    vec3(-1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0));
const vec3 SIDE_UP[6] = vec3[6](vec3(0.0, 1.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0),
    vec3(0.0, 1.0, 0.0), vec3(0.0, 1.0, 0.0));
const vec3 SIDE_FORWARD[6] = vec3[6](vec3(1.0, 0.0, 0.0), vec3(-1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, -1.0, 0.0),
    vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0));

// A point about the eye in the clip space of a side. Nothing is too near or too far: depth is the same everywhere.
vec4 side_clip(uint side, vec3 point) {
    float away = dot(SIDE_FORWARD[side], point);
    return vec4(dot(SIDE_RIGHT[side], point), dot(SIDE_UP[side], point), 0.5 * away, away);
}

// Not of unit length.
vec3 side_direction(uint side, vec2 place) {
    return SIDE_FORWARD[side] + SIDE_RIGHT[side] * place.x - SIDE_UP[side] * place.y;
}

vec2 side_place(vec3 direction, out uint side) {
    vec3 size = abs(direction);
    uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    side = 2u * axis + (direction[axis] < 0.0 ? 1u : 0u);
    return vec2(dot(SIDE_RIGHT[side], direction), -dot(SIDE_UP[side], direction)) / size[axis];
}

#endif
