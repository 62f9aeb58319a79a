// Vertices as a layout describes them: attributes tightly in slot order, each absent or in one of
// five formats.

#ifndef AFTERGLOW_FIXED_ATTRIBUTES_GLSL
#define AFTERGLOW_FIXED_ATTRIBUTES_GLSL

#include "../generated/state_words.glsl"
#include "tables.glsl"

// Words that an attribute of this format takes: the formats of floats are numbered by their length.
uint format_words(uint format) {
    return format == FORMAT_UNORM8X4 ? 1u : format;
}

// Words from the start of a vertex to `slot`; of slot SLOTS, the words of a vertex.
uint layout_offset(uint vertex_layout, uint slot) {
    uint words = 0u;
    [[unroll]] for (uint before = 0u; before < SLOTS; ++before) {
        words += before < slot ? format_words(layout_format(vertex_layout, before)) : 0u;
    }
    return words;
}

// One attribute of the vertex at `vertex`, or `absent` if the layout lacks it.
vec4 fetch_attribute(Words vertex, uint vertex_layout, uint slot, vec4 absent) {
    uint format = layout_format(vertex_layout, slot);
    if (format == FORMAT_ABSENT) {
        return absent;
    }
    uint first = layout_offset(vertex_layout, slot);
    if (format == FORMAT_UNORM8X4) {
        return unpackUnorm4x8(vertex.entries[first]);
    }
    vec4 value = vec4(0.0, 0.0, 0.0, 1.0);
    value.x = uintBitsToFloat(vertex.entries[first]);
    if (format >= FORMAT_F2) {
        value.y = uintBitsToFloat(vertex.entries[first + 1u]);
    }
    if (format >= FORMAT_F3) {
        value.z = uintBitsToFloat(vertex.entries[first + 2u]);
    }
    if (format >= FORMAT_F4) {
        value.w = uintBitsToFloat(vertex.entries[first + 3u]);
    }
    return value;
}

#endif
