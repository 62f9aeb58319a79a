// Fragments of a rectangle of pixels (OpenGL 1.5, sections 3.6.4 and 3.7).
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "fixed/fragment.glsl"
#include "fixed/specialized.glsl"

// Every unit's coordinates come from the raster position, whose q may be anything.
#define ALL_UNITS 0xfu

layout(push_constant, scalar) uniform Push { DrawPush push; };

layout(location = 0) out vec4 out_color;

uint byte_at(Words source, uint index) {
    return (source.entries[index >> 2] >> ((index & 3u) * 8u)) & 0xffu;
}

void main() {
    FrameRecord frame = FrameTable(push.frame).entries[0];
    PixelRecord pixels = PixelTable(frame.pixels).entries[push.pixels];
    vec2 window = vec2(gl_FragCoord.x, frame.window_size.y - gl_FragCoord.y);
    vec2 pixel = floor((window - pixels.position) / pixels.zoom);
    if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, pixels.size))) {
        discard;
    }
    // Helper invocations go on, and must not read beyond the pixels.
    pixel = clamp(pixel, vec2(0.0), pixels.size - 1.0);

    Words source = Words(pixels.source);
    uint index = pixels.first_pixel + uint(int(pixel.y) * pixels.row_step) + uint(pixel.x);
    CurrentAttributes current = CurrentTable(frame.current).entries[pixels.current];
    vec4 primary = clamp(current.color, 0.0, 1.0);
    float depth = pixels.depth;
    switch (pixels.kind) {
        case PIXELS_COLOR: primary = unpackUnorm4x8(source.entries[index]); break;
        case PIXELS_DEPTH: depth = uintBitsToFloat(source.entries[index]); break;
        case PIXELS_DEPTH24: depth = float(source.entries[index] & 0xffffffu) / 16777215.0; break;
        case PIXELS_MASK:
            if (byte_at(source, index) == 0u) {
                discard;
            }
            break;
        default:
            if (pixels.stencil_bit != 0u && (byte_at(source, index) & pixels.stencil_bit) == 0u) {
                discard;
            }
            break;
    }

    GlobalState state = specialized_global();
    vec4 coordinates[TEXTURE_UNITS];
    [[unroll]] for (uint i = 0u; i < TEXTURE_UNITS; ++i) {
        coordinates[i] = current.texture[i].coefficients;
    }
    vec4 color = shade_fragment(state, specialized_units(), push, EnvironmentTable(frame.environments), CLAMPS, ALL_UNITS, 0u,
        primary, clamp(current.secondary.rgb, 0.0, 1.0), coordinates, current.fog.x);
    if (!compare_passes(state.alpha_func, color.a, push.alpha_reference)) {
        discard;
    }
    out_color = color;
    gl_FragDepth = clamp(depth, 0.0, 1.0);
}
