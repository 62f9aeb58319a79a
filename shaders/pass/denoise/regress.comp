// Fits light to what surfaces are, block by block (Koskela and others, Blockwise Multi-Order Feature Regression for Real-Time Path-Tracing
// Reconstruction, ACM TOG 38(5), 2019): least squares over a constant, normals, positions and their squares. Blocks lie elsewhere in
// each frame, so that their borders do not stay.
//
// Features depend on one another wherever a surface is flat. Where the paper adds noise to them and factors the matrix (QR), here all but
// the constant pay for their size (ridge regression), so that the normal equations have a solution and light that is
// constant stays so. What differs from the fit by more than noise (shadows' edges) is kept.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/channels.glsl"
#include "denoise/guide.glsl"
#include "pathtrace/random.glsl"

layout(local_size_x = 256) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

// Texels along a side of a block, and of each thread's.
#define BLOCK_EDGE 32
#define BLOCK_TEXELS 1024u
#define THREAD_TEXELS 4u
#define THREADS 256u
// A constant, normal, position, its square; red, green and blue of three channels, and the second band of indirect light.
#define FEATURES 10u
#define NUMBERS 12u
#define COLUMNS 22u
// Texels that are summed over at a time, as many as the least shared memory has room for.
#define TILE 128u

// What features pay for their size, in texels of each that is summed over, and in texels.
const float RIDGE = 1e-3;
const float LEAST_RIDGE = 1.0;
// Frames from which on a history holds nothing fitted, and frames up to which it holds nothing else.
const float LONG = 12.0;
const float SHORT = 4.0;
// How much of what differs from the fit is noise, in variances of what was gathered.
const float NOISE = 2.0;
// Texels to each side over which that is averaged.
const int REACH = 2;

// Rows of features and light; later what differs from the fit.
shared float rows[3u * BLOCK_TEXELS];
shared float equations[FEATURES * COLUMNS];
shared float solution[FEATURES * NUMBERS];
// Bounds of normals and positions, as numbers that are ordered as floats are.
shared uint least[6];
shared uint most[6];
shared uint classes;
shared uint first_texel;

// What a texel of the block shows.
struct Point {
    ivec2 texel;
    uint index;
    uint kind; // 0 for nothing
    vec3 normal;
    vec3 position;
    vec3 lengths;
};

// From bounds to features.
struct Scaling {
    vec3 normal;
    vec3 position;
    vec3 scale;
};

uint ordered(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float from_ordered(uint bits) {
    return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits);
}

// The R2 sequence, which spreads evenly over a block.
ivec2 block_corner(ViewRecord view) {
    uvec2 offset = (view.frame_number * uvec2(3242174889u, 2447445414u)) >> 27;
    return ivec2(gl_WorkGroupID.xy) * BLOCK_EDGE - ivec2(offset);
}

Point point_at(ViewRecord view, ivec2 corner, uint number) {
    ivec2 texel = corner + ivec2(number % BLOCK_EDGE, number / BLOCK_EDGE);
    Point point = Point(texel, 0u, 0u, vec3(0.0), vec3(0.0), vec3(1.0));
    if (!is_in_light(view, texel)) {
        return point;
    }
    point.index = light_index(view, texel);
    GuideTexel guide = Guides(view.guides).entries[point.index];
    if (guide.depth > 0.0) {
        point.kind = (guide.bits >> 18) & 3u;
        point.normal = unpack_unit_vector(guide.normal);
        point.position = seen_position(view, vec2(pixel_of_light(view, uvec2(texel))), guide.depth);
        point.lengths = vec3(max(guide_lengths(guide), uvec3(1u)));
    }
    return point;
}

float[FEATURES] features_of(Point point, Scaling scaling) {
    vec3 n = point.normal - scaling.normal;
    vec3 p = (point.position - scaling.position) * scaling.scale;
    vec3 q = p * p;
    return float[FEATURES](1.0, n.x, n.y, n.z, p.x, p.y, p.z, q.x, q.y, q.z);
}

float[NUMBERS] numbers_of(Lit light) {
    vec3 a = light.direct.rgb;
    vec3 b = light.indirect.rgb;
    vec3 c = light.specular.rgb;
    vec3 d = light.towards.xyz;
    return float[NUMBERS](a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z);
}

// Bounds of a class of surfaces in the block, and the first of its texels.
void find_bounds(ViewRecord view, ivec2 corner, uint kind) {
    [[dont_unroll]] for (uint i = 0u; i < THREAD_TEXELS; ++i) {
        uint number = gl_LocalInvocationIndex + THREADS * i;
        Point point = point_at(view, corner, number);
        if (point.kind == kind) {
            atomicMin(first_texel, number);
            for (int axis = 0; axis < 3; ++axis) {
                atomicMin(least[axis], ordered(point.normal[axis]));
                atomicMax(most[axis], ordered(point.normal[axis]));
                atomicMin(least[3 + axis], ordered(point.position[axis]));
                atomicMax(most[3 + axis], ordered(point.position[axis]));
            }
        }
    }
}

