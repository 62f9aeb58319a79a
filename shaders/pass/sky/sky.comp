// One level of the cube of the sky, a thread a texel of a side or of its border: the finest from what was drawn, others from the
// level before.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "pathtrace/color.glsl"
#include "pathtrace/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { SkyPush push; };

// How far beyond a side's edge it is that belongs to the next side.
const float BEYOND = 1.0 + 1e-4;

// What the program shows there; 0 in the fourth where it has drawn nothing. That was drawn in an earlier frame, or has a colour of
// its own.
vec4 drawn(uint side, uvec2 at) {
    vec4 stored = unpackUnorm4x8(Words(push.drawn).entries[(side * SKY_EDGE + at.y) * SKY_EDGE + at.x]);
    // Draws leave 0 there.
    if (stored.a == 0.0) {
        return vec4(linear_from_srgb(stored.rgb), 1.0);
    }
    // Another thread may be writing this texel: the same that is read.
    vec4 before = push.remembers != 0u ? SkyTexels(push.map).entries[sky_texel(0u, side, at + 1u)] : vec4(0.0);
    return before.a == 1.0 ? before : vec4(push.open, 0.0);
}

vec4 inner(uint side, uvec2 at) {
    if (push.level == 0u) {
        return drawn(side, at);
    }
    vec4 sum = vec4(0.0);
    [[unroll]] for (uint i = 0u; i < 4u; ++i) {
        sum += SkyTexels(push.map).entries[sky_texel(push.level - 1u, side, 2u * at + uvec2(i & 1u, i >> 1) + 1u)];
    }
    return sum * 0.25;
}

// The texel that a place beyond an edge lies on.
vec4 next_side(uint side, vec2 place, uint edge) {
    uint next;
    vec2 there = side_place(side_direction(side, place), next);
    return inner(next, min(uvec2((there * 0.5 + 0.5) * float(edge)), uvec2(edge - 1u)));
}

void main() {
    uint edge = SKY_EDGE >> push.level;
    uvec2 at = gl_GlobalInvocationID.xy;
    uint side = gl_GlobalInvocationID.z;
    if (any(greaterThanEqual(at, uvec2(edge + 2u)))) {
        return;
    }
    uvec2 within = clamp(at, uvec2(1u), uvec2(edge)) - 1u;
    vec2 place = (vec2(within) + 0.5) / float(edge) * 2.0 - 1.0;
    bvec2 is_beyond = notEqual(at, within + 1u);
    vec2 beyond = sign(place) * BEYOND;
    vec4 texel = vec4(0.0);
    float count = 0.0;
    // At a corner three sides meet.
    if (is_beyond.x) {
        texel += next_side(side, vec2(beyond.x, place.y), edge);
        ++count;
    }
    if (is_beyond.y) {
        texel += next_side(side, vec2(place.x, beyond.y), edge);
        ++count;
    }
    if (is_beyond.x == is_beyond.y) {
        texel += inner(side, within);
        ++count;
    }
    SkyTexels(push.map).entries[sky_texel(push.level, side, at)] = texel / count;
}
