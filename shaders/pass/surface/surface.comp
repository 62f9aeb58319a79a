// What each pixel shows, from the visibility buffer: where it is, which way it faces, its colours; and what denoisers go by: where it
// was in the frame before.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/guide.glsl"
#include "fixed/fog.glsl"
#include "pathtrace/color.glsl"
#include "pathtrace/edge.glsl"
#include "pathtrace/materials.glsl"
#include "pathtrace/said.glsl"
#include "pathtrace/surface.glsl"
#include "pathtrace/vertices.glsl"
#include "ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 5) uniform utexture2D visibility_images[];
layout(set = 0, binding = 5) uniform texture2D albedo_images[];

layout(push_constant, scalar) uniform Push { ViewPush push; };

// A pixel's middle in normalised device coordinates, and 1.
vec3 seen_place(ViewRecord view, DrawReference draw, uvec2 pixel) {
    vec4 viewport = draw.it.viewport;
    vec2 from_below = vec2(float(pixel.x) + 0.5, float(view.height) - float(pixel.y) - 0.5);
    return vec3((from_below - viewport.xy) / viewport.zw * 2.0 - 1.0, 1.0);
}

// How a pixel's surface faces, and where its rays start.
struct Facing {
    vec3 normal;
    vec3 geometric;
    vec3 start;
    vec3 position;
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
    result.position = position;
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

// What a pixel reflects and gives off, while it is found: linear.
struct Look {
    vec3 albedo;
    vec3 specular; // reflected straight on
    float roughness;
    vec3 emission;
    vec3 normal;
};

// Lets what the program says of the material count.
void apply_said(ViewRecord view, DrawReference draw, uint triangle, vec3 weights, vec3 world[3], float away, inout Look look) {
    vec2 coordinates[3];
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        vec3 corner = vec3(i == 0u ? 1.0 : 0.0, i == 1u ? 1.0 : 0.0, i == 2u ? 1.0 : 0.0);
        coordinates[i] = map_coordinates(view, draw, triangle, corner);
    }
    float texels = seen_texels(view, world, coordinates, away);
    vec2 here = coordinates[0] * weights.x + coordinates[1] * weights.y + coordinates[2] * weights.z;
    if (draw.it.normal_map != NO_MAP) {
        look.normal = mapped_normal(map_normal(draw, here, texels), look.normal, world, coordinates);
    }
    if (draw.it.roughness >= 0.0) {
        vec2 varied = said_roughness_metallic(draw, here, texels);
        Bsdf bsdf = rough_bsdf(look.albedo, varied.x, varied.y);
        look.specular = bsdf.specular;
        look.roughness = varied.x;
        look.albedo = bsdf.diffuse;
    }
    look.emission += said_emission(view, draw, triangle, weights, texels);
}

// Whether the program says anything of a draw's material.
bool is_said(DrawReference draw) {
    return draw.it.roughness >= 0.0 || draw.it.emission != vec3(0.0) || draw.it.normal_map != NO_MAP;
}

// What the program's own state says of a surface. `color` is what its textures leave, as the program stores it.
Look programs_look(ViewRecord view, DrawReference draw, GlobalState state, uint triangle, vec3 weights, vec3 color, vec3 normal) {
    Look look = Look(linear_from_srgb(color), vec3(0.0), 1.0, vec3(0.0), normal);
    if (draw.it.kind == SURFACE_LIT && state.lighting) {
        vec4 followed = state.color_material_faces == 0u ? vec4(0.0) : vertex_color(view, draw, state, triangle, weights);
        MaterialFace material = point_material(view, draw, state, followed);
        // Textures are over all of a material, but for highlights that are added after them.
        vec3 specular = state.separate_specular ? material.specular.rgb : material.specular.rgb * color;
        vec4 lobe = highlight_lobe(view, linear_from_srgb(clamp(specular, 0.0, 1.0)), material.shininess);
        look.specular = lobe.rgb;
        look.roughness = lobe.w;
        look.emission = linear_from_srgb(clamp(material.emission.rgb, 0.0, 1.0) * color);
        look.albedo = linear_from_srgb(color * clamp(material.diffuse.rgb, 0.0, 1.0));
    }
    return look;
}

