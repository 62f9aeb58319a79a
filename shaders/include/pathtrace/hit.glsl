// A point of a draw's triangle: where it is and which colour the program gives it, found from the same
// state that the draw is rasterized with.
//
// The includer enables what fixed/tables.glsl and bindless.glsl ask for, and GL_EXT_buffer_reference2.

#ifndef AFTERGLOW_PATHTRACE_HIT_GLSL
#define AFTERGLOW_PATHTRACE_HIT_GLSL

#include "../bindless.glsl"
#include "../fixed/attributes.glsl"
#include "../fixed/lighting.glsl"
#include "../fixed/texenv.glsl"
#include "../fixed/texgen.glsl"
#include "../fixed/transform.glsl"
#include "tables.glsl"

// Of a list of layers no more than these are looked at.
#define MOST_LAYERS 6u

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer DrawReference { SurfaceDraw it; };

DrawReference surface_draw(ViewRecord view, uint draw) {
    return DrawReference(view.draws) + draw;
}

// A point by weights of a triangle's corners, and how these change to its two neighbours (a pixel's
// right and upper one, or what a wide ray covers). Differences sum up to 0.
struct TrianglePoint {
    uint triangle;
    vec3 weights[3];
};

// Addresses of the corners' vertices.
uint64_t[3] corner_addresses(DrawReference draw, uint triangle) {
    Words indices = Words(draw.it.indices + uint64_t(triangle) * 12ul);
    uint64_t stride = uint64_t(4u * layout_offset(draw.it.vertex_layout, SLOTS));
    uint64_t corners[3];
    for (uint i = 0u; i < 3u; ++i) {
        corners[i] = draw.it.vertices + uint64_t(min(indices.entries[i], draw.it.last_vertex)) * stride;
    }
    return corners;
}

vec4 corner_attribute(DrawReference draw, uint64_t corner, uint slot) {
    return fetch_attribute(Words(corner), draw.it.vertex_layout, slot, vec4(0.0));
}

// An attribute at these weights. Where the vertices lack it, `absent` times the weights' sum.
vec4 weighted_attribute(DrawReference draw, uint64_t corners[3], uint slot, vec3 weights, vec4 absent) {
    if (layout_format(draw.it.vertex_layout, slot) == FORMAT_ABSENT) {
        return absent * (weights.x + weights.y + weights.z);
    }
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < 3u; ++i) {
        sum += weights[i] * corner_attribute(draw, corners[i], slot);
    }
    return sum;
}

// The corners in object space, w not 1 only where vertices have it.
vec4[3] corner_positions(DrawReference draw, uint64_t corners[3]) {
    vec4 positions[3];
    for (uint i = 0u; i < 3u; ++i) {
        positions[i] = corner_attribute(draw, corners[i], SLOT_POSITION);
        if (layout_format(draw.it.vertex_layout, SLOT_POSITION) != FORMAT_F4) {
            positions[i].w = 1.0;
        }
    }
    return positions;
}

vec3 world_position(DrawReference draw, vec4 position_object) {
    return vec4(dehomogenized(position_object), 1.0) * draw.it.object_to_world;
}

// A normal in the world, not of unit length: by the matrix of cofactors.
vec3 world_normal(DrawReference draw, vec3 normal_object) {
    mat3x4 rows = draw.it.object_to_world;
    mat3 cofactors = mat3(cross(rows[1].xyz, rows[2].xyz), cross(rows[2].xyz, rows[0].xyz),
        cross(rows[0].xyz, rows[1].xyz));
    return (normal_object * cofactors) * sign(dot(rows[0].xyz, cofactors[0]));
}

// The shading normal that the program gives, of unit length; 0 where it gives none.
vec3 given_normal(ViewRecord view, DrawReference draw, uint64_t corners[3], vec3 weights, bool lighting) {
    vec4 absent = vec4(0.0);
    if (lighting) {
        absent = CurrentTable(FrameTable(view.frame).entries[0].current).entries[draw.it.current].normal;
    }
    return unit_vector(world_normal(draw, weighted_attribute(draw, corners, SLOT_NORMAL, weights, absent).xyz));
}

