// Light of a texel on its way through a denoiser.

#ifndef AFTERGLOW_DENOISE_CHANNELS_GLSL
#define AFTERGLOW_DENOISE_CHANNELS_GLSL

#include "../pathtrace/color.glsl"
#include "../pathtrace/packing.glsl"
#include "../pathtrace/tables.glsl"

// As ChannelTexel, in two parts that are each read at once: colours and the second band of all texels, then deviations of all.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer ColorTexels { uvec4 words[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer DeviationTexels { uint words[]; };

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

// Where the floats begin that a byte holds: at 2^-15, with three bits behind the first.
#define BYTE_FIRST (112u << 23)
#define BYTE_SHIFT 20

// What is positive as a byte: 0, or the upper bits of a float from 2^-15 to 122880. `random` of [0, 1) rounds, 0.5 to the nearest.
uint pack_logarithm(float value, float random) {
    uint bits = max(floatBitsToUint(value), BYTE_FIRST) - BYTE_FIRST;
    bits += uint((0.01 + 0.98 * random) * float(1u << BYTE_SHIFT));
    return value > 0.0 ? clamp(bits >> BYTE_SHIFT, 1u, 255u) : 0u;
}

float unpack_logarithm(uint byte) {
    return byte == 0u ? 0.0 : uintBitsToFloat((byte << BYTE_SHIFT) + BYTE_FIRST);
}

// The second band beside the luminance of the first, of which it is four times as much at most.
const float MOST_TOWARDS = 4.0;

uint64_t deviations_of(ViewRecord view, uint64_t channels) {
    return channels + uint64_t(view.light_width * view.light_height) * 16ul;
}

vec3 unpack_deviations(uint word) {
    return vec3(unpack_logarithm(word & 255u), unpack_logarithm((word >> 8) & 255u), unpack_logarithm((word >> 16) & 255u));
}

// Deviations of a texel's direct, indirect and specular light alone.
vec3 read_deviations(ViewRecord view, uint64_t channels, uint index) {
    return unpack_deviations(DeviationTexels(deviations_of(view, channels)).words[index]);
}

// As it is stored: what is read of several texels can be asked for before any of it is there.
struct PackedLit {
    uvec4 colors;
    uint deviations;
};

PackedLit read_packed(ViewRecord view, uint64_t channels, uint index) {
    return PackedLit(ColorTexels(channels).words[index], DeviationTexels(deviations_of(view, channels)).words[index]);
}

Lit unpack_lit(PackedLit texel) {
    vec3 deviation = unpack_deviations(texel.deviations);
    Lit light;
    light.direct = vec4(unpack_shared_exponent(texel.colors.x), deviation.x);
    light.specular = vec4(unpack_shared_exponent(texel.colors.y), deviation.z);
    light.indirect = vec4(unpack_shared_exponent(texel.colors.z), deviation.y);
    float scale = MOST_TOWARDS * luminance(light.indirect.rgb);
    light.towards = vec4(unpackSnorm4x8(texel.colors.w).xyz * scale, unpack_logarithm(texel.colors.w >> 24));
    return light;
}

Lit read_lit(ViewRecord view, uint64_t channels, uint index) {
    return unpack_lit(read_packed(view, channels, index));
}

// `random` of [0, 1) rounds, so that the mean is kept: small steps of what is kept from frame to frame are not lost. 0.5 rounds to the
// nearest; what can be written exactly stays as it is.
void write_lit(ViewRecord view, uint64_t channels, uint index, Lit light, float random) {
    float scale = MOST_TOWARDS * luminance(light.indirect.rgb);
    vec3 towards = scale > 0.0 ? clamp(light.towards.xyz / scale, -1.0, 1.0) : vec3(0.0);
    uvec3 bands = uvec3(ivec3(floor(towards * 127.0 + 0.01 + 0.98 * random))) & 255u;
    ColorTexels(channels).words[index] = uvec4(dithered_shared_exponent(light.direct.rgb, random),
        dithered_shared_exponent(light.specular.rgb, random), dithered_shared_exponent(light.indirect.rgb, random),
        bands.x | bands.y << 8 | bands.z << 16 | pack_logarithm(light.towards.w, 0.5) << 24);
    DeviationTexels(deviations_of(view, channels)).words[index] = pack_logarithm(light.direct.w, random)
        | pack_logarithm(light.indirect.w, random) << 8 | pack_logarithm(light.specular.w, random) << 16;
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
