// A triangle that covers the viewport, at the depth that is cleared to.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "generated/records.glsl"

layout(push_constant, scalar) uniform Push { ClearPush push; };

void main() {
    vec2 at = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    gl_Position = vec4(at * 4.0 - 1.0, push.depth, 1.0);
}
