// What a ray has met, the same whatever it was traced by.

#ifndef AFTERGLOW_TRACE_HIT_GLSL
#define AFTERGLOW_TRACE_HIT_GLSL

struct Hit {
    float t;           // in lengths of the ray's direction
    vec2 barycentrics; // weights of the second and third corner; 0 on a sphere
    uint primitive;    // the number of the triangle or sphere in its bottom level
    uint instance;     // the instance's id
    bool front;        // the corners run counter-clockwise as seen from the origin, in object space; of a sphere, the outside
};

#endif
