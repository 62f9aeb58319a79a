// Fits light to what surfaces are, block by block (Koskela and others, Blockwise Multi-Order Feature Regression for Real-Time Path-Tracing
// Reconstruction, ACM TOG 38(5), 2019): least squares over a constant, normals, positions and their squares, one fit for
// each class of surfaces. Blocks overlap by half, for each texel's light is mixed of four fits (evaluate.comp).
//
// Features depend on one another wherever a surface is flat. Where the paper adds noise to them and factors the matrix (QR), here all but
// the constant pay for their size (ridge regression), so that the normal equations have a solution and light that is
// constant stays so.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "denoise/fits.glsl"

layout(local_size_x = 256) in;

layout(push_constant, scalar) uniform Push { ViewPush push; };

#define THREADS 256u
// Texels along a side of a block, and of each thread's.
#define BLOCK_EDGE (2u * BLOCK_STEP)
#define BLOCK_TEXELS (BLOCK_EDGE * BLOCK_EDGE)
#define THREAD_TEXELS (BLOCK_TEXELS / THREADS)
#define COLUMNS (FEATURES + NUMBERS)
// Texels that are summed over at a time, as many as the least shared memory has room for.
#define TILE 128u

// What features pay for their size: as a share of the frames that are summed over, and at least.
const float RIDGE = 1e-4;
const float LEAST_RIDGE = 0.1;

// Rows of features and light.
shared float rows[TILE * COLUMNS];
shared float equations[FEATURES * COLUMNS];
shared float solution[FEATURES * NUMBERS];
// Bounds of normals and positions, as numbers that are ordered as floats are.
shared uint least[6];
shared uint most[6];
shared uint classes;
shared uint first_texel;

uint ordered(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float from_ordered(uint bits) {
    return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits);
}

Point block_point(ViewRecord view, uint number) {
    ivec2 corner = first_middle(view) + (ivec2(gl_WorkGroupID.xy) - 1) * int(BLOCK_STEP);
    return point_at(view, corner + ivec2(number % BLOCK_EDGE, number / BLOCK_EDGE));
}

// Bounds of a class of surfaces in the block, and the first of its texels.
void find_bounds(ViewRecord view, uint kind) {
    [[dont_unroll]] for (uint i = 0u; i < THREAD_TEXELS; ++i) {
        uint number = gl_LocalInvocationIndex + THREADS * i;
        Point point = block_point(view, number);
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
void fill_row(ViewRecord view, uint kind, Scaling scaling, Lit origin, uint row, uint number) {
    Point point = block_point(view, number);
    bool is_in = point.kind == kind;
    float weight = is_in ? sqrt(dot(point.lengths, vec3(1.0 / 3.0))) : 0.0;
    float features[FEATURES] = features_of(point, scaling);
    Lit light = origin;
    if (is_in) {
        light = read_lit(view, push.source, point.index);
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
void solve(ViewRecord view, uint kind, Scaling scaling, Lit origin) {
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
            fill_row(view, kind, scaling, origin, thread, tile + thread);
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

// Which classes of surfaces the block has.
void find_classes(ViewRecord view) {
    [[dont_unroll]] for (uint i = 0u; i < THREAD_TEXELS; ++i) {
        atomicOr(classes, 1u << block_point(view, gl_LocalInvocationIndex + THREADS * i).kind);
    }
}

void write_fit(ViewRecord view, uint kind, Scaling scaling, Lit origin) {
    uint thread = gl_LocalInvocationIndex;
    uint fit = fit_index(view, ivec2(gl_WorkGroupID.xy), kind);
    if (thread == 0u) {
        Fits(view.fits).entries[fit].normal = scaling.normal;
        Fits(view.fits).entries[fit].position = scaling.position;
        Fits(view.fits).entries[fit].scale = scaling.scale;
    }
    if (thread < FEATURES) {
        float numbers[NUMBERS] = numbers_of(thread == 0u ? origin : no_light_there());
        for (uint i = 0u; i < NUMBERS; ++i) {
            numbers[i] += solution[NUMBERS * thread + i];
        }
        Fits(view.fits).entries[fit].features[thread] = FeatureFit(vec3(numbers[0], numbers[1], numbers[2]),
            vec3(numbers[3], numbers[4], numbers[5]), vec3(numbers[6], numbers[7], numbers[8]),
            vec3(numbers[9], numbers[10], numbers[11]));
    }
}

void main() {
    ViewRecord view = ViewTable(push.view).entries[0];
    uint thread = gl_LocalInvocationIndex;
    if (thread == 0u) {
        classes = 0u;
    }
    barrier();
    find_classes(view);
    barrier();
    uint there = classes;
    [[dont_unroll]] for (uint kind = 1u; kind <= SURFACE_CLASSES; ++kind) {
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
        find_bounds(view, kind);
        barrier();
        Scaling scaling = found_scaling();
        Lit origin = read_lit(view, push.source, block_point(view, first_texel).index);
        solve(view, kind, scaling, origin);
        write_fit(view, kind, scaling, origin);
    }
}
