// Light as a pixel takes it: its own texel's, or that of the texels around it which show the same surface.

#ifndef AFTERGLOW_DENOISE_UPSAMPLE_GLSL
#define AFTERGLOW_DENOISE_UPSAMPLE_GLSL

#include "channels.glsl"
#include "guide.glsl"
#include "../pathtrace/spherical_harmonics.glsl"

// The three channels where they meet a surface: irradiance over pi of direct and indirect light, radiance of highlights.
struct SeenLight {
    vec3 direct;
    vec3 indirect;
    vec3 specular;
};

Lit light_texel(ViewRecord view, uint index) {
    if (view.denoised != 0ul) {
        return read_lit(view, view.denoised, index);
    }
    LightTexel light = LightTexels(view.light).entries[index];
    return Lit(vec4(light.direct, 0.0), vec4(light.specular, 0.0), vec4(light.indirect, 0.0), vec4(light.towards, 0.0));
}

SeenLight seen_light(SurfaceTexel surface, Lit light) {
    vec3 indirect = irradiance_facing(light.indirect.rgb, light.towards.xyz, unpack_unit_vector(surface.normal));
    return SeenLight(light.direct.rgb, indirect, light.specular.rgb * specular_share(surface));
}

// By nearness, direction and distance; the nearest texel alone where none is like the pixel.
Lit upsampled(ViewRecord view, SurfaceTexel surface, uvec2 pixel) {
    vec2 at = (vec2(pixel) + 0.5) / view.light_step - 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 share = at - vec2(first);
    vec3 normal = unpack_unit_vector(surface.normal);
    float depth = seen_depth(view, surface.start);
    GuideTexel own = new_guide(depth, surface.normal, surface_kind(surface), 0.0, 0u);
    Lit sum = no_light_there();
    float weights = 0.0;
    Lit nearest = no_light_there();
    float nearest_share = -1.0;
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(first + corner, ivec2(0), ivec2(light_size(view)) - 1);
        uint index = light_index(view, texel);
        GuideTexel guide = Guides(view.guides).entries[index];
        if (guide.depth == 0.0 || !is_same_class(guide, own)) {
            continue;
        }
        Lit light = light_texel(view, index);
        vec2 nearness = mix(1.0 - share, share, vec2(corner));
        float flat_share = nearness.x * nearness.y;
        float facing = max(dot(normal, unpack_unit_vector(guide.normal)), 0.0);
        float away = abs(guide.depth - depth) / (2.0 * depth_slope(view, texel, guide) + 0.002 * depth);
        float weight = (flat_share + 0.01) * facing * facing * facing * facing * max(1.0 - 0.5 * away, 0.0);
        add_lit(sum, light, vec3(weight));
        weights += weight;
        if (flat_share > nearest_share) {
            nearest_share = flat_share;
            nearest = light;
        }
    }
    if (!(weights > 1e-4)) {
        return nearest;
    }
    divide_lit(sum, vec3(weights));
    return sum;
}

SeenLight light_at(ViewRecord view, SurfaceTexel surface, uvec2 pixel) {
    if (view.light_step == vec2(1.0)) {
        return seen_light(surface, light_texel(view, pixel.y * view.width + pixel.x));
    }
    return seen_light(surface, upsampled(view, surface, pixel));
}

#endif
