// Written by afterglow-gen (./x gen) from the declarations in Rust; not to be edited.
#ifndef GENERATED_STATE_WORDS
#define GENERATED_STATE_WORDS

#define TEXTURE_UNITS 4
#define LIGHTS 8
#define CLIP_PLANES 6
#define SLOTS 9

// State outside the texture units: words 0 and up of all state words.
#define STATE_WORDS 2
#define STATE_LIGHTING_WORD 0
#define state_lighting(w) (((w) >> 0) & 0x1u)
#define STATE_NORMALIZE_WORD 0
#define state_normalize(w) (((w) >> 1) & 0x3u)
#define STATE_COLOR_MATERIAL_WORD 0
#define state_color_material(w) (((w) >> 3) & 0x1u)
#define STATE_COLOR_MATERIAL_FACES_WORD 0
#define state_color_material_faces(w) (((w) >> 4) & 0x3u)
#define STATE_COLOR_MATERIAL_MODE_WORD 0
#define state_color_material_mode(w) (((w) >> 6) & 0x7u)
#define STATE_TWO_SIDE_WORD 0
#define state_two_side(w) (((w) >> 9) & 0x1u)
#define STATE_LOCAL_VIEWER_WORD 0
#define state_local_viewer(w) (((w) >> 10) & 0x1u)
#define STATE_SEPARATE_SPECULAR_WORD 0
#define state_separate_specular(w) (((w) >> 11) & 0x1u)
#define STATE_COLOR_SUM_WORD 0
#define state_color_sum(w) (((w) >> 12) & 0x1u)
#define STATE_FLAT_SHADE_WORD 0
#define state_flat_shade(w) (((w) >> 13) & 0x1u)
#define STATE_FOG_MODE_WORD 0
#define state_fog_mode(w) (((w) >> 14) & 0x3u)
#define STATE_FOG_COORDINATE_WORD 0
#define state_fog_coordinate(w) (((w) >> 16) & 0x1u)
#define STATE_ALPHA_FUNC_WORD 0
#define state_alpha_func(w) (((w) >> 17) & 0x7u)
#define STATE_POINT_SPRITE_WORD 0
#define state_point_sprite(w) (((w) >> 20) & 0x1u)
#define STATE_SMOOTH_WORD 0
#define state_smooth(w) (((w) >> 21) & 0x1u)
#define STATE_POLYGON_STIPPLE_WORD 0
#define state_polygon_stipple(w) (((w) >> 22) & 0x1u)
#define STATE_CLIP_PLANES_WORD 0
#define state_clip_planes(w) (((w) >> 23) & 0x3fu)
#define STATE_LIGHTS_WORD 1
#define state_lights(w) (((w) >> 0) & 0xffu)
#define STATE_POSITIONAL_WORD 1
#define state_positional(w) (((w) >> 8) & 0xffu)
#define STATE_SPOTS_WORD 1
#define state_spots(w) (((w) >> 16) & 0xffu)
#define STATE_POINT_ATTENUATION_WORD 1
#define state_point_attenuation(w) (((w) >> 24) & 0x1u)

