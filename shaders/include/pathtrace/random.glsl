// Random numbers by pixel, sample and dimension, the same in every run: Sobol points, their order and
// digits scrambled by hashes (Burley, Practical Hash-based Owen Scrambling, JCGT 2020), or, where errors must be known,
// numbers that are independent of each other. The twin of core/sampling/src/random.rs.

#ifndef AFTERGLOW_PATHTRACE_RANDOM_GLSL
#define AFTERGLOW_PATHTRACE_RANDOM_GLSL

// Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 2020: pcg.
uint hash(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// A permutation in which a bit depends on the bits above it only.
uint owen_scramble(uint value, uint seed) {
    value = bitfieldReverse(value) + seed;
    value ^= value * 0x6c50b47cu;
    value ^= value * 0xb82f1e52u;
    value ^= value * 0xc7afe638u;
    value ^= value * 0x8d22f6e6u;
    return bitfieldReverse(value);
}

// The second coordinate of the index-th Sobol point; the first is the index with its bits reversed.
uint sobol_second(uint index) {
    uint result = 0u;
    for (uint direction = 0x80000000u; index != 0u; index >>= 1, direction ^= direction >> 1) {
        result ^= (index & 1u) != 0u ? direction : 0u;
    }
    return result;
}

struct Random {
    uint pixel; // of the pixel and the run
    uint sample_index;
};

// A point of [0, 1)^2: the sample's in a sequence of this dimension's own.
vec2 random_2d(Random random, uint dimension) {
    uint seed = hash(random.pixel + dimension * 0x9e3779b9u);
    uint index = owen_scramble(random.sample_index, seed);
    uvec2 point = uvec2(bitfieldReverse(index), sobol_second(index));
    point.x = owen_scramble(point.x, hash(seed ^ 0x55555555u));
    point.y = owen_scramble(point.y, hash(seed ^ 0xaaaaaaaau));
    return vec2(point >> 8) * (1.0 / 16777216.0);
}

// Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 2020: pcg4d.
uvec4 pcg4d(uvec4 value) {
    value = value * 1664525u + 1013904223u;
    value.x += value.y * value.w;
    value.y += value.z * value.x;
    value.z += value.x * value.y;
    value.w += value.y * value.z;
    value ^= value >> 16;
    value.x += value.y * value.w;
    value.y += value.z * value.x;
    value.z += value.x * value.y;
    value.w += value.y * value.z;
    return value;
}

// Four numbers in [0, 1), multiples of 2^-24, independent of those of any other pixel, sample, dimension or seed.
vec4 independent(uint pixel, uint sample_index, uint dimension, uint seed) {
    return vec4(pcg4d(uvec4(pixel, sample_index, dimension, seed)) >> 8) * (1.0 / 16777216.0);
}

#endif
