// Texture coordinates that are computed (OpenGL 1.5, section 2.11.4).

#ifndef AFTERGLOW_FIXED_TEXGEN_GLSL
#define AFTERGLOW_FIXED_TEXGEN_GLSL

#include "state.glsl"

// What a vertex's coordinates are computed from.
struct TexGenVertex {
    vec4 position_object;
    vec4 position_eye;
    vec3 normal; // in eye space
    vec3 reflection;
    vec2 sphere;
};

// `position` is the vertex in eye space with w = 1; `normal` has the length that lighting sees.
TexGenVertex texgen_vertex(vec4 position_object, vec4 position_eye, vec3 position, vec3 normal) {
    float square = dot(position, position);
    vec3 from_eye = square > 0.0 ? position * inversesqrt(square) : vec3(0.0);
    TexGenVertex vertex;
    vertex.position_object = position_object;
    vertex.position_eye = position_eye;
    vertex.normal = normal;
    vertex.reflection = from_eye - 2.0 * normal * dot(normal, from_eye);
    vec3 half_way = vertex.reflection + vec3(0.0, 0.0, 1.0);
    float m = 2.0 * length(half_way);
    vertex.sphere = m > 0.0 ? vertex.reflection.xy / m + 0.5 : vec2(0.5);
    return vertex;
}

float texgen_coordinate(uint mode, uint coordinate, TexGenVertex vertex, vec4 object_plane, vec4 eye_plane, float given) {
    switch (mode) {
        case GEN_OBJECT_LINEAR: return dot(object_plane, vertex.position_object);
        case GEN_EYE_LINEAR: return dot(eye_plane, vertex.position_eye);
        case GEN_SPHERE: return coordinate == 0u ? vertex.sphere.x : vertex.sphere.y;
        case GEN_REFLECTION: return coordinate < 3u ? vertex.reflection[coordinate] : given;
        case GEN_NORMAL: return coordinate < 3u ? vertex.normal[coordinate] : given;
        default: return given;
    }
}

vec4 texgen(UnitState unit, TexGenUnit planes, TexGenVertex vertex, vec4 given) {
    vec4 result;
    [[unroll]] for (uint i = 0u; i < 4u; ++i) {
        result[i] = texgen_coordinate(unit.gen[i], i, vertex, planes.object[i], planes.eye[i], given[i]);
    }
    return result;
}

#endif
