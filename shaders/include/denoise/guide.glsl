// What denoisers go by: where a texel of light lies, which way it faces, and what must not be mixed with it.

#ifndef AFTERGLOW_DENOISE_GUIDE_GLSL
#define AFTERGLOW_DENOISE_GUIDE_GLSL

#include "../pathtrace/eye.glsl"
#include "../pathtrace/surface.glsl"

// The greatest length of a history.
#define MOST_LENGTH 63u
#define LENGTH_BITS 0x3ffffu

uvec2 light_size(ViewRecord view) {
    return uvec2(view.light_width, view.light_height);
}

uint light_index(ViewRecord view, ivec2 texel) {
    return uint(texel.y) * view.light_width + uint(texel.x);
}

bool is_in_light(ViewRecord view, ivec2 texel) {
    return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(light_size(view))));
}

// The pixel whose surface a texel of light is traced for.
uvec2 pixel_of_light(ViewRecord view, uvec2 texel) {
    return min(uvec2((vec2(texel) + 0.5) * view.light_step), view_size(view) - 1u);
}

// The texel of light that is traced for a pixel, along one side; the pixel's own number of texels if there is none.
uint texel_along(uint pixel, float step_size, uint texels, uint pixels) {
    uint near = uint((float(pixel) + 0.5) / step_size);
    // Rounding may choose the one before or after.
    for (uint texel = max(near, 1u) - 1u; texel <= near + 1u && texel < texels; ++texel) {
        if (min(uint((float(texel) + 0.5) * step_size), pixels - 1u) == pixel) {
            return texel;
        }
    }
    return texels;
}

// Surfaces of one class have light of the same meaning.
uint guide_class(uint kind) {
    return kind == SURFACE_LIT ? 1u : kind == SURFACE_BAKED_MOVER ? 2u : 3u;
}

GuideTexel new_guide(float depth, uint normal, uint kind, float roughness, uint object) {
    // Of what moves the numbers are 1 to 127.
    uint mover = object == 0u ? 0u : 1u + object % 127u;
    uint rough = uint(clamp(roughness, 0.0, 1.0) * 15.0 + 0.5);
    return GuideTexel(depth, normal, guide_class(kind) << 18 | rough << 20 | mover << 24);
}

uvec3 guide_lengths(GuideTexel guide) {
    return uvec3(guide.bits, guide.bits >> 6, guide.bits >> 12) & MOST_LENGTH;
}

uint with_lengths(uint bits, uvec3 lengths) {
    lengths = min(lengths, uvec3(MOST_LENGTH));
    return (bits & ~LENGTH_BITS) | lengths.x | lengths.y << 6 | lengths.z << 12;
}

float guide_roughness(GuideTexel guide) {
    return float((guide.bits >> 20) & 15u) / 15.0;
}

uint class_of(GuideTexel guide) {
    return (guide.bits >> 18) & 3u;
}

// Whether a texel may have more samples, because little is known of its light.
#define NEEDY_BIT (1u << 31)

bool is_same_class(GuideTexel a, GuideTexel b) {
    return class_of(a) == class_of(b);
}

bool is_same_object(GuideTexel a, GuideTexel b) {
    return ((a.bits ^ b.bits) & (3u << 18 | 127u << 24)) == 0u;
}

// How much farther the neighbouring texel of the same plane may be, by which way it faces: a texel's height over the cosine.
float depth_slope(ViewRecord view, ivec2 texel, GuideTexel guide) {
    vec3 position = seen_position(view, vec2(pixel_of_light(view, uvec2(texel))), guide.depth);
    float facing = abs(dot(unpack_unit_vector(guide.normal), to_eye(view, position)));
    return seen_height(view, guide.depth) * view.light_step.y / max(facing, 0.05);
}

// Whether a texel of the frame before shows the same surface as one of this frame, which was so far away then.
bool shows_same(GuideTexel now, GuideTexel before, float depth_before, float slope) {
    if (before.depth == 0.0 || !is_same_object(now, before)) {
        return false;
    }
    float away = abs(before.depth - depth_before);
    return away < 2.0 * slope + 0.005 * depth_before
        && dot(unpack_unit_vector(now.normal), unpack_unit_vector(before.normal)) > 0.8;
}

// The texel of the frame before that is nearest to where one was; false if there is none that shows the same.
bool texel_before(ViewRecord view, ivec2 texel, GuideTexel guide, out uint before) {
    MotionTexel motion = Motions(view.motions).entries[light_index(view, texel)];
    ivec2 place = ivec2(floor(vec2(texel) + unpackHalf2x16(motion.offset) + 0.5));
    before = light_index(view, place);
    return motion.depth > 0.0 && is_in_light(view, place)
        && shows_same(guide, Guides(view.guides_before).entries[before], motion.depth, depth_slope(view, texel, guide));
}

#endif
