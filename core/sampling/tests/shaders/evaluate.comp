// Every function that core/sampling has a twin of, one input a thread; the order of answers is that of
// tests/support/twins.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

layout(local_size_x = 64) in;

#include "pathtrace/bsdf.glsl"
#include "pathtrace/finite.glsl"
#include "pathtrace/random.glsl"
#include "pathtrace/spherical_harmonics.glsl"

struct Input {
    vec3 wo;
    float roughness;
    vec3 wi;
    float choice;
    vec3 diffuse;
    float sin2;
    vec3 specular;
    float own;
    vec3 axis;
    float other;
    vec3 radiance;
    float cos_half;
    uvec4 words;
    vec2 random;
};

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Inputs {
    Input entries[];
};

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Answers {
    uint entries[];
};

layout(push_constant, scalar) uniform Constants {
    Inputs inputs;
    Answers answers;
    uint count;
    uint width; // words of one thread's answers
};

uint next;

void put(uint value) {
    answers.entries[next++] = value;
}

void put(float value) {
    put(floatBitsToUint(value));
}

void put(vec2 value) {
    put(value.x);
    put(value.y);
}

void put(vec3 value) {
    put(value.xy);
    put(value.z);
}

void put(uvec4 value) {
    put(value.x);
    put(value.y);
    put(value.z);
    put(value.w);
}

void put_directions(Input given, float alpha) {
    mat2x3 basis = tangents(given.axis);
    put(basis[0]);
    put(basis[1]);
    put(disc_point(given.random));
    put(cosine_direction(given.axis, given.random));
    put(triangle_barycentrics(given.random));
    put(cap_one_minus_cos(given.sin2));
    put(cap_solid_angle(given.sin2));
    put(cap_direction(given.axis, given.sin2, given.random));
    put(sphere_direction(given.random));
    put(sample_visible_normal(given.wo, alpha, given.random));
}

void put_bsdf(Input given, Bsdf bsdf) {
    put(bsdf.alpha);
    put(schlick(bsdf.specular, given.cos_half));
    put(ggx_d(bsdf.alpha, given.cos_half));
    put(smith_g1(bsdf.alpha, given.cos_half));
    put(diffuse_value(bsdf, given.wi));
    put(specular_value(bsdf, given.wo, given.wi));
    put(diffuse_pdf(given.wi));
    put(specular_pdf(bsdf, given.wo, given.wi));
    put(specular_chance(bsdf, given.wo));
    put(bsdf_pdf(bsdf, given.wo, given.wi));
    BsdfSample chosen = sample_bsdf(bsdf, given.wo, given.choice, given.random);
    put(uint(chosen.is_specular));
    put(chosen.wi);
    put(chosen.pdf);
    put(chosen.weight);
}

void put_numbers(Input given) {
    put(balance(given.own, given.other));
    put(power_heuristic(given.own, given.other));
    FiniteRadiance finite = finite_radiance(given.radiance);
    put(finite.value);
    put(uint(finite.was_finite) | uint(finite.was_capped) << 1);
    put(pcg4d(given.words));
    vec4 numbers = independent(given.words.x, given.words.y, given.words.z, given.words.w);
    put(floatBitsToUint(numbers));
    put(random_2d(Random(given.words.x, given.words.y), given.words.z));
}

void put_light(Input given) {
    put(aside_of(given.axis, given.wo));
    put(irradiance_facing(given.diffuse, given.axis * given.diffuse.x, given.wo));
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= count) {
        return;
    }
    next = index * width;
    Input given = inputs.entries[index];
    Bsdf bsdf = Bsdf(given.diffuse, given.specular, alpha_of(given.roughness));
    put_directions(given, bsdf.alpha);
    put_bsdf(given, bsdf);
    put_numbers(given);
    put_light(given);
}
