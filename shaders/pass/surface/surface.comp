// What each pixel shows, from the visibility buffer: where it is, which way it faces, its colours.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "fixed/fog.glsl"
#include "pathtrace/hit.glsl"
#include "pathtrace/surface.glsl"
#include "ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 4, rg32ui) uniform readonly uimage2D visibility_images[];

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Weights of a triangle's corners at a point of the viewport, by clip coordinates x, y, w of the corners
// (Olano and Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997).
vec3 weights_at(mat3 edges, vec2 point) {
    vec3 weights = vec3(point, 1.0) * edges;
    return weights / (weights.x + weights.y + weights.z);
}

TrianglePoint seen_point(ViewRecord view, FrameRecord frame, DrawReference draw, uint triangle, vec4 positions[3], uvec2 pixel) {
    mat4 matrix = TransformTable(frame.transforms).entries[draw.it.transform].modelview_projection;
    vec3 clip[3];
    for (uint i = 0u; i < 3u; ++i) {
        clip[i] = (matrix * positions[i]).xyw;
    }
    mat3 edges = mat3(cross(clip[1], clip[2]), cross(clip[2], clip[0]), cross(clip[0], clip[1]));
    vec4 viewport = draw.it.viewport;
    vec2 from_below = vec2(float(pixel.x) + 0.5, float(view.height) - float(pixel.y) - 0.5);
    vec2 at = (from_below - viewport.xy) / viewport.zw * 2.0 - 1.0;
    vec2 step = 2.0 / viewport.zw;
    TrianglePoint point;
    point.triangle = triangle;
    point.weights[0] = weights_at(edges, at);
    point.weights[1] = weights_at(edges, at + vec2(step.x, 0.0)) - point.weights[0];
    point.weights[2] = weights_at(edges, at + vec2(0.0, step.y)) - point.weights[0];
    return point;
}

// Where rays start, so that smooth normals' shadows do not show the triangles: above the flat triangle as
// far as the corners' tangent planes are (Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021).
vec3 rounded(DrawReference draw, uint64_t corners[3], vec3 weights, vec3 world[3], vec3 flat_position, vec3 towards) {
    if (layout_format(draw.it.vertex_layout, SLOT_NORMAL) == FORMAT_ABSENT) {
        return flat_position;
    }
    vec3 position = flat_position;
    for (uint i = 0u; i < 3u; ++i) {
        vec3 normal = unit_vector(world_normal(draw, corner_attribute(draw, corners[i], SLOT_NORMAL).xyz));
        normal = dot(normal, towards) < 0.0 ? -normal : normal;
        position -= weights[i] * min(dot(flat_position - world[i], normal), 0.0) * normal;
    }
    return position;
}

// How much of the program's fog lies before the point: 1 is none.
float fog_left(FrameRecord frame, DrawReference draw, GlobalState state, uint64_t corners[3], vec3 weights, vec4 position_object) {
    if (state.fog_mode == FOG_NONE) {
        return 1.0;
    }
    Environment environment = EnvironmentTable(frame.environments).entries[draw.it.environment];
    vec4 eye = TransformTable(frame.transforms).entries[draw.it.transform].modelview * position_object;
    vec4 absent = CurrentTable(frame.current).entries[draw.it.current].fog;
    float coordinate = state.fog_coordinate
        ? weighted_attribute(draw, corners, SLOT_FOG, weights, absent).x : abs(dehomogenized(eye).z);
    float range = environment.fog_end - environment.fog_start;
    return fog_factor(state.fog_mode, coordinate, environment.fog_density, environment.fog_end, range == 0.0 ? 0.0 : 1.0 / range);
}

SurfaceTexel seen_surface(ViewRecord view, uvec2 pixel, uint draw_index, uint triangle) {
    FrameRecord frame = FrameTable(view.frame).entries[0];
    DrawReference draw = surface_draw(view, draw_index);
    GlobalState state = global_state(draw);
    uint64_t corners[3] = corner_addresses(draw, triangle);
    vec4 positions[3] = corner_positions(draw, corners);
    TrianglePoint point = seen_point(view, frame, draw, triangle, positions, pixel);
    vec3 weights = point.weights[0];

    vec3 world[3];
    vec4 position_object = vec4(0.0);
    for (uint i = 0u; i < 3u; ++i) {
        world[i] = world_position(draw, positions[i]);
        position_object += weights[i] * positions[i];
    }
    vec3 position = world_position(draw, position_object);
    vec3 geometric = unit_vector(cross(world[1] - world[0], world[2] - world[0]));
    geometric = dot(geometric, position) > 0.0 ? -geometric : geometric;
    vec3 normal = given_normal(view, draw, corners, weights, state.lighting);
    normal = normal == vec3(0.0) ? geometric : dot(normal, geometric) < 0.0 ? -normal : normal;

    SurfaceTexel texel;
    // The matrices of the world's instances are rounded: the more so, the farther the object reaches.
    float reach = length(draw.it.object_to_world[0].xyz) * max(max(abs(position_object.x), abs(position_object.y)), abs(position_object.z));
    vec3 start = rounded(draw, corners, weights, world, position, geometric);
    texel.start = offset_ray(start, geometric) + geometric * (reach * 4e-6);
    texel.normal = pack_unit_vector(normal);
    texel.geometric = pack_unit_vector(geometric);
    texel.albedo = 0u;
    texel.specular = 0u;
    vec3 emission = vec3(0.0);
    float fog = 1.0;
    if (draw.it.kind == SURFACE_LIT || draw.it.kind == SURFACE_BAKED_MOVER) {
        vec3 albedo = unlit_color(view, draw_index, point, draw.it.kind == SURFACE_BAKED_MOVER).rgb;
        fog = fog_left(frame, draw, state, corners, weights, position_object);
        texel.albedo = pack_color(albedo, uint(fog * 255.0 + 0.5));
    }
    if (draw.it.kind == SURFACE_LIT) {
        MaterialFace material = point_material(view, draw, state, vertex_color(view, draw, state, corners, weights));
        texel.specular = pack_color(clamp(material.specular.rgb, 0.0, 1.0), uint(clamp(material.shininess / 128.0, 0.0, 1.0) * 255.0 + 0.5));
        emission = clamp(material.emission.rgb, 0.0, 1.0);
    }
    texel.emission = pack_color(emission, draw.it.kind | draw.it.ray_mask << 4);
    return texel;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    uvec2 seen = imageLoad(visibility_images[view.visibility], ivec2(pixel)).xy;
    SurfaceTexel texel = SurfaceTexel(vec3(0.0), 0u, 0u, 0u, 0u, 0u);
    if (seen.x != 0u) {
        texel = seen_surface(view, pixel, seen.x - 1u, seen.y);
    }
    SurfaceTexels(view.surfaces).entries[pixel.y * view.width + pixel.x] = texel;
}
