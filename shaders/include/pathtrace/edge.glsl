// Where an edge of the triangle that a pixel shows passes by the pixel's middle (Persson, Geometry Buffer Anti-Aliasing, 2011): along
// rows or columns, whichever way it is nearer. The colours of both sides are mixed by how much of the pixel each has, without
// more samples and without a touch to depth.

#ifndef AFTERGLOW_PATHTRACE_EDGE_GLSL
#define AFTERGLOW_PATHTRACE_EDGE_GLSL

// No edge is near.
#define NO_EDGE 0u
// Bit of an edge that is crossed along a column.
#define EDGE_DOWN 128u

// Seven bits: distance to the right or downward in 1/63 of a pixel, from -63 to 63.
uint pack_edge(bool is_down, float offset) {
    return uint(int(floor(offset * 63.0 + 0.5)) + 64) | (is_down ? EDGE_DOWN : 0u);
}

float edge_offset(uint edge) {
    return float(int(edge & 127u) - 64) / 63.0;
}

// Pixels that a triangle must reach from an edge for its colour to be that of the edge's whole side.
#define LEAST_REACH 2.0

// The nearest edge within a pixel of the middle. Each of three edges is where a column's product with (x, y, 1) of normalised device
// coordinates is 0; `products` are the middle's, `viewport` is its size in pixels, `clip` has x, y and w of the corners. Where two edges
// are near, or the triangle is hardly larger than a pixel, none can be trusted.
uint nearest_edge(vec2 viewport, mat3 lines, vec3 products, vec3 clip[3]) {
    float nearest = 1.0;
    float second = 1.0;
    uint edge = NO_EDGE;
    float determinant = dot(clip[0], lines[0]);
    for (uint i = 0u; i < 3u; ++i) {
        // What the next pixel to the right and the next one below add.
        vec2 gradient = vec2(lines[i].x, -lines[i].y) * 2.0 / viewport;
        bool is_down = abs(gradient.y) > abs(gradient.x);
        float along = is_down ? gradient.y : gradient.x;
        float offset = -products[i] / along;
        float away = abs(offset);
        // How far the third corner is from the edge.
        float reach = abs(determinant / (along * clip[i].z));
        if (away < nearest) {
            second = nearest;
            nearest = away;
            edge = reach >= LEAST_REACH ? pack_edge(is_down, offset) : NO_EDGE;
        } else {
            second = min(second, away);
        }
    }
    return second < 0.5 ? NO_EDGE : edge;
}

#endif
