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

vec4 texgen(UnitState unit, TexGenUnit planes, TexGenVertex vertex, vec4 given) {
    // Planes are the columns: a vector from the left gives its product with each.
    vec4 object_linear = vertex.position_object * planes.object;
    vec4 eye_linear = vertex.position_eye * planes.eye;
    vec4 sphere = vec4(vertex.sphere, vertex.sphere);
    vec4 reflection = vec4(vertex.reflection, given.w);
    vec4 normal = vec4(vertex.normal, given.w);
    vec4 result = given;
    result = mix(result, object_linear, equal(unit.gen, uvec4(GEN_OBJECT_LINEAR)));
    result = mix(result, eye_linear, equal(unit.gen, uvec4(GEN_EYE_LINEAR)));
    result = mix(result, sphere, equal(unit.gen, uvec4(GEN_SPHERE)));
    result = mix(result, reflection, equal(unit.gen, uvec4(GEN_REFLECTION)));
    return mix(result, normal, equal(unit.gen, uvec4(GEN_NORMAL)));
}

#endif
