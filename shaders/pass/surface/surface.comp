// What each pixel shows, from the visibility buffer: where it is, which way it faces, its colours.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "fixed/fog.glsl"
#include "pathtrace/color.glsl"
#include "pathtrace/eye.glsl"
#include "pathtrace/materials.glsl"
#include "pathtrace/said.glsl"
#include "pathtrace/surface.glsl"
#include "pathtrace/vertices.glsl"
#include "ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 5) uniform utexture2D visibility_images[];
layout(set = 0, binding = 5) uniform texture2D albedo_images[];

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Weights of a triangle's corners at a pixel, by clip coordinates x, y, w of the corners (Olano and Greer,
// Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997).
vec3 seen_weights(ViewRecord view, DrawReference draw, vec3 clip[3], uvec2 pixel) {
    vec4 viewport = draw.it.viewport;
    vec2 from_below = vec2(float(pixel.x) + 0.5, float(view.height) - float(pixel.y) - 0.5);
    vec3 at = vec3((from_below - viewport.xy) / viewport.zw * 2.0 - 1.0, 1.0);
    vec3 weights = at * mat3(cross(clip[1], clip[2]), cross(clip[2], clip[0]), cross(clip[0], clip[1]));
    return weights / (weights.x + weights.y + weights.z);
}

// How a pixel's surface faces, and where its rays start.
struct Facing {
    vec3 normal;
    vec3 geometric;
    vec3 start;
};

// The shading normal is the program's, on the side that is seen. So that the shadows of smooth normals do not show
// the triangles, rays start above the flat triangle, as far as the corners' tangent planes are (Hanika, Hacking the
// Shadow Terminator, Ray Tracing Gems II, 2021).
Facing facing(ViewRecord view, DrawReference draw, uint triangle, vec3 weights, vec3 world[3], bool lighting) {
    Facing result;
    vec3 position = world[0] * weights.x + world[1] * weights.y + world[2] * weights.z;
    vec3 geometric = unit_vector(cross(world[1] - world[0], world[2] - world[0]));
    result.geometric = dot(geometric, to_eye(view, position)) < 0.0 ? -geometric : geometric;
    result.start = position;
    uint format = layout_format(draw.it.vertex_layout, SLOT_NORMAL);
    mat3x4 rows = draw.it.object_to_world;
    vec3 normal = vec3(0.0);
    if (format != FORMAT_ABSENT) {
        uint first = layout_offset(draw.it.vertex_layout, SLOT_NORMAL);
        [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
            vec3 given = read_attribute(corner_vertex(draw, triangle, i), first, format).xyz;
            vec3 own = unit_vector(world_normal(rows, given));
            own = dot(own, result.geometric) < 0.0 ? -own : own;
            normal += weights[i] * own;
            result.start -= weights[i] * min(dot(position - world[i], own), 0.0) * own;
        }
    } else if (lighting) {
        CurrentTable current = CurrentTable(FrameTable(view.frame).entries[0].current);
        normal = world_normal(rows, current.entries[draw.it.current].normal.xyz);
        normal = dot(normal, result.geometric) < 0.0 ? -normal : normal;
    }
    normal = unit_vector(normal);
    result.normal = normal == vec3(0.0) ? result.geometric : normal;
    return result;
}

// How much of the program's fog lies before a point so far away: 1 is none.
float fog_left(ViewRecord view, DrawReference draw, GlobalState state, uint triangle, vec3 weights, float away) {
    if (state.fog_mode == FOG_NONE) {
        return 1.0;
    }
    FrameRecord frame = FrameTable(view.frame).entries[0];
    EnvironmentTable environments = EnvironmentTable(frame.environments);
    float end = environments.entries[draw.it.environment].fog_end;
    float range = end - environments.entries[draw.it.environment].fog_start;
    if (state.fog_coordinate) {
        vec4 absent = CurrentTable(frame.current).entries[draw.it.current].fog;
        away = attribute_at(draw, triangle, weights, SLOT_FOG, absent).x;
    }
    float density = environments.entries[draw.it.environment].fog_density;
    return fog_factor(state.fog_mode, away, density, end, range == 0.0 ? 1.0 : 1.0 / range);
}

uint byte_of(float value) {
    return uint(clamp(value, 0.0, 1.0) * 255.0 + 0.5);
}

// Reflectance straight on (linear) and roughness of the specular lobe.
uint pack_lobe(vec3 specular, float roughness) {
    return pack_color(srgb_from_linear(specular), byte_of(roughness));
}

// Texels, as a power of two, along a unit of a map's coordinates, so that one of them is as wide as a pixel.
float seen_texels(ViewRecord view, vec3 world[3], vec2 coordinates[3], float away) {
    vec2 edge_1 = coordinates[1] - coordinates[0];
    vec2 edge_2 = coordinates[2] - coordinates[0];
    float area_map = abs(edge_1.x * edge_2.y - edge_1.y * edge_2.x);
    float area_world = length(cross(world[1] - world[0], world[2] - world[0]));
    return 0.5 * log2(max(area_world, 1e-20) / max(area_map, 1e-20)) - log2(max(view.pixel_spread * away, 1e-20));
}

