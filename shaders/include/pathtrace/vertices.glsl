// Vertices of a surface's triangles, read in loops: code that reads memory is long on some devices.

#ifndef AFTERGLOW_PATHTRACE_VERTICES_GLSL
#define AFTERGLOW_PATHTRACE_VERTICES_GLSL

#include "../fixed/attributes.glsl"
#include "../fixed/lighting.glsl"
#include "../fixed/state.glsl"
#include "finite.glsl"
#include "tables.glsl"

// The includer enables GL_EXT_buffer_reference2.
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer DrawReference { SurfaceDraw it; };

DrawReference surface_draw(ViewRecord view, uint draw) {
    return DrawReference(view.draws) + draw;
}

GlobalState global_state(DrawReference draw) {
    return decode_global(uint[STATE_WORDS](draw.it.state[0], draw.it.state[1]));
}

// The vertex at a triangle's corner.
Words corner_vertex(DrawReference draw, uint triangle, uint corner) {
    uint index = Words(draw.it.indices).entries[3u * triangle + corner];
    uint words = layout_offset(draw.it.vertex_layout, SLOTS);
    return Words(draw.it.vertices + uint64_t(min(index, draw.it.last_vertex)) * uint64_t(4u * words));
}

// An attribute that the layout has: missing components are 0, 0, 1.
vec4 read_attribute(Words vertex, uint first, uint format) {
    if (format == FORMAT_UNORM8X4) {
        return unpackUnorm4x8(vertex.entries[first]);
    }
    vec4 value = vec4(0.0, 0.0, 0.0, 1.0);
    [[dont_unroll]] for (uint i = 0u; i < format; ++i) {
        value[i] = uintBitsToFloat(vertex.entries[first + i]);
    }
    return value;
}

// An attribute at these weights of a triangle's corners, or `absent` if the vertices lack it.
vec4 attribute_at(DrawReference draw, uint triangle, vec3 weights, uint slot, vec4 absent) {
    uint format = layout_format(draw.it.vertex_layout, slot);
    if (format == FORMAT_ABSENT) {
        return absent;
    }
    uint first = layout_offset(draw.it.vertex_layout, slot);
    vec4 sum = vec4(0.0);
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        sum += weights[i] * read_attribute(corner_vertex(draw, triangle, i), first, format);
    }
    return sum;
}

// A texture unit's coordinates at a triangle's corners.
vec4[3] corner_coordinates(ViewRecord view, DrawReference draw, uint triangle, uint unit) {
    uint slot = SLOT_TEXTURE0 + unit;
    uint format = layout_format(draw.it.vertex_layout, slot);
    vec4 given = CurrentTable(FrameTable(view.frame).entries[0].current).entries[draw.it.current].texture[unit].coefficients;
    vec4 coordinates[3] = vec4[3](given, given, given);
    if (format != FORMAT_ABSENT) {
        uint first = layout_offset(draw.it.vertex_layout, slot);
        [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
            coordinates[i] = read_attribute(corner_vertex(draw, triangle, i), first, format);
        }
    }
    return coordinates;
}

// A place in a texture: what is no number counts as 0, and what is so far away that samplers would lose count as far as they
// keep it.
vec2 texture_place(vec4 coordinates) {
    const float farthest = 1048576.0;
    vec2 at = coordinates.xy / coordinates.w;
    at = vec2(is_finite(at.x) ? at.x : 0.0, is_finite(at.y) ? at.y : 0.0);
    return clamp(at, -farthest, farthest);
}

// A triangle's corners in object space.
vec4[3] corner_positions(DrawReference draw, uint triangle) {
    uint format = layout_format(draw.it.vertex_layout, SLOT_POSITION);
    vec4 positions[3];
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        positions[i] = read_attribute(corner_vertex(draw, triangle, i), 0u, format);
    }
    return positions;
}

vec3 world_position(DrawReference draw, vec4 position_object) {
    return vec4(dehomogenized(position_object), 1.0) * draw.it.object_to_world;
}

// A normal in the world, not of unit length: by the matrix of cofactors.
vec3 world_normal(mat3x4 rows, vec3 normal_object) {
    mat3 cofactors = mat3(cross(rows[1].xyz, rows[2].xyz), cross(rows[2].xyz, rows[0].xyz),
        cross(rows[0].xyz, rows[1].xyz));
    return (normal_object * cofactors) * sign(dot(rows[0].xyz, cofactors[0]));
}

bool mirrors(mat3x4 rows) {
    return dot(rows[0].xyz, cross(rows[1].xyz, rows[2].xyz)) < 0.0;
}

// How far a point's rays must start from it, so that they do not meet its own triangle: rays are rounded where they enter
// an instance, the more so, the farther the object reaches.
float start_distance(DrawReference draw, vec4 corners_object[3]) {
    mat3x4 rows = draw.it.object_to_world;
    vec3 reach = vec3(0.0);
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        reach = max(reach, abs(dehomogenized(corners_object[i])));
    }
    reach = min(reach, draw.it.reach);
    vec3 world = vec3(dot(abs(rows[0].xyz), reach), dot(abs(rows[1].xyz), reach), dot(abs(rows[2].xyz), reach));
    return 4e-6 * max(max(world.x, world.y), world.z);
}

// The colour that vertices have at a point, for lighting or in its place.
vec4 vertex_color(ViewRecord view, DrawReference draw, GlobalState state, uint triangle, vec3 weights) {
    vec4 absent = CurrentTable(FrameTable(view.frame).entries[0].current).entries[draw.it.current].color;
    // Flat colours come from the first vertex.
    return attribute_at(draw, triangle, state.flat_shade ? vec3(1.0, 0.0, 0.0) : weights, SLOT_COLOR, absent);
}

// The front side's material with the vertices' colour in place of what follows it.
MaterialFace point_material(ViewRecord view, DrawReference draw, GlobalState state, vec4 color) {
    MaterialTable materials = MaterialTable(FrameTable(view.frame).entries[0].materials);
    return followed_material(state, materials.entries[draw.it.material].faces[0], 0u, color);
}

#endif
