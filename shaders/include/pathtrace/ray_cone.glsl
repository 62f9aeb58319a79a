// Which texels a path reads: a cone about each ray, as wide as what the ray stands for (Akenine-Moeller and others, Texture
// Level of Detail Strategies for Real-Time Ray Tracing, Ray Tracing Gems, chapter 20). Its twin is
// core/render/tests/ray_cone.rs.

#ifndef AFTERGLOW_PATHTRACE_RAY_CONE_GLSL
#define AFTERGLOW_PATHTRACE_RAY_CONE_GLSL

// Greatest spread of a cone: its half angle is 45 degrees.
#define MOST_CONE_SPREAD 2.0
// Least cosine at which a surface is met: more oblique ones would be all blur.
#define LEAST_CONE_COSINE 0.0625

struct RayCone {
    float width;  // where the ray starts, world units
    float spread; // how much wider it is one unit on: twice the tangent of the half angle
};

// The cone of a pixel: its height at depth 1.
RayCone camera_cone(float pixel_spread) {
    return RayCone(0.0, pixel_spread);
}

// The cone at the end of a ray so long.
RayCone travelled(RayCone cone, float away) {
    return RayCone(cone.width + cone.spread * away, cone.spread);
}

// The cone of a ray that a surface has sent on with the density `pdf` over solid angle, one of so many samples: it covers
// the share of directions that the sample stands for (Krivanek and Colbert, GPU-Based Importance Sampling, GPU Gems 3,
// chapter 20), beside what it covered before. From a diffuse surface that is the widest cone there is, from a mirror none;
// many samples make it narrow, so that what they add up to is not blurred.
RayCone scattered(RayCone cone, float pdf, float samples) {
    float share = 1.0 / max(6.2831853 * pdf * samples, 1e-20);
    float cosine = max(1.0 - share, 0.70710678);
    float spread = 2.0 * sqrt(max(1.0 - cosine * cosine, 0.0)) / cosine;
    return RayCone(cone.width, min(sqrt(cone.spread * cone.spread + spread * spread), MOST_CONE_SPREAD));
}

// How many cones, as a power of two, lie side by side along the root of twice the area of a triangle that is met. `cosine`
// is between ray and normal; the area is in the world's units.
float cones_along(RayCone cone, float cosine, float area_world) {
    float width = cone.width / max(abs(cosine), LEAST_CONE_COSINE);
    return 0.5 * log2(max(area_world, 1e-20)) - log2(max(width, 1e-20));
}

// Texels, as a power of two, along a unit of texture coordinates so that one is as wide as the cone: by twice the
// triangle's area in those coordinates.
float cone_texels(float cones, float area_coordinates) {
    return cones - 0.5 * log2(max(area_coordinates, 1e-20));
}

// Twice a triangle's area by its corners' coordinates.
float coordinates_area(vec2 a, vec2 b, vec2 c) {
    vec2 edge_1 = b - a;
    vec2 edge_2 = c - a;
    return abs(edge_1.x * edge_2.y - edge_1.y * edge_2.x);
}

#endif