// Weights at a ray's hit; `corners` in the world, `width` of what the ray covers there.
TrianglePoint hit_point(uint triangle, vec2 barycentrics, vec3 corners[3], float width) {
    vec3 edge_1 = corners[1] - corners[0];
    vec3 edge_2 = corners[2] - corners[0];
    vec3 normal = cross(edge_1, edge_2);
    vec3 along_1 = unit_vector(edge_1);
    vec3 along_2 = unit_vector(cross(normal, edge_1));
    float scale = width / max(dot(normal, normal), 1e-30);
    // How the weights of the second and third corner grow along a direction.
    mat2x3 gradients = mat2x3(cross(edge_2, normal), cross(normal, edge_1));
    vec2 difference_1 = along_1 * gradients * scale;
    vec2 difference_2 = along_2 * gradients * scale;
    TrianglePoint point;
    point.triangle = triangle;
    point.weights[0] = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    point.weights[1] = vec3(-difference_1.x - difference_1.y, difference_1);
    point.weights[2] = vec3(-difference_2.x - difference_2.y, difference_2);
    return point;
}

// The level of a texture of this size between texel coordinates that lie so far apart.
float texture_level(vec3 size, vec3 difference_x, vec3 difference_y) {
    vec3 x = difference_x * size;
    vec3 y = difference_y * size;
    return 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1e-12));
}

// Where GL_CLAMP wraps a coordinate (see fixed/texture.glsl): bit 0 s, 1 t, 2 r.
vec3 wrapped_coordinates(uint clamps, vec3 coordinates) {
    bvec3 clamped = bvec3((clamps & 1u) != 0u, (clamps & 2u) != 0u, (clamps & 4u) != 0u);
    return mix(coordinates, clamp(coordinates, 0.0, 1.0), clamped);
}

// The texel of a unit; `coordinates` of the point, then their differences.
vec4 unit_texel(UnitState unit, uint packed, uint clamps, vec4 coordinates[3]) {
    uint image = packed & 0xfffffu;
    uint filtering = packed >> 20;
    if (unit.target == TARGET_CUBE) {
        return textureLod(samplerCube(textures_cube[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]),
            coordinates[0].xyz, 0.0);
    }
    vec3 at = coordinates[0].xyz / coordinates[0].w;
    vec4 right = coordinates[0] + coordinates[1];
    vec4 up = coordinates[0] + coordinates[2];
    vec3 difference_x = right.xyz / right.w - at;
    vec3 difference_y = up.xyz / up.w - at;
    vec3 wrapped = wrapped_coordinates(clamps, at);
    if (unit.target == TARGET_D3) {
        vec3 size = vec3(textureSize(sampler3D(textures_3d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]), 0));
        return textureLod(sampler3D(textures_3d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]), wrapped,
            texture_level(size, difference_x, difference_y));
    }
    vec2 size = vec2(textureSize(sampler2D(textures_2d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]), 0));
    vec4 texel = textureLod(sampler2D(textures_2d[nonuniformEXT(image)], samplers[nonuniformEXT(filtering)]), wrapped.xy,
        texture_level(vec3(size, 0.0), difference_x, difference_y));
    // What a depth texture compares to is as good as passed.
    return unit.base_format == BASE_FORMAT_DEPTH ? vec4(unit.compare == 0u ? texel.x : 1.0) : texel;
}

UnitState unit_state(DrawReference draw, uint unit) {
    uint first = UNIT_FIRST_WORD(unit);
    return decode_unit(uint[UNIT_WORDS](draw.it.state[first], draw.it.state[first + 1u], draw.it.state[first + 2u]));
}

GlobalState global_state(DrawReference draw) {
    return decode_global(uint[STATE_WORDS](draw.it.state[0], draw.it.state[1]));
}

