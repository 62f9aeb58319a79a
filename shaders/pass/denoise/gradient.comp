// The change of light of each stratum's chosen texel: same place, same numbers, so it is not noise.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/channels.glsl"
#include "denoise/gradients.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uvec2 stratum = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(stratum, strata_size(view)))) {
        return;
    }
    uint index = stratum_index(view, ivec2(stratum));
    StratumTexel chosen = Strata(view.strata).entries[index];
    Gradient gradient = Gradient(vec3(0.0), vec3(0.0));
    if (chosen.chosen != NONE_CHOSEN) {
        uvec2 texel = STRATUM_EDGE * stratum + uvec2(chosen.chosen % STRATUM_EDGE, chosen.chosen / STRATUM_EDGE);
        vec3 now = unpack_luminances(Luminances(view.luminances).entries[light_index(view, ivec2(texel))].word);
        vec3 before = unpack_luminances(chosen.luminance);
        gradient = Gradient(now - before, max(now, before));
    }
    write_gradient(push.target, index, gradient);
}
