// A rectangle of the window that holds all fragments of a rectangle of pixels.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "fixed/tables.glsl"

layout(push_constant, scalar) uniform Push { DrawPush push; };

void main() {
    FrameRecord frame = FrameTable(push.frame).entries[0];
    PixelRecord pixels = PixelTable(frame.pixels).entries[push.pixels];
    vec2 corner = pixels.position;
    vec2 opposite = corner + pixels.zoom * pixels.size;
    // Rounded outward: the fragment shader decides which fragments there are.
    vec2 least = floor(min(corner, opposite));
    vec2 most = ceil(max(corner, opposite));
    vec2 at = vec2((0x32 >> gl_VertexIndex) & 1, (0x2c >> gl_VertexIndex) & 1);
    gl_Position = vec4(mix(least, most, at) / frame.window_size * 2.0 - 1.0, 0.0, 1.0);
}