Scaling found_scaling() {
    vec3 least_normal, most_normal, least_position, most_position;
    for (int axis = 0; axis < 3; ++axis) {
        least_normal[axis] = from_ordered(least[axis]);
        most_normal[axis] = from_ordered(most[axis]);
        least_position[axis] = from_ordered(least[3 + axis]);
        most_position[axis] = from_ordered(most[3 + axis]);
    }
    vec3 extent = 0.5 * (most_position - least_position);
    // Along a plane's normal there are rounding errors only: these are not made large.
    float greatest = max(max(extent.x, extent.y), max(extent.z, 1e-20));
    vec3 scale = 1.0 / max(extent, 1e-2 * greatest);
    return Scaling(mix(least_normal, most_normal, 0.5), mix(least_position, most_position, 0.5), scale);
}

// Fills some rows of a class, each as heavy as frames that its light was gathered over.
void fill_row(ViewRecord view, ivec2 corner, uint kind, Scaling scaling, Lit origin, uint row, uint number) {
    Point point = point_at(view, corner, number);
    bool is_in = point.kind == kind;
    float weight = is_in ? sqrt(dot(point.lengths, vec3(1.0 / 3.0))) : 0.0;
    float features[FEATURES] = features_of(point, scaling);
    Lit light = origin;
    if (is_in) {
        light = read_lit(push.source, point.index);
    }
    float numbers[NUMBERS] = numbers_of(light);
    float origins[NUMBERS] = numbers_of(origin);
    for (uint i = 0u; i < FEATURES; ++i) {
        rows[COLUMNS * row + i] = is_in ? weight * features[i] : 0.0;
    }
    for (uint i = 0u; i < NUMBERS; ++i) {
        // Differences to one of them: large numbers that are alike leave no rest.
        rows[COLUMNS * row + FEATURES + i] = weight * (numbers[i] - origins[i]);
    }
}

// Solves for the class: a thread has an entry of the upper half of the normal equations, with their right sides.
void solve(ViewRecord view, ivec2 corner, uint kind, Scaling scaling, Lit origin) {
    uint thread = gl_LocalInvocationIndex;
    uint row = 0u;
    uint column = thread;
    while (row < FEATURES && column >= COLUMNS - row) {
        column -= COLUMNS - row;
        ++row;
    }
    column += row;
    bool has_entry = row < FEATURES;
    float entry = 0.0;
    float weights = 0.0;
    [[dont_unroll]] for (uint tile = 0u; tile < BLOCK_TEXELS; tile += TILE) {
        barrier();
        if (thread < TILE) {
            fill_row(view, corner, kind, scaling, origin, thread, tile + thread);
        }
        barrier();
        if (has_entry) {
            [[dont_unroll]] for (uint i = 0u; i < TILE; ++i) {
                entry += rows[COLUMNS * i + row] * rows[COLUMNS * i + column];
                weights += rows[COLUMNS * i] * rows[COLUMNS * i];
            }
        }
    }
    float ridge = RIDGE * weights + LEAST_RIDGE;
    entry += row == column && row > 0u ? ridge : 0.0;
    [[dont_unroll]] for (uint k = 0u; k < FEATURES; ++k) {
        if (row == k) {
            equations[COLUMNS * k + column] = entry;
        }
        barrier();
        if (has_entry && row > k) {
            // No pivot is less than the ridge but by rounding; that of the constant is a texel's weight at least.
            float pivot = max(equations[COLUMNS * k + k], min(ridge, 1.0));
            entry -= equations[COLUMNS * k + row] * equations[COLUMNS * k + column] / pivot;
        }
    }
    if (thread < NUMBERS) {
        for (int i = int(FEATURES) - 1; i >= 0; --i) {
            float rest = equations[COLUMNS * uint(i) + FEATURES + thread];
            for (uint j = uint(i) + 1u; j < FEATURES; ++j) {
                rest -= equations[COLUMNS * uint(i) + j] * solution[NUMBERS * j + thread];
            }
            solution[NUMBERS * uint(i) + thread] = rest / max(equations[COLUMNS * uint(i) + uint(i)], min(ridge, 1.0));
        }
    }
    barrier();
}

