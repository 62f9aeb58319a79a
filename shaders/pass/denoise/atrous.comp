// One step of an edge-avoiding a-trous filter (Dammertz and others, HPG 2010) over all channels at once. Surfaces guide it, and light by
// how much it is known to differ from sample to sample: what differs by more than that is no noise. Both bands of indirect light are
// mixed, so that what faces a little aside helps and yet no edge between normals is lost.
//
// The first step also makes the history: what it has filtered where that is short, and what was gathered alone where it is long, which
// would be blurred anew in each frame. The history keeps the deviation of samples; between steps it is that of what is shown.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/channels.glsl"
#include "denoise/guide.glsl"
#include "pathtrace/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Weights of taps by how many of x and y are not 0.
const float KERNEL[3] = float[3](0.25, 0.125, 0.0625);
// How far from the plane of the middle a surface may lie, in distances between taps.
const float PLANE_TOLERANCE = 1.5;
// Standard deviations by which direct, indirect and specular light may differ; twice as many where one frame alone says what they are.
const vec3 DEVIATIONS = vec3(2.0, 2.5, 2.0);
// Frames from which on a history holds nothing filtered, and frames up to which it holds nothing else.
const float LONG = 12.0;
const float SHORT = 4.0;

vec3 lengths_of(GuideTexel guide) {
    return vec3(max(guide_lengths(guide), uvec3(1u)));
}

// The deviation of what is shown: before the first step, a sample's over the root of the history's length.
vec3 known_to(Lit light, GuideTexel guide) {
    return push.step == 1u ? deviations(light) * inversesqrt(lengths_of(guide)) : deviations(light);
}

// The middle's deviations, those around it taken in where they are single samples' still.
vec3 smoothed(ViewRecord view, ivec2 texel, GuideTexel guide, vec3 own) {
    vec3 sum = own * own * KERNEL[0];
    float weights = KERNEL[0];
    [[dont_unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        ivec2 at = texel + offset;
        if (i == 4 || !is_in_light(view, at)) {
            continue;
        }
        uint tap = light_index(view, at);
        GuideTexel other = Guides(view.guides).entries[tap];
        if (!is_same_class(guide, other)) {
            continue;
        }
        vec3 theirs = known_to(read_lit(view, push.source, tap), other);
        float weight = KERNEL[abs(offset.x) + abs(offset.y)];
        sum += weight * theirs * theirs;
        weights += weight;
    }
    return sqrt(sum / weights);
}

vec3 powers(float facing, float roughness) {
    float p2 = facing * facing;
    float p4 = p2 * p2;
    float p8 = p4 * p4;
    float p32 = p8 * p8 * p8 * p8;
    return vec3(p32, p8, mix(p32 * p32, p32, roughness));
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_in_light(view, texel)) {
        return;
    }
    uint index = light_index(view, texel);
    GuideTexel guide = Guides(view.guides).entries[index];
    Lit middle = read_lit(view, push.source, index);
    if (guide.depth == 0.0) {
        write_lit(view, push.target, index, middle, 0.5);
        if (push.step == 1u) {
            write_lit(view, view.history, index, middle, 0.5);
        }
        return;
    }
    vec3 normal = unpack_unit_vector(guide.normal);
    vec3 position = seen_position(view, vec2(pixel_of_light(view, uvec2(texel))), guide.depth);
    // Along the normal, what a texel shows lies at its depth times a plane of the texel's place, or at the sum of both.
    vec3 across = vec3(dot(normal, view.pixel_origin), dot(normal, view.pixel_right), dot(normal, view.pixel_down));
    float along = looks_parallel(view) ? dot(normal, view.forward) : 0.0;
    float height = dot(normal, position);
    float tolerance = 1.0 / (PLANE_TOLERANCE * float(push.step) * seen_height(view, guide.depth) * view.light_step.y);
    float roughness = guide_roughness(guide);
    vec3 own = known_to(middle, guide);
    vec3 deviation = push.step == 1u ? smoothed(view, texel, guide, own) : own;
    vec3 brightness = luminances(middle);
    // Half floats differ by a thousandth of themselves without a reason.
    vec3 scale = 1.0 / (DEVIATIONS * (1.0 + 1.0 / lengths_of(guide)) * deviation + 2e-3 * brightness + 1e-6);
    Lit sum = no_light_there();
    vec3 weights = vec3(KERNEL[0]);
    vec3 squares = own * own * KERNEL[0] * KERNEL[0];
    vec3 samples = deviations(middle) * deviations(middle) * KERNEL[0];
    add_lit(sum, middle, weights);
    // Highlights of smooth surfaces show what is mirrored, which no surface guides.
    float specular_reach = push.step > 1u && roughness * roughness * 32.0 < float(push.step) ? 0.0 : 1.0;
    [[dont_unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        ivec2 at = texel + offset * int(push.step);
        if (i == 4 || !is_in_light(view, at)) {
            continue;
        }
        uint tap = light_index(view, at);
        GuideTexel other = Guides(view.guides).entries[tap];
        if (!is_same_class(guide, other)) {
            continue;
        }
        float place = dot(across, vec3(1.0, vec2(pixel_of_light(view, uvec2(at)))));
        float from_plane = abs((along == 0.0 ? place * other.depth : place + along * other.depth) - height);
        float facing = max(dot(normal, unpack_unit_vector(other.normal)), 0.0);
        float near = KERNEL[abs(offset.x) + abs(offset.y)] * max(1.0 - from_plane * tolerance, 0.0);
        if (!(near * facing > 0.0)) {
            continue;
        }
        Lit light = read_lit(view, push.source, tap);
        vec3 weight = near * powers(facing, roughness) * exp(-abs(luminances(light) - brightness) * scale);
        weight.z *= specular_reach;
        vec3 theirs = known_to(light, other);
        add_lit(sum, light, weight);
        weights += weight;
        squares += weight * weight * theirs * theirs;
        samples += weight * deviations(light) * deviations(light);
    }
    divide_lit(sum, weights);
    if (push.step == 1u) {
        Lit kept = mixed(middle, sum, clamp((LONG - lengths_of(guide)) / (LONG - SHORT), 0.0, 1.0));
        set_deviations(kept, sqrt(samples / weights));
        float random = float(hash(index ^ hash(view.frame_number + 0x51edu)) >> 8) / 16777216.0;
        write_lit(view, view.history, index, kept, random);
    }
    set_deviations(sum, sqrt(squares) / weights);
    write_lit(view, push.target, index, sum, 0.5);
}
