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
uint pack_shared_exponent(vec3 color) {
    color = vec3(color.x > 0.0 ? color.x : 0.0, color.y > 0.0 ? color.y : 0.0, color.z > 0.0 ? color.z : 0.0);
    color = min(color, 65408.0);
    float greatest = max(color.x, max(color.y, color.z));
    // The exponent of the greatest, by its bits; 2^-16 and less have the least.
    int exponent = max(int(floatBitsToUint(greatest) >> 23) - 127, -16) + 1;
    float unit = exp2(float(exponent - 9));
    if (floor(greatest / unit + 0.5) == 512.0) {
        unit *= 2.0;
        exponent += 1;
    }
    uvec3 steps = uvec3(color / unit + 0.5);
    return steps.x | steps.y << 9 | steps.z << 18 | uint(exponent + 15) << 27;
}

vec3 unpack_shared_exponent(uint word) {
    float unit = exp2(float(int(word >> 27) - 24));
    return vec3(word & 511u, (word >> 9) & 511u, (word >> 18) & 511u) * unit;
}

// One of the two half floats around a number, so that the mean over `random` of [0, 1) is the number itself: small steps of what is
// kept from frame to frame are not lost. At 0.5 it is the nearest one. What is a half float but for rounding stays as it is, which
// packHalf2x16 alone does not promise.
vec4 dithered_half(vec4 value, float random) {
    // Half floats have ten bits behind the first one; what is below 2^-14 has as many as that.
    uvec4 bits = floatBitsToUint(max(abs(value), vec4(6.1035e-5)));
    vec4 step_size = uintBitsToFloat((bits & 0x7f800000u) - (10u << 23));
    return clamp(floor(value / step_size + 0.01 + 0.98 * random) * step_size, -MOST_HALF, MOST_HALF);
}

#endif
