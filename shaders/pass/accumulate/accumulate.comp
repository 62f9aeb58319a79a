// Operations of the accumulation buffer (OpenGL 1.5, section 4.2.4). One invocation a pixel.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "generated/records.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Accumulated { vec4 entries[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Colors { uint entries[]; };

layout(push_constant, scalar) uniform Push { AccumulatePush push; };

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uvec2 size = uvec2(push.rectangle[2], push.rectangle[3]);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    uint at = (push.rectangle[1] + pixel.y) * push.pitch + push.rectangle[0] + pixel.x;
    uint color = pixel.y * size.x + pixel.x;
    vec4 accumulated = Accumulated(push.accumulation).entries[at];
    switch (push.operation) {
        case ACCUMULATE_ACCUMULATE:
            accumulated += push.value * unpackUnorm4x8(Colors(push.colors).entries[color]);
            break;
        case ACCUMULATE_LOAD: accumulated = push.value * unpackUnorm4x8(Colors(push.colors).entries[color]); break;
        case ACCUMULATE_MULTIPLY: accumulated *= push.value; break;
        case ACCUMULATE_ADD: accumulated += push.value; break;
        case ACCUMULATE_CLEAR: accumulated = push.clear; break;
        default:
            Colors(push.colors).entries[color] = packUnorm4x8(accumulated * push.value);
            return;
    }
    Accumulated(push.accumulation).entries[at] = clamp(accumulated, -1.0, 1.0);
}