// Where what a pixel shows was in the frame before, and how far away; not at all where it is new.
MotionTexel motion(ViewRecord view, DrawReference draw, uint triangle, vec3 weights, vec4 positions[3], uvec2 pixel) {
    mat3x4 rows = draw.it.object_to_world_before;
    vec3 position = vec3(0.0);
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        vec3 corner = dehomogenized(positions[i]);
        if (draw.it.corners_before != 0ul) {
            uint first = 3u * (3u * triangle + i);
            Words words = Words(draw.it.corners_before);
            corner = uintBitsToFloat(uvec3(words.entries[first], words.entries[first + 1u], words.entries[first + 2u]));
        }
        position += weights[i] * (vec4(corner, 1.0) * rows);
    }
    vec2 before;
    bool is_before = place_before(view, position, before);
    vec2 offset = (before - vec2(pixel) - 0.5) / view.light_step;
    float depth = dot(view.depth_before, vec4(position, 1.0));
    // Half floats reach so far; what was farther away was out of sight.
    bool was_there = view.guides_before != 0ul && rows[0].xyz != vec3(0.0) && is_before && depth > 0.0
        && all(lessThan(abs(offset), vec2(16384.0)));
    return was_there ? MotionTexel(packHalf2x16(offset), depth) : MotionTexel(0u, 0.0);
}

// Everything of a pixel.
struct Seen {
    SurfaceTexel surface;
    GuideTexel guide;
    MotionTexel motion;
};

Seen seen_surface(ViewRecord view, uvec2 pixel, uint draw_index, uint triangle) {
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
    // Weights of a triangle's corners at a pixel, by clip coordinates x, y, w of the corners (Olano and Greer,
    // Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997).
    mat3 edges = mat3(cross(clip[1], clip[2]), cross(clip[2], clip[0]), cross(clip[0], clip[1]));
    vec3 products = seen_place(view, draw, pixel) * edges;
    vec3 weights = products / (products.x + products.y + products.z);
    Facing facing = facing(view, draw, triangle, weights, world, state.lighting);
    // In perspective, w is the distance along the view.
    float away = abs(weights.x * clip[0].z + weights.y * clip[1].z + weights.z * clip[2].z);

    vec3 color = texelFetch(albedo_images[view.albedo], ivec2(pixel), 0).rgb;
    Look look = programs_look(view, draw, state, triangle, weights, color, facing.normal);
    bool is_plain = draw.it.base_color.x >= 0.0;
    if (is_plain) {
        look.albedo = draw.it.base_color;
    }
    if (draw.it.kind == SURFACE_LIT && is_said(draw)) {
        apply_said(view, draw, triangle, weights, world, away, look);
        vec3 front = cross(world[1] - world[0], world[2] - world[0]);
        bool is_front = dot(front, facing.geometric) > 0.0 != mirrors(draw.it.object_to_world);
        look.emission = is_plain && !is_front ? vec3(0.0) : look.emission;
    }
    Seen seen;
    seen.surface.start = offset_ray(facing.start, facing.geometric) + facing.geometric * start_distance(draw, positions);
    seen.surface.normal = pack_unit_vector(look.normal);
    seen.surface.geometric = pack_unit_vector(facing.geometric);
    seen.surface.albedo = pack_unorm11(srgb_from_linear(look.albedo));
    seen.surface.specular = pack_unorm11(srgb_from_linear(look.specular));
    seen.surface.emission = pack_shared_exponent(look.emission);
    uint edge = nearest_edge(draw.it.viewport.zw, edges, products, clip);
    float fog = fog_left(view, draw, state, triangle, weights, away);
    seen.surface.properties = pack_properties(fog, look.roughness, draw.it.kind, draw.it.ray_mask, edge);
    float depth = max(seen_depth(view, facing.position), 1e-20);
    float roughness = look.specular == vec3(0.0) ? 1.0 : look.roughness;
    seen.guide = new_guide(depth, seen.surface.normal, draw.it.kind, roughness, draw.it.object);
    seen.motion = motion(view, draw, triangle, weights, positions, pixel);
    return seen;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view_size(view)))) {
        return;
    }
    uvec2 drawn = texelFetch(visibility_images[view.visibility], ivec2(pixel), 0).xy;
    Seen seen = Seen(SurfaceTexel(vec3(0.0), 0u, 0u, 0u, 0u, 0u, 0u), GuideTexel(0.0, 0u, 0u), MotionTexel(0u, 0.0));
    if (drawn.x != 0u) {
        seen = seen_surface(view, pixel, drawn.x - 1u, drawn.y);
    }
    SurfaceTexels(view.surfaces).entries[pixel.y * view.width + pixel.x] = seen.surface;
    if (view.guides == 0ul) {
        return;
    }
    uvec2 texel = uvec2(texel_along(pixel.x, view.light_step.x, view.light_width, view.width),
        texel_along(pixel.y, view.light_step.y, view.light_height, view.height));
    if (all(lessThan(texel, light_size(view)))) {
        uint index = light_index(view, ivec2(texel));
        Guides(view.guides).entries[index] = seen.guide;
        Motions(view.motions).entries[index] = seen.motion;
    }
}
