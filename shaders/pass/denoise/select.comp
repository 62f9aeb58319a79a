// Chooses of each stratum the texel of light that is traced with the numbers of the frame before (Schied, Peters and Dachsbacher,
// Gradient Estimation for Real-Time Adaptive Temporal Filtering, 2018): the one that was brightest, because light that has gone
// shows there. Texels are followed back to where they were, so that each stratum has its own sample wherever one can be.
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
    StratumTexel chosen = StratumTexel(NONE_CHOSEN, 0u, 0u);
    float brightest = -1.0;
    [[dont_unroll]] for (uint i = 0u; i < NONE_CHOSEN && view.guides_before != 0ul; ++i) {
        ivec2 texel = ivec2(STRATUM_EDGE * stratum + uvec2(i % STRATUM_EDGE, i / STRATUM_EDGE));
        if (!is_in_light(view, texel)) {
            continue;
        }
        GuideTexel guide = Guides(view.guides).entries[light_index(view, texel)];
        uint before;
        if (guide.depth == 0.0 || !texel_before(view, texel, guide, before)) {
            continue;
        }
        uint word = Luminances(view.luminances).entries[before].word;
        vec3 luminance = unpack_luminances(word);
        float brightness = luminance.x + luminance.y + luminance.z;
        // Numbers that were old then are not known any more.
        if (!was_again(word) && brightness > brightest) {
            brightest = brightness;
            chosen = StratumTexel(i, before, word);
        }
    }
    Strata(view.strata).entries[stratum_index(view, ivec2(stratum))] = chosen;
}
