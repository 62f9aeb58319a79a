// Light as a function of what surfaces are: blocks, features and numbers of light that both passes of the regression share.

#ifndef AFTERGLOW_DENOISE_FITS_GLSL
#define AFTERGLOW_DENOISE_FITS_GLSL

#include "channels.glsl"
#include "guide.glsl"

// Red, green and blue of three channels, and the second band of indirect light.
#define NUMBERS 12u

// What a texel of light shows.
struct Point {
    uint index;
    uint kind; // its class, 0 for nothing
    vec3 normal;
    vec3 position;
    vec3 lengths; // frames of its history
};

// What makes features of normals and positions.
struct Scaling {
    vec3 normal;
    vec3 position;
    vec3 scale;
};

// Where the first block's middle is: elsewhere in each frame, by the R2 sequence, which spreads evenly.
ivec2 first_middle(ViewRecord view) {
    return -ivec2((view.frame_number * uvec2(3242174889u, 2447445414u)) >> 28);
}

uint fit_index(ViewRecord view, ivec2 block, uint kind) {
    uint across = (view.light_width + BLOCK_STEP - 1u) / BLOCK_STEP + 2u;
    return (uint(block.y) * across + uint(block.x)) * SURFACE_CLASSES + kind - 1u;
}

Point point_at(ViewRecord view, ivec2 texel) {
    Point point = Point(0u, 0u, vec3(0.0), vec3(0.0), vec3(1.0));
    if (!is_in_light(view, texel)) {
        return point;
    }
    point.index = light_index(view, texel);
    GuideTexel guide = Guides(view.guides).entries[point.index];
    if (guide.depth > 0.0) {
        point.kind = class_of(guide);
        point.normal = unpack_unit_vector(guide.normal);
        point.position = seen_position(view, vec2(pixel_of_light(view, uvec2(texel))), guide.depth);
        point.lengths = vec3(max(guide_lengths(guide), uvec3(1u)));
    }
    return point;
}

float[FEATURES] features_of(Point point, Scaling scaling) {
    vec3 n = point.normal - scaling.normal;
    vec3 p = (point.position - scaling.position) * scaling.scale;
    vec3 q = p * p;
    return float[FEATURES](1.0, n.x, n.y, n.z, p.x, p.y, p.z, q.x, q.y, q.z);
}

float[NUMBERS] numbers_of(Lit light) {
    vec3 a = light.direct.rgb;
    vec3 b = light.indirect.rgb;
    vec3 c = light.specular.rgb;
    vec3 d = light.towards.xyz;
    return float[NUMBERS](a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z);
}

#endif
