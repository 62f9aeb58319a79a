// One step of an a-trous filter over gradients, changes and luminances alike: what few samples say of one stratum, its neighbours say
// too. Changes keep their sign, so that those of surfaces which only move cancel out.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/gradients.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

const float KERNEL[3] = float[3](0.25, 0.125, 0.0625);

// The guide of a stratum's middle.
GuideTexel stratum_guide(ViewRecord view, ivec2 stratum) {
    ivec2 texel = min(stratum * int(STRATUM_EDGE) + 1, ivec2(light_size(view)) - 1);
    return Guides(view.guides).entries[light_index(view, texel)];
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    ivec2 stratum = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(strata_size(view));
    if (any(greaterThanEqual(stratum, size))) {
        return;
    }
    uint index = stratum_index(view, stratum);
    GuideTexel guide = stratum_guide(view, stratum);
    Gradient sum = read_gradient(push.source, index);
    sum.change *= KERNEL[0];
    sum.most *= KERNEL[0];
    float weights = KERNEL[0];
    [[dont_unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        ivec2 at = stratum + offset * int(push.step);
        if (i == 4 || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) {
            continue;
        }
        GuideTexel other = stratum_guide(view, at);
        if (!is_same_class(guide, other)) {
            continue;
        }
        // Loosely: a change of light rarely ends at an edge.
        float away = abs(other.depth - guide.depth) / max(max(other.depth, guide.depth), 1e-20);
        float weight = KERNEL[abs(offset.x) + abs(offset.y)] * max(1.0 - 2.0 * away, 0.0);
        Gradient gradient = read_gradient(push.source, stratum_index(view, at));
        sum.change += weight * gradient.change;
        sum.most += weight * gradient.most;
        weights += weight;
    }
    write_gradient(push.target, index, Gradient(sum.change / weights, sum.most / weights));
}
