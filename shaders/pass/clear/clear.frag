// The colour that is cleared to.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "generated/records.glsl"

layout(push_constant, scalar) uniform Push { ClearPush push; };

layout(location = 0) out vec4 out_color;

void main() {
    out_color = push.color;
}