// State of one texture unit, from word UNIT_FIRST_WORD(unit) of all state words.
#define UNIT_WORDS 3
#define UNIT_TARGET_WORD 0
#define unit_target(w) (((w) >> 0) & 0x3u)
#define UNIT_BASE_FORMAT_WORD 0
#define unit_base_format(w) (((w) >> 2) & 0x7u)
#define UNIT_ENV_MODE_WORD 0
#define unit_env_mode(w) (((w) >> 5) & 0x7u)
#define UNIT_GEN_S_WORD 0
#define unit_gen_s(w) (((w) >> 8) & 0x7u)
#define UNIT_GEN_T_WORD 0
#define unit_gen_t(w) (((w) >> 11) & 0x7u)
#define UNIT_GEN_R_WORD 0
#define unit_gen_r(w) (((w) >> 14) & 0x7u)
#define UNIT_GEN_Q_WORD 0
#define unit_gen_q(w) (((w) >> 17) & 0x7u)
#define UNIT_MATRIX_WORD 0
#define unit_matrix(w) (((w) >> 20) & 0x1u)
#define UNIT_COORD_REPLACE_WORD 0
#define unit_coord_replace(w) (((w) >> 21) & 0x1u)
#define UNIT_COMPARE_WORD 0
#define unit_compare(w) (((w) >> 22) & 0xfu)
#define UNIT_DEPTH_MODE_WORD 0
#define unit_depth_mode(w) (((w) >> 26) & 0x3u)
#define UNIT_COMBINE_RGB_WORD 1
#define unit_combine_rgb(w) (((w) >> 0) & 0x7u)
#define UNIT_COMBINE_ALPHA_WORD 1
#define unit_combine_alpha(w) (((w) >> 3) & 0x7u)
#define UNIT_SCALE_RGB_WORD 1
#define unit_scale_rgb(w) (((w) >> 6) & 0x3u)
#define UNIT_SCALE_ALPHA_WORD 1
#define unit_scale_alpha(w) (((w) >> 8) & 0x3u)
#define UNIT_OPERAND_RGB0_WORD 1
#define unit_operand_rgb0(w) (((w) >> 10) & 0x3u)
#define UNIT_OPERAND_RGB1_WORD 1
#define unit_operand_rgb1(w) (((w) >> 12) & 0x3u)
#define UNIT_OPERAND_RGB2_WORD 1
#define unit_operand_rgb2(w) (((w) >> 14) & 0x3u)
#define UNIT_OPERAND_ALPHA0_WORD 1
#define unit_operand_alpha0(w) (((w) >> 16) & 0x1u)
#define UNIT_OPERAND_ALPHA1_WORD 1
#define unit_operand_alpha1(w) (((w) >> 17) & 0x1u)
#define UNIT_OPERAND_ALPHA2_WORD 1
#define unit_operand_alpha2(w) (((w) >> 18) & 0x1u)
#define UNIT_SOURCE_RGB0_WORD 2
#define unit_source_rgb0(w) (((w) >> 0) & 0xfu)
#define UNIT_SOURCE_RGB1_WORD 2
#define unit_source_rgb1(w) (((w) >> 4) & 0xfu)
#define UNIT_SOURCE_RGB2_WORD 2
#define unit_source_rgb2(w) (((w) >> 8) & 0xfu)
#define UNIT_SOURCE_ALPHA0_WORD 2
#define unit_source_alpha0(w) (((w) >> 12) & 0xfu)
#define UNIT_SOURCE_ALPHA1_WORD 2
#define unit_source_alpha1(w) (((w) >> 16) & 0xfu)
#define UNIT_SOURCE_ALPHA2_WORD 2
#define unit_source_alpha2(w) (((w) >> 20) & 0xfu)
#define UNIT_FIRST_WORD(unit) (STATE_WORDS + UNIT_WORDS * (unit))
#define ALL_STATE_WORDS 14

// Layout of a vertex: 3 bits of FORMAT a slot.
#define layout_format(w, slot) (((w) >> (3u * (slot))) & 7u)

#define BASE_FORMAT_ALPHA 0u
#define BASE_FORMAT_LUMINANCE 1u
#define BASE_FORMAT_LUMINANCE_ALPHA 2u
#define BASE_FORMAT_INTENSITY 3u
#define BASE_FORMAT_RGB 4u
#define BASE_FORMAT_RGBA 5u
#define BASE_FORMAT_DEPTH 6u

#define ENV_MODE_MODULATE 0u
#define ENV_MODE_DECAL 1u
#define ENV_MODE_BLEND 2u
#define ENV_MODE_REPLACE 3u
#define ENV_MODE_ADD 4u
#define ENV_MODE_COMBINE 5u

#define COMBINE_REPLACE 0u
#define COMBINE_MODULATE 1u
#define COMBINE_ADD 2u
#define COMBINE_ADD_SIGNED 3u
#define COMBINE_INTERPOLATE 4u
#define COMBINE_SUBTRACT 5u
#define COMBINE_DOT3_RGB 6u
#define COMBINE_DOT3_RGBA 7u

#define COMBINE_SOURCE_PREVIOUS 0u
#define COMBINE_SOURCE_TEXTURE 1u
#define COMBINE_SOURCE_CONSTANT 2u
#define COMBINE_SOURCE_PRIMARY 3u
#define COMBINE_SOURCE_ZERO 4u
#define COMBINE_SOURCE_ONE 5u
#define COMBINE_SOURCE_TEXTURE0 8u

#define TARGET_D2 1u
#define TARGET_D3 2u
#define TARGET_CUBE 3u

#define SLOT_POSITION 0u
#define SLOT_NORMAL 1u
#define SLOT_COLOR 2u
#define SLOT_SECONDARY 3u
#define SLOT_FOG 4u
#define SLOT_TEXTURE0 5u

#define FORMAT_ABSENT 0u
#define FORMAT_F1 1u
#define FORMAT_F2 2u
#define FORMAT_F3 3u
#define FORMAT_F4 4u
#define FORMAT_UNORM8X4 5u

#endif
