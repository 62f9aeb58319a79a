// Exposure: what makes the traced picture as bright as the program's own, moved there smoothly.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/tables.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

const float LEAST = 0.25;
const float MOST = 4.0;

shared vec2 sums[64];

float scale_for(float traced, float program) {
    return traced > 0.0 && program > 0.0 ? clamp(program / traced, LEAST, MOST) : 1.0;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uint thread = gl_LocalInvocationIndex;
    vec2 sum = vec2(0.0);
    for (uint i = thread; i < view.sum_count; i += 64u) {
        ExposureSum part = ExposureSums(view.sums).entries[i];
        sum += vec2(part.traced, part.program);
    }
    sums[thread] = sum;
    barrier();
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1) {
        if (thread < half_count) {
            sums[thread] += sums[thread + half_count];
        }
        barrier();
    }
    if (thread == 0u) {
        float now = scale_for(sums[0].x, sums[0].y);
        ExposureBuffer exposure = ExposureBuffer(view.exposure);
        float before = view.exposure_rate < 1.0 ? exposure.entries[0].scale : now;
        exposure.entries[0].scale = before * pow(now / before, view.exposure_rate);
    }
}
