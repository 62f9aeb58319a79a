// The packed state words as structures of what they say.
//
// Rasterization decodes words that are specialisation constants, so that all of it folds away; ray
// hits decode words that they have read.

#ifndef AFTERGLOW_FIXED_STATE_GLSL
#define AFTERGLOW_FIXED_STATE_GLSL

#include "../generated/state_words.glsl"

#define NORMALIZE_FULLY 2u

#define FOG_NONE 0u
#define FOG_LINEAR 1u
#define FOG_EXP 2u
#define FOG_EXP2 3u

#define COLOR_MATERIAL_AMBIENT_AND_DIFFUSE 0u
#define COLOR_MATERIAL_AMBIENT 1u
#define COLOR_MATERIAL_DIFFUSE 2u
#define COLOR_MATERIAL_SPECULAR 3u
#define COLOR_MATERIAL_EMISSION 4u

#define GEN_OFF 0u
#define GEN_OBJECT_LINEAR 1u
#define GEN_EYE_LINEAR 2u
#define GEN_SPHERE 3u
#define GEN_REFLECTION 4u
#define GEN_NORMAL 5u

#define COMPARE_NEVER 0u
#define COMPARE_LESS 1u
#define COMPARE_EQUAL 2u
#define COMPARE_LESS_EQUAL 3u
#define COMPARE_GREATER 4u
#define COMPARE_NOT_EQUAL 5u
#define COMPARE_GREATER_EQUAL 6u
#define COMPARE_ALWAYS 7u

#define DEPTH_MODE_LUMINANCE 0u
#define DEPTH_MODE_INTENSITY 1u
#define DEPTH_MODE_ALPHA 2u

// State outside the texture units.
struct GlobalState {
    bool lighting;
    uint normalize;
    uint color_material_faces; // 0 if nothing follows the colour
    uint color_material_mode;
    bool two_side;
    bool local_viewer;
    bool separate_specular;
    bool color_sum;
    bool flat_shade;
    uint fog_mode;
    bool fog_coordinate;
    uint alpha_func;
    bool point_sprite;
    bool antialiased;
    bool polygon_stipple;
    uint clip_planes;
    uint lights;
    uint positional;
    uint spots;
    bool point_attenuation;
};

// State of one texture unit.
struct UnitState {
    uint target;
    uint base_format;
    uint env_mode;
    uvec4 gen; // of s, t, r, q
    bool matrix;
    bool coord_replace;
    uint compare;
    uint depth_mode;
    uint combine_rgb;
    uint combine_alpha;
    uint scale_rgb;
    uint scale_alpha;
    uvec3 operand_rgb;
    uvec3 operand_alpha;
    uvec3 source_rgb;
    uvec3 source_alpha;
};

GlobalState decode_global(uint words[STATE_WORDS]) {
    GlobalState state;
    state.lighting = state_lighting(words[STATE_LIGHTING_WORD]) != 0u;
    state.normalize = state_normalize(words[STATE_NORMALIZE_WORD]);
    state.color_material_faces = state_color_material(words[STATE_COLOR_MATERIAL_WORD]) != 0u
        ? state_color_material_faces(words[STATE_COLOR_MATERIAL_FACES_WORD]) : 0u;
    state.color_material_mode = state_color_material_mode(words[STATE_COLOR_MATERIAL_MODE_WORD]);
    state.two_side = state_two_side(words[STATE_TWO_SIDE_WORD]) != 0u;
    state.local_viewer = state_local_viewer(words[STATE_LOCAL_VIEWER_WORD]) != 0u;
    state.separate_specular = state_separate_specular(words[STATE_SEPARATE_SPECULAR_WORD]) != 0u;
    state.color_sum = state_color_sum(words[STATE_COLOR_SUM_WORD]) != 0u;
    state.flat_shade = state_flat_shade(words[STATE_FLAT_SHADE_WORD]) != 0u;
    state.fog_mode = state_fog_mode(words[STATE_FOG_MODE_WORD]);
    state.fog_coordinate = state_fog_coordinate(words[STATE_FOG_COORDINATE_WORD]) != 0u;
    state.alpha_func = state_alpha_func(words[STATE_ALPHA_FUNC_WORD]);
    state.point_sprite = state_point_sprite(words[STATE_POINT_SPRITE_WORD]) != 0u;
    state.antialiased = state_smooth(words[STATE_SMOOTH_WORD]) != 0u;
    state.polygon_stipple = state_polygon_stipple(words[STATE_POLYGON_STIPPLE_WORD]) != 0u;
    state.clip_planes = state_clip_planes(words[STATE_CLIP_PLANES_WORD]);
    state.lights = state_lights(words[STATE_LIGHTS_WORD]);
    state.positional = state_positional(words[STATE_POSITIONAL_WORD]);
    state.spots = state_spots(words[STATE_SPOTS_WORD]);
    state.point_attenuation = state_point_attenuation(words[STATE_POINT_ATTENUATION_WORD]) != 0u;
    return state;
}

