// Rays in, answers out: of measurements (cli/src/bench/rays) and tests (core/bvh/tests/support/gpu.rs).

struct RayRecord {
    vec3 origin;
    float t_min;
    vec3 direction;
    float t_max;
};

struct Answer {
    float t;
    vec2 barycentrics;
    uint primitive;
    uint instance;
    uint found_and_front; // bit 0, bit 1
};

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Rays {
    RayRecord ray[];
};

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Answers {
    Answer answer[];
};
