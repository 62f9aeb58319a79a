// Fragments of a draw: texturing, colour sum, fog, coverage, alpha test.

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "fixed/attributes.glsl"
#include "fixed/fragment.glsl"
#include "fixed/specialized.glsl"

layout(push_constant, scalar) uniform Push { DrawPush push; };

layout(location = 0) in vec4 in_primary;
layout(location = 1) in vec3 in_secondary;
layout(location = 2) in vec4 in_back_primary;
layout(location = 3) in vec3 in_back_secondary;
layout(location = 4) flat in vec4 in_flat_primary;
layout(location = 5) flat in vec3 in_flat_secondary;
layout(location = 6) flat in vec4 in_flat_back_primary;
layout(location = 7) flat in vec3 in_flat_back_secondary;
layout(location = 8) in vec4 in_coordinates[TEXTURE_UNITS];
layout(location = 12) in float in_fog_coordinate;
layout(location = 13) flat in float in_point_size;
#ifdef WITH_VISIBILITY
layout(location = 14) in vec4 in_albedo;
layout(location = 15) flat in vec4 in_flat_albedo;
#endif

layout(location = 0) out vec4 out_color;
#ifdef WITH_VISIBILITY
// The number of the draw's surface plus 1, and the triangle.
layout(location = 1) out uvec2 out_visibility;
// The colour as it is without lighting and fog.
layout(location = 2) out vec4 out_albedo;
#endif

// Whether a unit's q is 1 everywhere, so that there is nothing to divide by.
bool has_unit_q(UnitState unit, uint i) {
    uint format = layout_format(VERTEX_LAYOUT, SLOT_TEXTURE0 + i);
    return !unit.matrix && unit.gen.w == GEN_OFF
        && (format == FORMAT_F1 || format == FORMAT_F2 || format == FORMAT_F3);
}

bool is_stippled_out(FrameRecord frame) {
    uvec2 pixel = uvec2(gl_FragCoord.x, frame.window_size.y - gl_FragCoord.y);
    uint row = EnvironmentTable(frame.environments).entries[push.environment].polygon_stipple[pixel.y & 31u];
    return ((row >> (31u - (pixel.x & 31u))) & 1u) == 0u;
}

// How much of the pixel an antialiased point covers; its square is one pixel larger than the point.
float point_coverage() {
    float from_center = length(gl_PointCoord - 0.5) * (in_point_size + 1.0);
    return clamp(in_point_size * 0.5 + 0.5 - from_center, 0.0, 1.0);
}

void main() {
    GlobalState state = specialized_global();
    UnitState units[TEXTURE_UNITS] = specialized_units();
    FrameTable frame = FrameTable(push.frame);
    if (TOPOLOGY == TOPOLOGY_TRIANGLES && state.polygon_stipple && is_stippled_out(frame.entries[0])) {
        discard;
    }

    bool back = state.lighting && state.two_side && !gl_FrontFacing;
    vec4 primary = state.flat_shade ? (back ? in_flat_back_primary : in_flat_primary)
        : (back ? in_back_primary : in_primary);
    vec3 secondary = state.flat_shade ? (back ? in_flat_back_secondary : in_flat_secondary)
        : (back ? in_back_secondary : in_secondary);

    vec4 coordinates[TEXTURE_UNITS];
    uint projective = 0u;
    [[unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        bool sprite = TOPOLOGY == TOPOLOGY_POINTS && state.point_sprite && units[i].coord_replace;
        coordinates[i] = sprite ? vec4(gl_PointCoord, 0.0, 1.0) : in_coordinates[i];
        projective |= sprite || has_unit_q(units[i], i) ? 0u : 1u << i;
    }

    vec4 color = shade_fragment(state, units, push, EnvironmentTable(frame.entries[0].environments), CLAMPS, projective, 0u,
        primary, secondary, coordinates, in_fog_coordinate);
    if (TOPOLOGY == TOPOLOGY_POINTS && state.antialiased && !state.point_sprite) {
        float coverage = point_coverage();
        if (coverage == 0.0) {
            discard;
        }
        color.a *= coverage;
    }
    if (!compare_passes(state.alpha_func, color.a, push.alpha_reference)) {
        discard;
    }
    out_color = color;
#ifdef WITH_VISIBILITY
    // The word is free for draws that are no rectangles of pixels.
    out_visibility = uvec2(push.pixels & ~(WHITE_ALBEDO | BAKE_MASK), uint(gl_PrimitiveID));
    state.fog_mode = FOG_NONE;
    state.color_sum = false;
    state.separate_specular = false;
    vec4 albedo = state.flat_shade ? in_flat_albedo : in_albedo;
    uint bake = (push.pixels & BAKE_MASK) >> BAKE_SHIFT;
    uint left_out = (1u << bake) >> 1;
    [[unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        albedo = chosen(bake == i + 1u && hides_previous(units[i]), vec4(1.0), albedo);
    }
    out_albedo = shade_fragment(state, units, push, EnvironmentTable(frame.entries[0].environments), CLAMPS, projective,
        left_out, albedo, vec3(0.0), coordinates, in_fog_coordinate);
    // Layers of light leave the surface below them as it is: all of them multiply.
    out_albedo.rgb = bake == BAKE_LAYER ? vec3(1.0) : bake == BAKE_DOUBLED_LAYER ? vec3(0.5) : out_albedo.rgb;
    out_albedo.a = color.a;
#endif
}
