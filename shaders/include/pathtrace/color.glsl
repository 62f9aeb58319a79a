// Between linear light and the 8-bit picture (IEC 61966-2-1).

#ifndef AFTERGLOW_PATHTRACE_COLOR_GLSL
#define AFTERGLOW_PATHTRACE_COLOR_GLSL

vec3 linear_from_srgb(vec3 srgb) {
    vec3 power = pow((max(srgb, 0.0) + 0.055) / 1.055, vec3(2.4));
    return mix(power, srgb / 12.92, lessThanEqual(srgb, vec3(0.04045)));
}

vec3 srgb_from_linear(vec3 linear) {
    vec3 power = 1.055 * pow(max(linear, 0.0), vec3(1.0 / 2.4)) - 0.055;
    return mix(power, linear * 12.92, lessThanEqual(linear, vec3(0.0031308)));
}

// Luminance of linear light (Rec. 709).
float luminance(vec3 linear) {
    return dot(linear, vec3(0.2126, 0.7152, 0.0722));
}

#endif