// The normal that a map has, turned into the triangle's plane: x along growing s, y along growing t.
vec3 mapped_normal(vec3 texel, vec3 normal, vec3 world[3], vec2 coordinates[3]) {
    vec3 edge_1 = world[1] - world[0];
    vec3 edge_2 = world[2] - world[0];
    vec2 map_1 = coordinates[1] - coordinates[0];
    vec2 map_2 = coordinates[2] - coordinates[0];
    float area = map_1.x * map_2.y - map_1.y * map_2.x;
    if (area == 0.0) {
        return normal;
    }
    vec3 along_s = (edge_1 * map_2.y - edge_2 * map_1.y) * sign(area);
    vec3 along_t = (edge_2 * map_1.x - edge_1 * map_2.x) * sign(area);
    vec3 tangent = unit_vector(along_s - normal * dot(normal, along_s));
    vec3 bitangent = cross(normal, tangent);
    bitangent = dot(bitangent, along_t) < 0.0 ? -bitangent : bitangent;
    vec3 own = texel * 2.0 - 1.0;
    vec3 mapped = unit_vector(tangent * own.x + bitangent * own.y + normal * own.z);
    return mapped == vec3(0.0) ? normal : mapped;
}

// Lets what the program says of the material count. `albedo` is in sRGB, and the emission that the texel has so far.
void apply_said(ViewRecord view, DrawReference draw, uint triangle, vec3 weights, vec3 world[3], float away,
    inout vec3 albedo, inout vec3 emission, inout SurfaceTexel texel) {
    vec2 coordinates[3];
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        vec3 corner = vec3(i == 0u ? 1.0 : 0.0, i == 1u ? 1.0 : 0.0, i == 2u ? 1.0 : 0.0);
        coordinates[i] = map_coordinates(view, draw, triangle, corner);
    }
    float texels = seen_texels(view, world, coordinates, away);
    vec2 here = coordinates[0] * weights.x + coordinates[1] * weights.y + coordinates[2] * weights.z;
    if (draw.it.normal_map != NO_MAP) {
        vec3 turned = map_normal(draw, here, texels);
        texel.normal = pack_unit_vector(mapped_normal(turned, unpack_unit_vector(texel.normal), world, coordinates));
    }
    if (draw.it.roughness >= 0.0) {
        vec2 varied = said_roughness_metallic(draw, here, texels);
        Bsdf bsdf = rough_bsdf(linear_from_srgb(albedo), varied.x, varied.y);
        texel.specular = pack_lobe(bsdf.specular, varied.x);
        albedo = srgb_from_linear(bsdf.diffuse);
    }
    vec3 given_off = said_emission(view, draw, triangle, weights, texels);
    emission = srgb_from_linear(min(linear_from_srgb(emission) + given_off, 1.0));
}

// Whether the program says anything of a draw's material.
bool is_said(DrawReference draw) {
    return draw.it.roughness >= 0.0 || draw.it.emission != vec3(0.0) || draw.it.normal_map != NO_MAP;
}

SurfaceTexel seen_surface(ViewRecord view, uvec2 pixel, uint draw_index, uint triangle) {
    DrawReference draw = surface_draw(view, draw_index);
    GlobalState state = global_state(draw);
    mat4 matrix = TransformTable(FrameTable(view.frame).entries[0].transforms).entries[draw.it.transform].modelview_projection;
    vec4 positions[3] = corner_positions(draw, triangle);
    vec3 clip[3];
    vec3 world[3];
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        clip[i] = (matrix * positions[i]).xyw;
        world[i] = world_position(draw, positions[i]);
    }
    vec3 weights = seen_weights(view, draw, clip, pixel);
    Facing facing = facing(view, draw, triangle, weights, world, state.lighting);

    SurfaceTexel texel;
    texel.start = offset_ray(facing.start, facing.geometric)
        + facing.geometric * start_distance(draw, positions);
    texel.normal = pack_unit_vector(facing.normal);
    texel.geometric = pack_unit_vector(facing.geometric);
    // In perspective, w is the distance along the view.
    float away = abs(weights.x * clip[0].z + weights.y * clip[1].z + weights.z * clip[2].z);
    float fog = fog_left(view, draw, state, triangle, weights, away);
    vec3 albedo = texelFetch(albedo_images[view.albedo], ivec2(pixel), 0).rgb;
    texel.specular = 0u;
    vec3 emission = vec3(0.0);
    if (draw.it.kind == SURFACE_LIT && state.lighting) {
        vec4 color = state.color_material_faces == 0u ? vec4(0.0) : vertex_color(view, draw, state, triangle, weights);
        MaterialFace material = point_material(view, draw, state, color);
        // Textures are over all of a material, but for highlights that are added after them.
        vec3 specular = state.separate_specular ? material.specular.rgb : material.specular.rgb * albedo;
        vec4 lobe = highlight_lobe(view, linear_from_srgb(clamp(specular, 0.0, 1.0)), material.shininess);
        texel.specular = pack_lobe(lobe.rgb, lobe.w);
        emission = clamp(material.emission.rgb, 0.0, 1.0) * albedo;
        albedo *= clamp(material.diffuse.rgb, 0.0, 1.0);
    }
    if (draw.it.kind == SURFACE_LIT && is_said(draw)) {
        apply_said(view, draw, triangle, weights, world, away, albedo, emission, texel);
    }
    texel.albedo = pack_color(albedo, byte_of(fog));
    texel.emission = pack_color(emission, draw.it.kind | draw.it.ray_mask << 4);
    return texel;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    uvec2 seen = texelFetch(visibility_images[view.visibility], ivec2(pixel), 0).xy;
    SurfaceTexel texel = SurfaceTexel(vec3(0.0), 0u, 0u, 0u, 0u, 0u);
    if (seen.x != 0u) {
        texel = seen_surface(view, pixel, seen.x - 1u, seen.y);
    }
    SurfaceTexels(view.surfaces).entries[pixel.y * view.width + pixel.x] = texel;
}
