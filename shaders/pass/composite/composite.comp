// Traced light in place of the program's own, as 8-bit colour; alpha and what is not traced stay. Where edges are smoothed next, what
// would be shown goes there first.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/gradients.glsl"
#include "pathtrace/resolve.glsl"
#include "pathtrace/composed.glsl"
#include "pathtrace/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 5) uniform utexture2D visibility_images[];
layout(set = 0, binding = 4, rgba8) uniform image2D color_images[];

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Of something that moves among baked surfaces: how much is the light that was traced; the rest is the
// program's own guess.
const float MOVER_TRACED = 0.6;

// What makes a moving draw as bright as the program has it, in each colour.
vec3 mover_scale(ViewRecord view, uint draw) {
    vec3 scale;
    for (uint i = 0u; i < 3u; ++i) {
        float traced = float(MoverSums(view.movers).entries[draw].traced[i]);
        float program = float(MoverSums(view.movers).entries[draw].program[i]);
        scale[i] = traced == 0.0 ? 1.0 : clamp(program / traced, 0.0, 16.0);
    }
    return scale;
}

vec3 kind_color(uint kind) {
    const vec3 colors[5] = vec3[5](vec3(0.0), vec3(1.0, 0.8, 0.2), vec3(0.3, 0.6, 1.0), vec3(0.4, 0.8, 0.4), vec3(1.0, 0.4, 0.4));
    return colors[min(kind, 4u)];
}

// Light has no upper bound; so that none is cut off, 1 is shown half as bright as the brightest there can be.
vec3 compressed(vec3 light) {
    return srgb_from_linear(light / (1.0 + luminance(light)));
}

// A direction in the picture as a colour: right red, down green.
vec3 motion_color(MotionTexel motion) {
    const float farthest = 16.0;
    vec2 offset = -unpackHalf2x16(motion.offset) / farthest;
    return motion.depth == 0.0 ? vec3(0.5, 0.5, 1.0) : vec3(clamp(offset * 0.5 + 0.5, 0.0, 1.0), 0.5);
}

// What denoisers know of the texel of light that a pixel is nearest to.
vec3 painted_texel(ViewRecord view, uvec2 pixel) {
    if (view.guides == 0ul) {
        return vec3(0.0);
    }
    uvec2 texel = min(uvec2((vec2(pixel) + 0.5) / view.light_step), light_size(view) - 1u);
    uint index = light_index(view, ivec2(texel));
    switch (view.paint) {
        case PAINT_MOTION: return motion_color(Motions(view.motions).entries[index]);
        case PAINT_HISTORY: return vec3(guide_lengths(Guides(view.guides).entries[index])) / view.longest;
        case PAINT_VARIANCE: return compressed(deviations(read_lit(view, view.history, index)));
        default: return view.gradients == 0ul ? vec3(0.0) : disbelief(view, texel);
    }
}

vec3 painted(ViewRecord view, SurfaceTexel surface, SeenLight light, uvec2 pixel) {
    switch (view.paint) {
        case PAINT_KIND: return kind_color(surface_kind(surface)) * (0.3 + 0.7 * abs(unpack_unit_vector(surface.normal).z));
        case PAINT_NORMAL: return unpack_unit_vector(surface.normal) * 0.5 + 0.5;
        case PAINT_ALBEDO: return unpack_unorm11(surface.albedo);
        case PAINT_DIRECT: return compressed(light.direct);
        case PAINT_INDIRECT: return compressed(light.indirect);
        case PAINT_SPECULAR: return compressed(light.specular);
        case PAINT_EDGES: return vec3(surface_edge(surface) == NO_EDGE ? 0.0 : 1.0 - abs(edge_offset(surface_edge(surface))));
        default: return painted_texel(view, pixel);
    }
}

// Paint times light as the program multiplies them, both as they are stored: where the sources are right, traced light
// shows what baked light did.
vec3 relit(ViewRecord view, SurfaceTexel surface, SeenLight light) {
    return min(unpack_unorm11(surface.albedo) * (light.direct + light.indirect) / view.bake_scale, 1.0);
}

vec3 composited(ViewRecord view, SurfaceTexel surface, SeenLight light, vec3 program, uvec2 pixel) {
    uint kind = surface_kind(surface);
    uint draw = texelFetch(visibility_images[view.visibility], ivec2(pixel), 0).x - 1u;
    vec3 scale = kind == SURFACE_LIT ? vec3(ExposureBuffer(view.exposure).entries[0].scale)
        : kind == SURFACE_BAKED_MOVER ? mover_scale(view, draw) : vec3(1.0);
    vec3 shown = srgb_from_linear(min(radiance(surface, light, linear_from_srgb(program)) * scale, 1.0));
    shown = kind == SURFACE_LIT && is_relit(view) ? relit(view, surface, light) : shown;
    if (kind == SURFACE_LIT || kind == SURFACE_BAKED_MOVER) {
        float fog = surface_fog(surface);
        if (fog < 1.0) {
            shown = mix(fog_color(view, draw), shown, fog);
        }
    }
    return kind == SURFACE_BAKED_MOVER ? mix(program, shown, MOVER_TRACED) : shown;
}

// The sky in the direction that a pixel stands for in a picture of all directions.
vec3 painted_directions(ViewRecord view, uvec2 pixel) {
    vec2 at = (vec2(pixel) + 0.5) / vec2(view_size(view));
    float longitude = (2.0 * at.x - 1.0) * 3.14159265;
    float latitude = (0.5 - at.y) * 3.14159265;
    vec3 direction = vec3(cos(latitude) * sin(longitude), sin(latitude), -cos(latitude) * cos(longitude));
    return srgb_from_linear(min(sky_at(view, direction, 0u), 1.0));
}

// Hands on what a pixel shows, sRGB.
void show(ViewRecord view, uvec2 pixel, vec3 shown, float alpha, float depth) {
    if (smooths_edges(view)) {
        write_composed(view, pixel, linear_from_srgb(shown), depth);
    } else {
        imageStore(color_images[view.color], ivec2(pixel), vec4(shown, alpha));
    }
}

void keep_radiance(ViewRecord view, uvec2 pixel, vec3 radiance) {
    if (view.radiance != 0ul) {
        // The second is what is smoothed into the first.
        RadianceTexels(view.radiance).entries[pixel.y * view.width + pixel.x] = RadianceTexel(radiance, radiance);
    }
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[pixel.y * view.width + pixel.x];
    vec4 program = imageLoad(color_images[view.color], ivec2(pixel));
    if (view.paint == PAINT_SKY) {
        show(view, pixel, painted_directions(view, pixel), 1.0, 0.0);
        return;
    }
    if (surface_kind(surface) == SURFACE_NONE) {
        vec3 direction = view.pixel_origin + view.pixel_right * float(pixel.x) + view.pixel_down * float(pixel.y);
        keep_radiance(view, pixel, sky_at(view, direction, 0u));
        show(view, pixel, program.rgb, program.a, 0.0);
        return;
    }
    SeenLight light = light_at(view, surface, pixel);
    bool is_picture = view.paint == PAINT_PICTURE;
    vec3 shown = is_picture ? composited(view, surface, light, program.rgb, pixel) : painted(view, surface, light, pixel);
    keep_radiance(view, pixel, is_picture ? radiance(surface, light, linear_from_srgb(program.rgb)) : linear_from_srgb(shown));
    show(view, pixel, clamp(shown, 0.0, 1.0), program.a, seen_depth(view, surface.start));
}
