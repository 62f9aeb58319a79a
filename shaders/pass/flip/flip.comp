// Reverses the rows of rectangles of texels: the frame buffer has its highest row first, textures
// their lowest. Where both have different sizes, a texel is the one at its centre. One workgroup a record.
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

// Of `from` texels the one at the centre of texel `index` of `to`.
uint nearest(uint index, uint from, uint to) {
    return from == to ? index : (2u * index + 1u) * from / (2u * to);
}

void main() {
    FlipRecord record = Records(push.records).entries[push.first + gl_WorkGroupID.x];
    for (uint index = gl_LocalInvocationID.x; index < record.width * record.rows; index += gl_WorkGroupSize.x) {
        uint row = index / record.width;
        uint column = index - row * record.width;
        row += record.first_row;
        uint source_row = record.source_height - 1u - nearest(row, record.source_height, record.height);
        uint source_column = nearest(column, record.source_width, record.width);
        uint texel = Texels(record.source).entries[source_row * record.source_width + source_column];
        if (push.depth_maximum != 0u) {
            texel = floatBitsToUint(float(texel & push.depth_maximum) / float(push.depth_maximum));
        }
        Texels(record.target).entries[row * record.width + column] = texel;
    }
}
