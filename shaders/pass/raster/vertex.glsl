// Vertices of a draw: pulled from memory, transformed, lit, with texture coordinates and fog.

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "fixed/attributes.glsl"
#include "fixed/lighting.glsl"
#include "fixed/specialized.glsl"
#include "fixed/texgen.glsl"
#include "fixed/transform.glsl"
#ifdef SKY_SIDE
#include "pathtrace/cube.glsl"
#endif

layout(push_constant, scalar) uniform Push { DrawPush push; };

// Flat and smooth twins: of each pair the fragment shader reads one, and the other folds away.
layout(location = 0) out vec4 out_primary;
layout(location = 1) out vec3 out_secondary;
layout(location = 2) out vec4 out_back_primary;
layout(location = 3) out vec3 out_back_secondary;
layout(location = 4) flat out vec4 out_flat_primary;
layout(location = 5) flat out vec3 out_flat_secondary;
layout(location = 6) flat out vec4 out_flat_back_primary;
layout(location = 7) flat out vec3 out_flat_back_secondary;
layout(location = 8) out vec4 out_coordinates[TEXTURE_UNITS];
layout(location = 12) out float out_fog_coordinate;
layout(location = 13) flat out float out_point_size;
#ifdef WITH_VISIBILITY
// The colour that is textured, for what is lit later.
layout(location = 14) out vec4 out_albedo;
layout(location = 15) flat out vec4 out_flat_albedo;
#endif

invariant gl_Position;

// The colours of both sides, clamped as they are before interpolation.
void side_colors(
    GlobalState state, FrameRecord frame, DrawRecord draw, vec4 color, vec3 secondary, vec3 position, vec3 normal,
    out LitColors front, out LitColors back
) {
    front = LitColors(color, secondary);
    back = front;
    if (state.lighting) {
        MaterialTable materials = MaterialTable(frame.materials);
        light_vertex(state, LightsTable(frame.lights), draw.lights,
            followed_material(state, materials.entries[draw.material].faces[0], 0u, color),
            followed_material(state, materials.entries[draw.material].faces[1], 1u, color), position, normal, front, back);
    }
    front = LitColors(clamp(front.primary, 0.0, 1.0), clamp(front.secondary, 0.0, 1.0));
    back = LitColors(clamp(back.primary, 0.0, 1.0), clamp(back.secondary, 0.0, 1.0));
}

// Size in pixels (OpenGL 1.5, section 3.3). Without antialiasing it is rounded, unless sprites are drawn.
float point_size(GlobalState state, Environment environment, float distance_eye) {
    float size = environment.point_size;
    if (state.point_attenuation) {
        float d = distance_eye;
        size *= inversesqrt(dot(environment.point_attenuation, vec3(1.0, d, d * d)));
    }
    size = clamp(size, environment.point_size_min, environment.point_size_max);
    return state.antialiased || state.point_sprite ? size : max(floor(size + 0.5), 1.0);
}

