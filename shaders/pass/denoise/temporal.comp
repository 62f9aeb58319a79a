// Adds a frame's light to what earlier frames have gathered of the same surfaces (Schied and others, Spatiotemporal Variance-Guided
// Filtering, HPG 2017), and learns how much each sample differs: a running variance, which has no difference of large numbers in it.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/channels.glsl"
#include "denoise/gradients.glsl"
#include "denoise/history.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Frames below which neighbours say better than the texel's own history how much samples differ.
const float FEW = 4.0;
// Roughness from which on highlights stay where the surface is, and below which they move with what they mirror.
const float ROUGH = 0.5;

// What the frames before have left where a texel was.
struct Past {
    Lit light;
    vec3 lengths; // frames that it was gathered over; 0 if nothing is left
};

// Between the four texels of the frame before around a place, of those that show the same surface.
Past past_at(ViewRecord view, vec2 place, GuideTexel guide, float depth, float slope) {
    Past past = Past(no_light_there(), vec3(0.0));
    ivec2 first = ivec2(floor(place));
    vec2 share = place - vec2(first);
    float weights = 0.0;
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 texel = first + corner;
        vec2 nearness = mix(1.0 - share, share, vec2(corner));
        float weight = nearness.x * nearness.y;
        if (!(weight > 1e-3) || !is_in_light(view, texel)) {
            continue;
        }
        uint index = light_index(view, texel);
        GuideTexel before = Guides(view.guides_before).entries[index];
        if (!shows_same(guide, before, depth, slope)) {
            continue;
        }
        add_lit(past.light, read_lit(view, view.history, index), vec3(weight));
        past.lengths += weight * vec3(guide_lengths(before));
        weights += weight;
    }
    if (!(weights > 0.01)) {
        return Past(no_light_there(), vec3(0.0));
    }
    divide_lit(past.light, vec3(weights));
    past.lengths /= weights;
    return past;
}

// Where a mirrored thing was seen in the frame before: its image lies behind the surface, as far as it is before it.
bool mirrored_place(ViewRecord view, ivec2 texel, GuideTexel guide, float reflected, out vec2 place) {
    vec3 surface = seen_position(view, vec2(pixel_of_light(view, uvec2(texel))), guide.depth);
    vec3 image = surface - to_eye(view, surface) * reflected;
    vec2 pixel;
    bool is_before = place_before(view, image, pixel);
    place = pixel / view.light_step - 0.5;
    return is_before;
}

// Variance of luminance among the noisy texels around one that show the same surface.
vec3 spread_around(ViewRecord view, ivec2 texel, GuideTexel guide, float slope) {
    vec3 sum = vec3(0.0);
    vec3 squares = vec3(0.0);
    float count = 0.0;
    vec3 middle = luminances(read_lit(view, view.noisy, light_index(view, texel)));
    [[dont_unroll]] for (int i = 0; i < 25; ++i) {
        ivec2 at = texel + ivec2(i % 5, i / 5) - 2;
        if (!is_in_light(view, at)) {
            continue;
        }
        uint index = light_index(view, at);
        GuideTexel other = Guides(view.guides).entries[index];
        if (!is_same_class(guide, other) || abs(other.depth - guide.depth) > 4.0 * slope) {
            continue;
        }
        // Differences to one of them: large numbers that are alike leave no rest.
        vec3 away = luminances(read_lit(view, view.noisy, index)) - middle;
        sum += away;
        squares += away * away;
        count += 1.0;
    }
    vec3 mean = sum / max(count, 1.0);
    return max(squares / max(count, 1.0) - mean * mean, 0.0);
}

// Takes a sample into a mean and into the variance of samples.
vec4 taken_in(vec4 past, vec3 now, float share) {
    float away = luminance(now) - luminance(past.rgb);
    float variance = (1.0 - share) * (past.w * past.w + share * away * away);
    return vec4(mix(past.rgb, now, share), sqrt(variance));
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
        return;
    }
    float slope = depth_slope(view, texel, guide);
    MotionTexel motion = Motions(view.motions).entries[index];
    Lit noisy = read_lit(view, view.noisy, index);
    Past past = Past(no_light_there(), vec3(0.0));
    if (motion.depth > 0.0) {
        past = past_at(view, vec2(texel) + unpackHalf2x16(motion.offset), guide, motion.depth, slope);
        float roughness = guide_roughness(guide);
        vec2 place;
        if (roughness < ROUGH && noisy.towards.w > 0.0 && mirrored_place(view, texel, guide, noisy.towards.w, place)) {
            // The surface there is another part of the same one: it may be as far away as it likes.
            Past image = past_at(view, place, guide, motion.depth, slope + 0.1 * motion.depth);
            float share = image.lengths.z > 0.0 ? 1.0 - roughness / ROUGH : 0.0;
            past.light.specular = mix(past.light.specular, image.light.specular, share);
            past.light.towards.w = mix(past.light.towards.w, image.light.towards.w, share);
            past.lengths.z = mix(past.lengths.z, image.lengths.z, share);
        }
    }
    vec3 share = 1.0 / (min(past.lengths, view.longest - 1.0) + 1.0);
    if (view.gradients != 0ul) {
        // What was traced with older numbers is known already, and was chosen for its brightness: it says only what has changed.
        bool is_again = was_again(Luminances(view.luminances).entries[index].word);
        share = is_again ? share * vec3(equal(past.lengths, vec3(0.0))) : share;
        share = mix(share, vec3(1.0), disbelief(view, uvec2(texel)));
    }
    Lit light;
    light.direct = taken_in(past.light.direct, noisy.direct.rgb, share.x);
    light.indirect = taken_in(past.light.indirect, noisy.indirect.rgb, share.y);
    light.specular = taken_in(past.light.specular, noisy.specular.rgb, share.z);
    light.towards = mix(past.light.towards, noisy.towards, vec4(share.yyy, noisy.towards.w > 0.0 ? share.z : 0.0));
    vec3 lengths = min(1.0 / max(share, 1e-3), past.lengths + 1.0);
    if (any(lessThan(lengths, vec3(FEW)))) {
        vec3 own = deviations(light);
        vec3 around = sqrt(spread_around(view, texel, guide, slope));
        set_deviations(light, mix(own, max(own, around), vec3(lessThan(lengths, vec3(FEW)))));
    }
    float random = rounding_number(view, index, 0u);
    write_lit(view, push.target, index, light, random);
    Guides(view.guides).entries[index].bits = with_lengths(guide.bits, uvec3(lengths + random));
}
