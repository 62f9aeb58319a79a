// Numbers in few bits.

#ifndef AFTERGLOW_PATHTRACE_PACKING_GLSL
#define AFTERGLOW_PATHTRACE_PACKING_GLSL

// The greatest half float.
#define MOST_HALF 65504.0

// Components of [0, 1] in 11, 11 and 10 bits.
uint pack_unorm11(vec3 color) {
    uvec3 steps = uvec3(clamp(color, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0) + 0.5);
    return steps.x | steps.y << 11 | steps.z << 22;
}

vec3 unpack_unorm11(uint word) {
    return vec3(word & 2047u, (word >> 11) & 2047u, word >> 22) / vec3(2047.0, 2047.0, 1023.0);
}

// Components from 0 to 65408 with nine bits each and a common exponent (Vulkan specification, "Shared exponent to RGB"). Anything
// else counts as what is nearest to it, what is no number as 0.
// `random` of [0, 1) chooses between the two next to it, so that the mean is the number itself; 0.5 is the nearest.
uint dithered_shared_exponent(vec3 color, float random) {
    color = vec3(color.x > 0.0 ? color.x : 0.0, color.y > 0.0 ? color.y : 0.0, color.z > 0.0 ? color.z : 0.0);
    color = min(color, 65408.0);
    float greatest = max(color.x, max(color.y, color.z));
    // The exponent of the greatest, by its bits; 2^-16 and less have the least.
    int exponent = max(int(floatBitsToUint(greatest) >> 23) - 127, -16) + 1;
    float unit = exp2(float(exponent - 9));
    // What is a step but for rounding stays one.
    float up = 0.01 + 0.98 * random;
    if (greatest / unit + up >= 512.0) {
        unit *= 2.0;
        exponent += 1;
    }
    uvec3 steps = uvec3(color / unit + up);
    return steps.x | steps.y << 9 | steps.z << 18 | uint(exponent + 15) << 27;
}

uint pack_shared_exponent(vec3 color) {
    return dithered_shared_exponent(color, 0.5);
}

vec3 unpack_shared_exponent(uint word) {
    float unit = uintBitsToFloat((word >> 27) + 103u << 23);
    return vec3(word & 511u, (word >> 9) & 511u, (word >> 18) & 511u) * unit;
}

#endif