// What the fit makes of a texel's light. Deviations and what is not fitted stay.
Lit fitted(Point point, Scaling scaling, Lit origin, Lit light) {
    float features[FEATURES] = features_of(point, scaling);
    float numbers[NUMBERS] = numbers_of(origin);
    for (uint i = 0u; i < FEATURES; ++i) {
        for (uint j = 0u; j < NUMBERS; ++j) {
            numbers[j] += features[i] * solution[NUMBERS * i + j];
        }
    }
    light.direct.rgb = max(vec3(numbers[0], numbers[1], numbers[2]), 0.0);
    light.indirect.rgb = max(vec3(numbers[3], numbers[4], numbers[5]), 0.0);
    light.specular.rgb = max(vec3(numbers[6], numbers[7], numbers[8]), 0.0);
    light.towards.xyz = vec3(numbers[9], numbers[10], numbers[11]);
    return light;
}

// How much of what differs from the fit is kept: what is left of it about a texel when noise is taken away.
vec3 kept_share(uint number, vec3 noise) {
    ivec2 middle = ivec2(number % BLOCK_EDGE, number / BLOCK_EDGE);
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int y = max(middle.y - REACH, 0); y <= min(middle.y + REACH, BLOCK_EDGE - 1); ++y) {
        for (int x = max(middle.x - REACH, 0); x <= min(middle.x + REACH, BLOCK_EDGE - 1); ++x) {
            uint at = 3u * uint(BLOCK_EDGE * y + x);
            if (rows[at] >= 0.0) {
                sum += vec3(rows[at], rows[at + 1u], rows[at + 2u]);
                count += 1.0;
            }
        }
    }
    vec3 mean = sum / max(count, 1.0);
    return clamp(1.0 - NOISE * noise / max(mean, 1e-12), 0.0, 1.0);
}

void write_texels(ViewRecord view, ivec2 corner, uint kind, Scaling scaling, Lit origin) {
    [[dont_unroll]] for (uint i = 0u; i < THREAD_TEXELS; ++i) {
        uint number = gl_LocalInvocationIndex + THREADS * i;
        Point point = point_at(view, corner, number);
        vec3 away = vec3(-1.0);
        if (point.kind == kind) {
            Lit light = read_lit(push.source, point.index);
            away = luminances(light) - luminances(fitted(point, scaling, origin, light));
            away *= away;
        }
        for (uint channel = 0u; channel < 3u; ++channel) {
            rows[3u * number + channel] = away[channel];
        }
    }
    barrier();
    [[dont_unroll]] for (uint i = 0u; i < THREAD_TEXELS; ++i) {
        uint number = gl_LocalInvocationIndex + THREADS * i;
        Point point = point_at(view, corner, number);
        if (point.kind != kind) {
            continue;
        }
        Lit light = read_lit(push.source, point.index);
        vec3 deviation = deviations(light);
        Lit clean = mixed(fitted(point, scaling, origin, light), light, kept_share(number, deviation * deviation / point.lengths));
        write_lit(push.target, point.index, clean, 0.5);
        Lit kept = mixed(light, clean, clamp((LONG - point.lengths) / (LONG - SHORT), 0.0, 1.0));
        float random = float(hash(point.index ^ hash(view.frame_number + 0x51edu)) >> 8) / 16777216.0;
        write_lit(view.history, point.index, kept, random);
    }
}

// Which classes the block has; what shows nothing is done here.
void find_classes(ViewRecord view, ivec2 corner) {
    [[dont_unroll]] for (uint i = 0u; i < THREAD_TEXELS; ++i) {
        Point point = point_at(view, corner, gl_LocalInvocationIndex + THREADS * i);
        if (point.kind != 0u) {
            atomicOr(classes, 1u << point.kind);
        } else if (is_in_light(view, point.texel)) {
            write_lit(push.target, point.index, no_light_there(), 0.5);
            write_lit(view.history, point.index, no_light_there(), 0.5);
        }
    }
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    ivec2 corner = block_corner(view);
    uint thread = gl_LocalInvocationIndex;
    if (thread == 0u) {
        classes = 0u;
    }
    barrier();
    find_classes(view, corner);
    barrier();
    uint there = classes;
    [[dont_unroll]] for (uint kind = 1u; kind < 4u; ++kind) {
        if ((there & (1u << kind)) == 0u) {
            continue;
        }
        barrier();
        if (thread < 6u) {
            least[thread] = 0xffffffffu;
            most[thread] = 0u;
            first_texel = BLOCK_TEXELS;
        }
        barrier();
        find_bounds(view, corner, kind);
        barrier();
        Scaling scaling = found_scaling();
        Lit origin = read_lit(push.source, point_at(view, corner, first_texel).index);
        solve(view, corner, kind, scaling, origin);
        write_texels(view, corner, kind, scaling, origin);
    }
}
