// Reverses the rows of rectangles of texels: the frame buffer has its highest row first, textures
// their lowest. One workgroup a rectangle.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "generated/records.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Texels { uint entries[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Records { FlipRecord entries[]; };

layout(push_constant, scalar) uniform Push { FlipPush push; };

void main() {
    FlipRecord record = Records(push.records).entries[push.first + gl_WorkGroupID.x];
    for (uint index = gl_LocalInvocationID.x; index < record.width * record.height; index += gl_WorkGroupSize.x) {
        uint row = index / record.width;
        uint column = index - row * record.width;
        uint texel = Texels(record.source).entries[index];
        if (push.depth_maximum != 0u) {
            texel = floatBitsToUint(float(texel & push.depth_maximum) / float(push.depth_maximum));
        }
        Texels(record.target).entries[(record.height - 1u - row) * record.width + column] = texel;
    }
}
