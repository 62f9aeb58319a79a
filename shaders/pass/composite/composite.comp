// Traced light in place of the program's own, as 8-bit colour; alpha and what is not traced stay.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/resolve.glsl"
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

vec3 painted(ViewRecord view, SurfaceTexel surface, LightTexel light, vec3 indirect) {
    switch (view.paint) {
        case PAINT_KIND: return kind_color(surface_kind(surface)) * (0.3 + 0.7 * abs(unpack_unit_vector(surface.normal).z));
        case PAINT_NORMAL: return unpack_unit_vector(surface.normal) * 0.5 + 0.5;
        case PAINT_ALBEDO: return unpack_color(surface.albedo);
        case PAINT_DIRECT: return compressed(light.direct);
        default: return compressed(indirect);
    }
}

// Paint times light as the program multiplies them, both as they are stored: where the sources are right, traced light
// shows what baked light did.
vec3 relit(ViewRecord view, SurfaceTexel surface, LightTexel light, vec3 indirect) {
    return min(unpack_color(surface.albedo) * (light.direct + indirect) / view.bake_scale, 1.0);
}

vec3 composited(ViewRecord view, SurfaceTexel surface, LightTexel light, vec3 indirect, vec3 program, uvec2 pixel) {
    uint kind = surface_kind(surface);
    uint draw = texelFetch(visibility_images[view.visibility], ivec2(pixel), 0).x - 1u;
    vec3 scale = kind == SURFACE_LIT ? vec3(ExposureBuffer(view.exposure).entries[0].scale)
        : kind == SURFACE_BAKED_MOVER ? mover_scale(view, draw) : vec3(1.0);
    vec3 shown = srgb_from_linear(min(radiance(surface, light, indirect, linear_from_srgb(program)) * scale, 1.0));
    shown = kind == SURFACE_LIT && is_relit(view) ? relit(view, surface, light, indirect) : shown;
    if (kind == SURFACE_LIT || kind == SURFACE_BAKED_MOVER) {
        float fog = unpack_fourth(surface.albedo);
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

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    if (view.paint == PAINT_SKY) {
        imageStore(color_images[view.color], ivec2(pixel), vec4(painted_directions(view, pixel), 1.0));
        return;
    }
    uint index = pixel.y * view.width + pixel.x;
    SurfaceTexel surface = SurfaceTexels(view.surfaces).entries[index];
    if (surface_kind(surface) == SURFACE_NONE) {
        if (view.radiance != 0ul) {
            vec3 direction = view.pixel_origin + view.pixel_right * float(pixel.x) + view.pixel_down * float(pixel.y);
            RadianceTexels(view.radiance).entries[index] = RadianceTexel(sky_at(view, direction, 0u), vec3(0.0));
        }
        return;
    }
    LightTexel light = LightTexels(view.light).entries[index];
    vec3 indirect = indirect_facing(IndirectTexels(view.indirect).entries[index], unpack_unit_vector(surface.normal));
    vec4 program = imageLoad(color_images[view.color], ivec2(pixel));
    if (view.radiance != 0ul) {
        vec3 linear = radiance(surface, light, indirect, linear_from_srgb(program.rgb));
        RadianceTexels(view.radiance).entries[index] = RadianceTexel(linear, vec3(0.0));
    }
    vec3 shown = view.paint == PAINT_PICTURE
        ? composited(view, surface, light, indirect, program.rgb, pixel) : painted(view, surface, light, indirect);
    imageStore(color_images[view.color], ivec2(pixel), vec4(clamp(shown, 0.0, 1.0), program.a));
}