void main() {
    GlobalState state = specialized_global();
    UnitState units[TEXTURE_UNITS] = specialized_units();
    FrameRecord frame = FrameTable(push.frame).entries[0];
    DrawRecord draw = DrawTable(frame.draws).entries[gl_InstanceIndex];
    CurrentTable current = CurrentTable(frame.current);
    uint index = min(uint(gl_VertexIndex), draw.last_vertex);
    Words vertex = Words(draw.vertices + uint64_t(index) * (4u * layout_offset(VERTEX_LAYOUT, SLOTS)));

    vec4 position_object = fetch_attribute(vertex, VERTEX_LAYOUT, SLOT_POSITION, vec4(0.0, 0.0, 0.0, 1.0));
    vec4 color = fetch_attribute(vertex, VERTEX_LAYOUT, SLOT_COLOR, current.entries[draw.current].color);
    vec4 secondary = fetch_attribute(vertex, VERTEX_LAYOUT, SLOT_SECONDARY, current.entries[draw.current].secondary);
    vec3 normal_object = fetch_attribute(vertex, VERTEX_LAYOUT, SLOT_NORMAL, current.entries[draw.current].normal).xyz;

    TransformTable transforms = TransformTable(frame.transforms);
    vec4 clip = transforms.entries[draw.transform].modelview_projection * position_object;
#ifdef SKY_SIDE
    // The matrix leads to the world's axes about the eye.
    gl_Position = side_clip(uint(SKY_SIDE), clip.xyz);
#else
    gl_Position = vulkan_clip(clip);
#endif
    vec4 position_eye = transforms.entries[draw.transform].modelview * position_object;
    vec3 position = dehomogenized(position_eye);
    vec3 normal = normal_eye(state, transforms.entries[draw.transform].normal, normal_object);

    LitColors front;
    LitColors back;
    side_colors(state, frame, draw, color, secondary.rgb, position, normal, front, back);
    out_primary = front.primary;
    out_secondary = front.secondary;
    out_back_primary = back.primary;
    out_back_secondary = back.secondary;
#ifdef WITH_VISIBILITY
    // Materials are multiplied later.
    bool is_white = state.lighting || (push.pixels & WHITE_ALBEDO) != 0u
        || (push.pixels & BAKE_MASK) >> BAKE_SHIFT == BAKE_COLORS;
    out_albedo = is_white ? vec4(1.0) : clamp(color, 0.0, 1.0);
    out_flat_albedo = out_albedo;
#endif
    out_flat_primary = out_primary;
    out_flat_secondary = out_secondary;
    out_flat_back_primary = out_back_primary;
    out_flat_back_secondary = out_back_secondary;

    TexGenVertex generator = texgen_vertex(position_object, position_eye, position, normal);
    [[unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        out_coordinates[i] = vec4(0.0, 0.0, 0.0, 1.0);
        if (units[i].target != 0u) {
            vec4 given = current.entries[draw.current].texture[i].coefficients;
            vec4 coordinates = fetch_attribute(vertex, VERTEX_LAYOUT, SLOT_TEXTURE0 + i, given);
            if (units[i].gen != uvec4(GEN_OFF)) {
                coordinates = texgen(units[i], TexGenTable(frame.texgens).entries[draw.texgen].units[i], generator, coordinates);
            }
            if (units[i].matrix) {
                TextureMatricesTable matrices = TextureMatricesTable(frame.texture_matrices);
                coordinates = matrices.entries[draw.texture_matrices].units[i].columns * coordinates;
            }
            out_coordinates[i] = coordinates;
        }
    }

    float fog_attribute = fetch_attribute(vertex, VERTEX_LAYOUT, SLOT_FOG, current.entries[draw.current].fog).x;
    out_fog_coordinate = state.fog_coordinate ? fog_attribute : abs(position.z);

    out_point_size = 1.0;
    gl_PointSize = 1.0;
    if (TOPOLOGY == TOPOLOGY_POINTS) {
        Environment environment = EnvironmentTable(frame.environments).entries[draw.environment];
        out_point_size = point_size(state, environment, length(position));
        // An antialiased point covers in part pixels that its square would miss.
        gl_PointSize = state.antialiased && !state.point_sprite ? out_point_size + 1.0 : out_point_size;
    }
    if (TOPOLOGY != TOPOLOGY_TRIANGLES) {
        gl_Position.z += draw.depth_offset * gl_Position.w;
    }

#ifdef WITH_CLIP_PLANES
    [[unroll]] for (uint i = 0u; i < CLIP_PLANES; ++i) {
        vec4 plane = ClipPlanesTable(frame.clip_planes).entries[draw.clip_planes].planes[i].coefficients;
        gl_ClipDistance[i] = (state.clip_planes & (1u << i)) != 0u ? dot(plane, position_eye) : 1.0;
    }
#endif
}
