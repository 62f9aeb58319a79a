// Light of a texel on its way through a denoiser.

#ifndef AFTERGLOW_DENOISE_CHANNELS_GLSL
#define AFTERGLOW_DENOISE_CHANNELS_GLSL

#include "../pathtrace/color.glsl"
#include "../pathtrace/packing.glsl"
#include "../pathtrace/tables.glsl"

// As ChannelTexel, in two parts that are read at once.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer ChannelTexels { uvec4 halves[]; };

// Colours, and the standard deviation of their luminance; the second band, and how far the specular lobe's ray went.
struct Lit {
    vec4 direct;
    vec4 specular;
    vec4 indirect;
    vec4 towards;
};

Lit no_light_there() {
    return Lit(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
}

vec4 four_halves(uvec2 words) {
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

uvec2 pack_four_halves(vec4 value) {
    return uvec2(packHalf2x16(value.xy), packHalf2x16(value.zw));
}

Lit read_lit(uint64_t channels, uint index) {
    uvec4 first = ChannelTexels(channels).halves[2u * index];
    uvec4 second = ChannelTexels(channels).halves[2u * index + 1u];
    return Lit(four_halves(first.xy), four_halves(first.zw), four_halves(second.xy), four_halves(second.zw));
}

// `random` of [0, 1) rounds: see dithered_half.
void write_lit(uint64_t channels, uint index, Lit light, float random) {
    ChannelTexels(channels).halves[2u * index] = uvec4(pack_four_halves(dithered_half(light.direct, random)),
        pack_four_halves(dithered_half(light.specular, random)));
    ChannelTexels(channels).halves[2u * index + 1u] = uvec4(pack_four_halves(dithered_half(light.indirect, random)),
        pack_four_halves(dithered_half(light.towards, random)));
}

void add_lit(inout Lit sum, Lit light, vec3 weights) {
    sum.direct += weights.x * light.direct;
    sum.indirect += weights.y * light.indirect;
    sum.towards.xyz += weights.y * light.towards.xyz;
    sum.specular += weights.z * light.specular;
    sum.towards.w += weights.z * light.towards.w;
}

void divide_lit(inout Lit sum, vec3 weights) {
    sum.direct /= weights.x;
    sum.indirect /= weights.y;
    sum.towards.xyz /= weights.y;
    sum.specular /= weights.z;
    sum.towards.w /= weights.z;
}

// From one to the other by a share of each channel.
Lit mixed(Lit from, Lit to, vec3 share) {
    return Lit(mix(from.direct, to.direct, share.x), mix(from.specular, to.specular, share.z),
        mix(from.indirect, to.indirect, share.y), mix(from.towards, to.towards, share.yyyz));
}

// Luminance of direct, indirect and specular light: in this order wherever there are three of something.
vec3 luminances(Lit light) {
    return vec3(luminance(light.direct.rgb), luminance(light.indirect.rgb), luminance(light.specular.rgb));
}

vec3 deviations(Lit light) {
    return vec3(light.direct.w, light.indirect.w, light.specular.w);
}

void set_deviations(inout Lit light, vec3 deviations) {
    light.direct.w = deviations.x;
    light.indirect.w = deviations.y;
    light.specular.w = deviations.z;
}

#endif