// What coordinates are generated from. Of differences only the linear modes have any.
TexGenVertex generator(ViewRecord view, FrameRecord frame, DrawReference draw, uint64_t corners[3], vec3 weights, bool is_point) {
    vec4 position_object = weighted_attribute(draw, corners, SLOT_POSITION, weights, vec4(0.0));
    if (layout_format(draw.it.vertex_layout, SLOT_POSITION) != FORMAT_F4) {
        position_object.w = is_point ? 1.0 : 0.0;
    }
    TransformTable transforms = TransformTable(frame.transforms);
    vec4 position_eye = transforms.entries[draw.it.transform].modelview * position_object;
    if (!is_point) {
        return TexGenVertex(position_object, position_eye, vec3(0.0), vec3(0.0), vec2(0.0));
    }
    vec4 absent = CurrentTable(frame.current).entries[draw.it.current].normal;
    vec3 normal_object = weighted_attribute(draw, corners, SLOT_NORMAL, weights, absent).xyz;
    vec3 normal = normal_eye(global_state(draw), transforms.entries[draw.it.transform].normal, normal_object);
    return texgen_vertex(position_object, position_eye, dehomogenized(position_eye), normal);
}

// Texture coordinates of a unit at the point, then their differences.
vec4[3] unit_coordinates(ViewRecord view, FrameRecord frame, DrawReference draw, uint64_t corners[3], TrianglePoint point, UnitState state, uint unit) {
    vec4 given = CurrentTable(frame.current).entries[draw.it.current].texture[unit].coefficients;
    vec4 coordinates[3];
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        vec3 weights = point.weights[i];
        vec4 at = weighted_attribute(draw, corners, SLOT_TEXTURE0 + unit, weights, i == 0u ? given : vec4(0.0));
        if (state.gen != uvec4(GEN_OFF)) {
            TexGenVertex vertex = generator(view, frame, draw, corners, weights, i == 0u);
            at = texgen(state, TexGenTable(frame.texgens).entries[draw.it.texgen].units[unit], vertex, at);
        }
        if (state.matrix) {
            at = TextureMatricesTable(frame.texture_matrices).entries[draw.it.texture_matrices].units[unit].columns * at;
        }
        coordinates[i] = at;
    }
    return coordinates;
}

