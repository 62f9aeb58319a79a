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

#include "denoise/history.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// How far from the plane of the middle a surface may lie, in distances between taps.
const float PLANE_TOLERANCE = 1.5;
// Standard deviations by which direct, indirect and specular light may differ; twice as many where one frame alone says what they are.
const vec3 DEVIATIONS = vec3(2.0, 2.5, 2.0);
// Share of a light below which what differs is not seen: nothing is filtered there.
const float UNSEEN = 4e-3;

// The variance of what is shown: before the first step, a sample's over the history's length.
vec3 variance_of(Lit light, GuideTexel guide) {
    vec3 variance = deviations(light) * deviations(light);
    return push.step == 1u ? variance / lengths_of(guide) : variance;
}

// Weight of a tap without what lies there.
float kernel(ivec2 offset) {
    return (offset.x == 0 ? 0.5 : 0.25) * (offset.y == 0 ? 0.5 : 0.25);
}

// The variances of what is shown around a texel, where they are single samples' still.
vec3 smoothed(ViewRecord view, ivec2 texel, GuideTexel guide, vec3 own) {
    vec3 sum = 0.25 * own;
    float weights = 0.25;
    [[dont_unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        ivec2 at = texel + offset;
        if (i == 4 || !is_in_light(view, at)) {
            continue;
        }
        uint tap = light_index(view, at);
        GuideTexel other = Guides(view.guides).entries[tap];
        if (is_same_class(guide, other)) {
            vec3 theirs = read_deviations(view, push.source, tap);
            sum += kernel(offset) * theirs * theirs / lengths_of(other);
            weights += kernel(offset);
        }
    }
    return sum / weights;
}

// By how much a direction counts for direct, indirect and specular light.
vec3 powers(float facing, float roughness) {
    float p2 = facing * facing;
    float p4 = p2 * p2;
    float p8 = p4 * p4;
    float p32 = p8 * p8 * p8 * p8;
    return vec3(p32, p8, mix(p32 * p32, p32, roughness));
}

// What goes for all taps of a texel.
struct Middle {
    GuideTexel guide;
    vec3 luminances;
    vec3 scale;     // of differences of luminance; below 0 where a channel is not filtered
    vec3 normal;
    vec3 across;    // along the normal, what a texel shows lies at its depth times a plane of the texel's place,
    float along;    // or, where pixels look side by side, at the sum of both
    float height;
    float tolerance;
    float roughness;
};

struct Sums {
    Lit light;
    vec3 weights;
    vec3 squares;  // of weights, times variances
    vec3 samples;  // variances by weight
};

// `kernel_weight` is 0 for a tap beyond the picture.
void add_tap(ViewRecord view, Middle middle, ivec2 at, GuideTexel other, PackedLit texel, float kernel_weight, inout Sums sums) {
    float from_plane = dot(middle.across, vec3(1.0, vec2(pixel_of_light(view, uvec2(at)))));
    from_plane = abs((middle.along == 0.0 ? from_plane * other.depth : from_plane + middle.along * other.depth) - middle.height);
    float near = is_same_class(middle.guide, other) ? kernel_weight * max(1.0 - from_plane * middle.tolerance, 0.0) : 0.0;
    vec3 weight = near * powers(max(dot(middle.normal, unpack_unit_vector(other.normal)), 0.0), middle.roughness);
    Lit light = unpack_lit(texel);
    weight *= exp2(-abs(luminances(light) - middle.luminances) * middle.scale);
    weight = mix(weight, vec3(0.0), lessThan(middle.scale, vec3(0.0)));
    vec3 variance = variance_of(light, other);
    add_lit(sums.light, light, weight);
    sums.weights += weight;
    sums.squares += weight * weight * variance;
    sums.samples += weight * variance;
}

// Adds three taps side by side: all that they read is asked for at once.
void add_row(ViewRecord view, Middle middle, ivec2 texel, int y, inout Sums sums) {
    GuideTexel guides[3];
    PackedLit texels[3];
    ivec2 places[3];
    float weights[3];
    [[unroll]] for (int i = 0; i < 3; ++i) {
        ivec2 offset = ivec2(i - 1, y);
        ivec2 at = texel + int(push.step) * offset;
        places[i] = clamp(at, ivec2(0), ivec2(light_size(view)) - 1);
        weights[i] = places[i] == at && offset != ivec2(0) ? kernel(offset) : 0.0;
        uint tap = light_index(view, places[i]);
        guides[i] = Guides(view.guides).entries[tap];
        texels[i] = read_packed(view, push.source, tap);
    }
    [[unroll]] for (int i = 0; i < 3; ++i) {
        add_tap(view, middle, places[i], guides[i], texels[i], weights[i], sums);
    }
}

Middle middle_of(ViewRecord view, ivec2 texel, GuideTexel guide, Lit light, vec3 own) {
    Middle middle;
    middle.guide = guide;
    middle.luminances = luminances(light);
    middle.normal = unpack_unit_vector(guide.normal);
    middle.across = vec3(dot(middle.normal, view.pixel_origin), dot(middle.normal, view.pixel_right), dot(middle.normal, view.pixel_down));
    middle.along = looks_parallel(view) ? dot(middle.normal, view.forward) : 0.0;
    float place = dot(middle.across, vec3(1.0, vec2(pixel_of_light(view, uvec2(texel)))));
    middle.height = middle.along == 0.0 ? place * guide.depth : place + middle.along * guide.depth;
    middle.tolerance = 1.0 / (PLANE_TOLERANCE * float(push.step) * seen_height(view, guide.depth) * view.light_step.y);
    middle.roughness = guide_roughness(guide);
    vec3 deviation = sqrt(push.step == 1u ? smoothed(view, texel, guide, own) : own);
    deviation *= DEVIATIONS * (1.0 + 1.0 / lengths_of(guide));
    bvec3 is_seen = greaterThan(deviation, UNSEEN * middle.luminances);
    // Highlights of smooth surfaces show what is mirrored, which no surface guides.
    bool has_specular = push.step == 1u || middle.roughness * middle.roughness * 32.0 >= float(push.step);
    is_seen.z = is_seen.z && has_specular;
    // Nine bits differ by five thousandths of themselves without a reason. Exponents are of 2.
    middle.scale = mix(vec3(-1.0), 1.4427 / (deviation + 5e-3 * middle.luminances + 1e-6), is_seen);
    return middle;
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_in_light(view, texel)) {
        return;
    }
    uint index = light_index(view, texel);
    GuideTexel guide = Guides(view.guides).entries[index];
    if (guide.depth == 0.0) {
        write_lit(view, push.target, index, no_light_there(), 0.5);
        if (push.step == 1u) {
            write_lit(view, view.history, index, no_light_there(), 0.5);
        }
        return;
    }
    Lit light = read_lit(view, push.source, index);
    vec3 own = variance_of(light, guide);
    Middle middle = middle_of(view, texel, guide, light, own);
    Sums sums = Sums(no_light_there(), vec3(0.25), 0.0625 * own, 0.25 * own);
    add_lit(sums.light, light, vec3(0.25));
    if (any(greaterThan(middle.scale, vec3(0.0)))) {
        [[dont_unroll]] for (int y = -1; y <= 1; ++y) {
            add_row(view, middle, texel, y, sums);
        }
        divide_lit(sums.light, sums.weights);
    } else {
        sums.light = light;
    }
    if (push.step == 1u) {
        // The history keeps the deviation of samples.
        vec3 lengths = lengths_of(guide);
        keep_history(view, index, light, sums.light, sqrt(sums.samples / sums.weights * lengths), lengths);
    }
    set_deviations(sums.light, sqrt(sums.squares) / sums.weights);
    write_lit(view, push.target, index, sums.light, 0.5);
}