UnitState decode_unit(uint words[UNIT_WORDS]) {
    UnitState unit;
    unit.target = unit_target(words[UNIT_TARGET_WORD]);
    unit.base_format = unit_base_format(words[UNIT_BASE_FORMAT_WORD]);
    unit.env_mode = unit_env_mode(words[UNIT_ENV_MODE_WORD]);
    unit.gen = uvec4(unit_gen_s(words[UNIT_GEN_S_WORD]), unit_gen_t(words[UNIT_GEN_T_WORD]),
        unit_gen_r(words[UNIT_GEN_R_WORD]), unit_gen_q(words[UNIT_GEN_Q_WORD]));
    unit.matrix = unit_matrix(words[UNIT_MATRIX_WORD]) != 0u;
    unit.coord_replace = unit_coord_replace(words[UNIT_COORD_REPLACE_WORD]) != 0u;
    unit.compare = unit_compare(words[UNIT_COMPARE_WORD]);
    unit.depth_mode = unit_depth_mode(words[UNIT_DEPTH_MODE_WORD]);
    unit.combine_rgb = unit_combine_rgb(words[UNIT_COMBINE_RGB_WORD]);
    unit.combine_alpha = unit_combine_alpha(words[UNIT_COMBINE_ALPHA_WORD]);
    unit.scale_rgb = unit_scale_rgb(words[UNIT_SCALE_RGB_WORD]);
    unit.scale_alpha = unit_scale_alpha(words[UNIT_SCALE_ALPHA_WORD]);
    unit.operand_rgb = uvec3(unit_operand_rgb0(words[UNIT_OPERAND_RGB0_WORD]),
        unit_operand_rgb1(words[UNIT_OPERAND_RGB1_WORD]), unit_operand_rgb2(words[UNIT_OPERAND_RGB2_WORD]));
    unit.operand_alpha = uvec3(unit_operand_alpha0(words[UNIT_OPERAND_ALPHA0_WORD]),
        unit_operand_alpha1(words[UNIT_OPERAND_ALPHA1_WORD]), unit_operand_alpha2(words[UNIT_OPERAND_ALPHA2_WORD]));
    unit.source_rgb = uvec3(unit_source_rgb0(words[UNIT_SOURCE_RGB0_WORD]),
        unit_source_rgb1(words[UNIT_SOURCE_RGB1_WORD]), unit_source_rgb2(words[UNIT_SOURCE_RGB2_WORD]));
    unit.source_alpha = uvec3(unit_source_alpha0(words[UNIT_SOURCE_ALPHA0_WORD]),
        unit_source_alpha1(words[UNIT_SOURCE_ALPHA1_WORD]), unit_source_alpha2(words[UNIT_SOURCE_ALPHA2_WORD]));
    return unit;
}

// How the environment sees the base format of a depth texture.
uint effective_base_format(UnitState unit) {
    if (unit.base_format != BASE_FORMAT_DEPTH) {
        return unit.base_format;
    }
    return unit.depth_mode == DEPTH_MODE_INTENSITY ? BASE_FORMAT_INTENSITY
        : unit.depth_mode == DEPTH_MODE_ALPHA ? BASE_FORMAT_ALPHA : BASE_FORMAT_LUMINANCE;
}

// The numbers of comparisons are bits: 1 where less passes, 2 equal, 4 greater.
bool compare_passes(uint function, float incoming, float stored) {
    uint relation = incoming < stored ? 1u : incoming == stored ? 2u : 4u;
    return function == COMPARE_ALWAYS || (function & relation) != 0u;
}

#endif