// The colour after texturing of `primary`, in sRGB as the program has it.
vec4 textured_color(ViewRecord view, DrawReference draw, uint64_t corners[3], TrianglePoint point, vec4 primary) {
    FrameRecord frame = FrameTable(view.frame).entries[0];
    vec4 texels[TEXTURE_UNITS] = vec4[TEXTURE_UNITS](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    [[dont_unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        UnitState state = unit_state(draw, i);
        if (state.target != 0u) {
            vec4 coordinates[3] = unit_coordinates(view, frame, draw, corners, point, state, i);
            texels[i] = unit_texel(state, draw.it.textures[i], (draw.it.clamps >> (3u * i)) & 7u, coordinates);
        }
    }
    vec4 color = primary;
    [[dont_unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        vec4 constant = EnvironmentTable(frame.environments).entries[draw.it.environment].env_color[i];
        color = apply_environment(unit_state(draw, i), texels, i, color, primary, constant);
    }
    return color;
}

// The front side's material with the vertices' colour in place of what follows it.
MaterialFace point_material(ViewRecord view, DrawReference draw, GlobalState state, vec4 color) {
    MaterialFace material = MaterialTable(FrameTable(view.frame).entries[0].materials).entries[draw.it.material].faces[0];
    return followed_material(state, material, 0u, color);
}

vec4 vertex_color(ViewRecord view, DrawReference draw, GlobalState state, uint64_t corners[3], vec3 weights) {
    vec4 absent = CurrentTable(FrameTable(view.frame).entries[0].current).entries[draw.it.current].color;
    // The first vertex is the one that flat colours come from.
    return weighted_attribute(draw, corners, SLOT_COLOR, state.flat_shade ? vec3(1.0, 0.0, 0.0) : weights, absent);
}

vec3 blend_factor(uint factor, vec4 source, vec4 destination) {
    switch (factor) {
        case BLEND_FACTOR_ZERO: return vec3(0.0);
        case BLEND_FACTOR_SOURCE_COLOR: return source.rgb;
        case BLEND_FACTOR_ONE_MINUS_SOURCE_COLOR: return 1.0 - source.rgb;
        case BLEND_FACTOR_DESTINATION_COLOR: return destination.rgb;
        case BLEND_FACTOR_ONE_MINUS_DESTINATION_COLOR: return 1.0 - destination.rgb;
        case BLEND_FACTOR_SOURCE_ALPHA: return source.aaa;
        case BLEND_FACTOR_ONE_MINUS_SOURCE_ALPHA: return vec3(1.0 - source.a);
        case BLEND_FACTOR_DESTINATION_ALPHA: return destination.aaa;
        case BLEND_FACTOR_ONE_MINUS_DESTINATION_ALPHA: return vec3(1.0 - destination.a);
        default: return vec3(1.0);
    }
}

// A layer over what is below it.
vec4 blended(uint word, vec4 source, vec4 destination) {
    if (blend_enabled(word) == 0u) {
        return source;
    }
    vec3 above = source.rgb * blend_factor(blend_source(word), source, destination);
    vec3 below = destination.rgb * blend_factor(blend_destination(word), source, destination);
    vec3 color = above + below;
    switch (blend_equation(word)) {
        case BLEND_EQUATION_SUBTRACT: color = above - below; break;
        case BLEND_EQUATION_REVERSE_SUBTRACT: color = below - above; break;
        case BLEND_EQUATION_MIN: color = min(source.rgb, destination.rgb); break;
        case BLEND_EQUATION_MAX: color = max(source.rgb, destination.rgb); break;
        default: break;
    }
    return vec4(clamp(color, 0.0, 1.0), destination.a);
}

// The program's colour of a surface without lighting, all its layers together, in sRGB. `white` stands for
// the vertices' colours where these are light and not paint.
vec4 unlit_color(ViewRecord view, uint draw, TrianglePoint point, bool white) {
    vec4 color = vec4(1.0);
    [[dont_unroll]] for (uint n = 0u; n < MOST_LAYERS; ++n) {
        DrawReference layer = surface_draw(view, draw);
        uint64_t corners[3] = corner_addresses(layer, point.triangle);
        GlobalState state = global_state(layer);
        vec4 primary = vertex_color(view, layer, state, corners, point.weights[0]);
        if (state.lighting) {
            primary = point_material(view, layer, state, primary).diffuse;
        } else if (white) {
            primary.rgb = vec3(1.0);
        }
        vec4 own = textured_color(view, layer, corners, point, clamp(primary, 0.0, 1.0));
        color = n == 0u ? own : blended(layer.it.blend, own, color);
        if (layer.it.next_layer == draw) {
            break;
        }
        draw = layer.it.next_layer;
    }
    return color;
}

// Whether alpha test leaves the point of a triangle that a ray meets. Of texturing only unit 0's texel counts.
bool passes_alpha_test(ViewRecord view, uint draw, uint triangle, vec2 barycentrics) {
    DrawReference surface = surface_draw(view, draw);
    GlobalState state = global_state(surface);
    FrameRecord frame = FrameTable(view.frame).entries[0];
    uint64_t corners[3] = corner_addresses(surface, triangle);
    TrianglePoint point;
    point.triangle = triangle;
    point.weights = vec3[3](vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics), vec3(0.0), vec3(0.0));
    vec4 primary = vertex_color(view, surface, state, corners, point.weights[0]);
    float alpha = state.lighting ? point_material(view, surface, state, primary).diffuse.a : primary.a;
    UnitState unit = unit_state(surface, 0u);
    if (unit.target != 0u && has_alpha(unit.base_format)) {
        vec4 coordinates[3] = unit_coordinates(view, frame, surface, corners, point, unit, 0u);
        float texel = unit_texel(unit, surface.it.textures[0], surface.it.clamps & 7u, coordinates).a;
        alpha = unit.env_mode == ENV_MODE_REPLACE ? texel : alpha * texel;
    }
    float reference = EnvironmentTable(frame.environments).entries[surface.it.environment].alpha_reference;
    return compare_passes(state.alpha_func, alpha, reference);
}

#endif
