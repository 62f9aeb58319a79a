// Finds the texels of light of which little is known: the frame before did not show them, or their history has just begun. How many there
// are says how many samples more each of them may have.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/guide.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Frames up to which a history is short.
const uint SHORT = 3u;

shared uint needy_texels;

bool is_needy(ViewRecord view, ivec2 texel) {
    if (!is_in_light(view, texel)) {
        return false;
    }
    GuideTexel guide = Guides(view.guides).entries[light_index(view, texel)];
    if (guide.depth == 0.0) {
        return false;
    }
    uint before;
    if (!texel_before(view, texel, guide, before)) {
        return true;
    }
    uvec3 lengths = guide_lengths(Guides(view.guides_before).entries[before]);
    return min(lengths.x, min(lengths.y, lengths.z)) <= SHORT;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    needy_texels = 0u;
    barrier();
    // A first frame has need everywhere, and nothing to spare.
    if (view.guides_before != 0ul && is_needy(view, texel)) {
        uint index = light_index(view, texel);
        Guides(view.guides).entries[index].bits |= NEEDY_BIT;
        atomicAdd(needy_texels, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && needy_texels != 0u) {
        atomicAdd(Counters(view.counters).entries[0].needy, needy_texels);
    }
}
