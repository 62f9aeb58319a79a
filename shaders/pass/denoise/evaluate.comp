// Makes light of fits to what surfaces are (regress.comp): each texel's is mixed of the four blocks about it, so that no border shows.
// What differs from that by more than noise, such as the edges of shadows, is kept as it was gathered.
//
// The history is what was gathered; where that is short, what is shown.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/fits.glsl"
#include "denoise/history.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Texels to each side over which it is averaged what differs from the fit.
#define REACH 2
#define TILE_EDGE (16 + 2 * REACH)

// How much of that is noise, in variances of what was gathered.
const float NOISE = 1.5;
// Squares of what differs, by channels, and how great noise makes them.
shared float squares[3 * TILE_EDGE * TILE_EDGE];
shared float noises[3 * TILE_EDGE * TILE_EDGE];
shared uint kinds[TILE_EDGE * TILE_EDGE];

void add_fit(ViewRecord view, ivec2 block, Point point, float share, inout Lit sum) {
    uint fit = fit_index(view, block, point.kind);
    Scaling scaling = Scaling(Fits(view.fits).entries[fit].normal, Fits(view.fits).entries[fit].position,
        Fits(view.fits).entries[fit].scale);
    float features[FEATURES] = features_of(point, scaling);
    [[unroll]] for (uint i = 0u; i < FEATURES; ++i) {
        float much = share * features[i];
        sum.direct.rgb += much * Fits(view.fits).entries[fit].features[i].direct;
        sum.indirect.rgb += much * Fits(view.fits).entries[fit].features[i].indirect;
        sum.specular.rgb += much * Fits(view.fits).entries[fit].features[i].specular;
        sum.towards.xyz += much * Fits(view.fits).entries[fit].features[i].towards;
    }
}

// What the fits make of a texel's light. Deviations, and what is not fitted, stay.
Lit fitted(ViewRecord view, ivec2 texel, Point point, Lit light) {
    vec2 at = (vec2(texel - first_middle(view)) + 0.5) / float(BLOCK_STEP);
    ivec2 first = ivec2(floor(at));
    vec2 share = at - vec2(first);
    Lit sum = no_light_there();
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 nearness = mix(1.0 - share, share, vec2(corner));
        add_fit(view, first + corner, point, nearness.x * nearness.y, sum);
    }
    light.direct.rgb = max(sum.direct.rgb, 0.0);
    light.indirect.rgb = max(sum.indirect.rgb, 0.0);
    light.specular.rgb = max(sum.specular.rgb, 0.0);
    light.towards.xyz = sum.towards.xyz;
    return light;
}

// How far the light of the workgroup's texels, and of those about them, is from the fits.
void find_squares(ViewRecord view) {
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * 16 - REACH;
    [[dont_unroll]] for (uint number = gl_LocalInvocationIndex; number < uint(TILE_EDGE * TILE_EDGE); number += 256u) {
        ivec2 texel = corner + ivec2(number % uint(TILE_EDGE), number / uint(TILE_EDGE));
        Point point = point_at(view, texel);
        vec3 away = vec3(0.0);
        vec3 deviation = vec3(0.0);
        if (point.kind != 0u) {
            Lit light = read_lit(view, push.source, point.index);
            deviation = deviations(light);
            away = luminances(light) - luminances(fitted(view, texel, point, light));
        }
        kinds[number] = point.kind;
        for (uint channel = 0u; channel < 3u; ++channel) {
            squares[3u * number + channel] = away[channel] * away[channel];
            noises[3u * number + channel] = deviation[channel] * deviation[channel] / point.lengths[channel];
        }
    }
}

// How much of what differs is kept: what is left of it about a texel when noise is taken away.
vec3 kept_share(uint kind) {
    vec3 sum = vec3(0.0);
    vec3 noise = vec3(0.0);
    [[dont_unroll]] for (int y = 0; y <= 2 * REACH; ++y) {
        for (int x = 0; x <= 2 * REACH; ++x) {
            ivec2 at = ivec2(gl_LocalInvocationID.xy) + ivec2(x, y);
            int number = at.y * TILE_EDGE + at.x;
            if (kinds[number] == kind) {
                sum += vec3(squares[3 * number], squares[3 * number + 1], squares[3 * number + 2]);
                noise += vec3(noises[3 * number], noises[3 * number + 1], noises[3 * number + 2]);
            }
        }
    }
    return clamp(1.0 - NOISE * noise / max(sum, 1e-12), 0.0, 1.0);
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    find_squares(view);
    barrier();
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_in_light(view, texel)) {
        return;
    }
    Point point = point_at(view, texel);
    Lit light = read_lit(view, push.source, point.index);
    if (point.kind == 0u) {
        write_lit(view, push.target, point.index, no_light_there(), 0.5);
        write_lit(view, view.history, point.index, no_light_there(), 0.5);
        return;
    }
    Lit clean = mixed(fitted(view, texel, point, light), light, kept_share(point.kind));
    write_lit(view, push.target, point.index, clean, 0.5);
    keep_history(view, point.index, light, clean, deviations(light), point.lengths);
}
