// A bottom level whose triangles moved, first step: its leaf records get the new corners, bit for bit.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "refit.glsl"

void main() {
    uint number = push.first + gl_GlobalInvocationID.x;
    if (number >= push.first + push.count) {
        return;
    }
    Words record = Words(push.structure + uint64_t(push.nodes * NODE_BYTES) + uint64_t(number * RECORD_BYTES));
    Words corners = Words(push.corners + uint64_t(Words(push.sources).entries[number]) * 36ul);
    for (uint i = 0u; i < 9u; ++i) {
        record.entries[i] = corners.entries[i];
    }
}
