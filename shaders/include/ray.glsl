// Rays, triangles and spheres: the watertight test, and the start of secondary rays.
// Twin of core/bvh/src/intersect.rs: same names, same operations in the same order.

#ifndef AFTERGLOW_RAY_GLSL
#define AFTERGLOW_RAY_GLSL

// The shear that turns a ray into the z axis: a point p relative to the origin has the ray's
// distance at dot(depth, p), and its offset from the ray at dot(across, p), dot(along, p).
struct RayShear {
    vec3 across;
    vec3 along;
    vec3 depth;
};

// The shear of rays along d, of any length but 0.
RayShear ray_shear(vec3 d) {
    vec3 size = abs(d);
    if (size.x >= size.y && size.x >= size.z) {
        float inverse = 1.0 / d.x;
        return RayShear(vec3(-d.y / d.x, 1.0, 0.0), vec3(-d.z / d.x, 0.0, 1.0), vec3(inverse, 0.0, 0.0));
    }
    if (size.y >= size.z) {
        float inverse = 1.0 / d.y;
        return RayShear(vec3(0.0, -d.z / d.y, 1.0), vec3(1.0, -d.x / d.y, 0.0), vec3(0.0, inverse, 0.0));
    }
    float inverse = 1.0 / d.z;
    return RayShear(vec3(1.0, 0.0, -d.x / d.z), vec3(0.0, 1.0, -d.y / d.z), vec3(0.0, 0.0, inverse));
}

// Where a ray meets a triangle's plane, inside the triangle.
struct TriangleHit {
    float t;           // in lengths of the ray's direction, negative too
    vec2 barycentrics; // weights of the second and third corner
    bool front;        // the corners run counter-clockwise as seen from the origin
};

float dot_fused(vec3 a, vec3 b) {
    precise float sum = fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
    return sum;
}

// a b - c d within 1.5 units in the last place, its sign exact (Kahan's algorithm; Jeannerod, Louvet
// and Muller, Further Analysis of Kahan's Algorithm, 2013).
float difference_of_products(float a, float b, float c, float d) {
    precise float product = c * d;
    precise float error = fma(-c, d, product);
    precise float difference = fma(a, b, -product) + error;
    return difference;
}

// Whether the line through `origin` meets the triangle. Triangles that share an edge leave no gap
// (after Woop, Benthin and Wald, Watertight Ray/Triangle Intersection, JCGT 2013).
bool intersect_triangle(vec3 origin, RayShear shear, vec3 corner_a, vec3 corner_b, vec3 corner_c, out TriangleHit hit) {
    vec3 a = corner_a - origin;
    vec3 b = corner_b - origin;
    vec3 c = corner_c - origin;
    float ax = dot_fused(a, shear.across), ay = dot_fused(a, shear.along);
    float bx = dot_fused(b, shear.across), by = dot_fused(b, shear.along);
    float cx = dot_fused(c, shear.across), cy = dot_fused(c, shear.along);
    // Signs are exact, so the triangles on both sides of an edge agree on which has the ray.
    float weight_a = difference_of_products(bx, cy, by, cx);
    float weight_b = difference_of_products(cx, ay, cy, ax);
    float weight_c = difference_of_products(ax, by, ay, bx);
    float least = min(min(weight_a, weight_b), weight_c);
    float greatest = max(max(weight_a, weight_b), weight_c);
    precise float determinant = weight_a + weight_b + weight_c;
    if ((least < 0.0 && greatest > 0.0) || determinant == 0.0) {
        return false;
    }
    float depth_a = dot_fused(a, shear.depth);
    float depth_b = dot_fused(b, shear.depth);
    float depth_c = dot_fused(c, shear.depth);
    precise float scale = 1.0 / determinant;
    precise float t = (weight_a * depth_a + weight_b * depth_b + weight_c * depth_c) * scale;
    hit.t = t;
    hit.barycentrics = vec2(weight_b, weight_c) * scale;
    bool backwards = shear.depth.x + shear.depth.y + shear.depth.z < 0.0;
    hit.front = (determinant > 0.0) == backwards;
    return true;
}

// Where a ray meets a sphere.
struct SphereHit {
    float t;    // in lengths of the ray's direction
    bool front; // from outside
};

// Whether the line through `origin` meets the sphere; if so, where first beyond t_min. `inverse` holds the
// direction's reciprocals.
//
// The square of the half chord is taken from the ray's point nearest to the centre, and the nearer of
// two distances by the product of both, so that no digits cancel (Haines, Guenther and Akenine-Moeller,
// Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019, chapter 7).
bool intersect_sphere(vec3 origin, vec3 inverse, RayShear shear, float t_min, vec3 centre, float radius, out SphereHit hit) {
    // A direction whose longest component is 1: no length of the ray's own overflows.
    float scale = abs(shear.depth.x + shear.depth.y + shear.depth.z);
    precise vec3 direction = scale / inverse;
    vec3 from = origin - centre;
    float squared = dot_fused(direction, direction);
    float towards = -dot_fused(from, direction);
    precise float nearest = towards / squared;
    precise vec3 aside = fma(vec3(nearest), direction, from);
    precise float half_chord_squared = fma(radius, radius, -dot_fused(aside, aside));
    if (half_chord_squared < 0.0 || isnan(half_chord_squared)) {
        return false;
    }
    precise float root = sqrt(squared * half_chord_squared);
    precise float sum = towards < 0.0 ? towards - root : towards + root;
    precise float product = fma(radius, -radius, dot_fused(from, from));
    precise float one = sum / squared;
    precise float other = sum == 0.0 ? 0.0 : product / sum;
    precise float near = min(one, other) * scale;
    precise float far = max(one, other) * scale;
    hit.front = near > t_min;
    hit.t = hit.front ? near : far;
    return true;
}

// Where a ray from surface point `position` starts, moved along `normal` (on the side of the new
// ray) past the rounding of the point itself: by a count of representable numbers, or near 0 by a
// length (Waechter and Binder, A Fast and Robust Method for Avoiding Self-Intersection, Ray Tracing
// Gems, 2019, chapter 6). Their lengths are of a scene of size 1; here the greatest coordinate stands for that, so that
// a scene is the same at any scale.
vec3 offset_ray(vec3 position, vec3 normal) {
    vec3 size = abs(position);
    float greatest = max(max(size.x, size.y), size.z);
    float near_zero = greatest * (1.0 / 32.0);
    float length_near_zero = greatest * (1.0 / 65536.0);
    const float steps = 256.0;
    ivec3 count = ivec3(steps * normal);
    ivec3 away = mix(count, -count, lessThan(position, vec3(0.0)));
    vec3 stepped = intBitsToFloat(floatBitsToInt(position) + away);
    vec3 moved = position + length_near_zero * normal;
    return mix(stepped, moved, lessThanEqual(size, vec3(near_zero)));
}

#endif
