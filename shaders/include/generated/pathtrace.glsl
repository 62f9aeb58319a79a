// Written by afterglow-gen (./x gen) from the declarations in Rust; not to be edited.
#ifndef GENERATED_PATHTRACE
#define GENERATED_PATHTRACE

#ifndef STRUCT_SurfaceDraw
#define STRUCT_SurfaceDraw
struct SurfaceDraw { // 312 bytes
    uint64_t vertices;
    uint64_t indices;
    uint64_t corners_before;
    mat3x4 object_to_world;
    mat3x4 object_to_world_before;
    vec4 viewport;
    uint state[14];
    uint textures[4];
    uint vertex_layout;
    uint last_vertex;
    uint transform;
    uint material;
    uint environment;
    uint current;
    uint kind;
    uint next_layer;
    uint blend;
    uint ray_mask;
    vec3 emission;
    float roughness;
    float metallic;
    uint normal_map;
    uint metallic_roughness_map;
    uint emission_map;
    uint bake;
    uint first_light;
    vec3 base_color;
    uint maps;
    float reach;
    uint object;
};
#endif

#ifndef STRUCT_MeshMember
#define STRUCT_MeshMember
struct MeshMember { // 8 bytes
    uint draw;
    uint first_triangle;
};
#endif

#ifndef STRUCT_LightSource
#define STRUCT_LightSource
struct LightSource { // 96 bytes
    vec3 position;
    float radius;
    vec3 color;
    uint kind;
    vec3 attenuation;
    float spot_cos_cutoff;
    vec3 spot_axis;
    float spot_exponent;
    vec3 edge_1;
    vec3 edge_2;
    uint trail;
    uint padding;
};
#endif

#ifndef STRUCT_LightNode
#define STRUCT_LightNode
struct LightNode { // 64 bytes
    vec3 least;
    float power;
    vec3 greatest;
    uint next;
    vec3 axis;
    float cos_spread;
    vec3 attenuation;
    uint padding;
};
#endif

#ifndef STRUCT_ViewRecord
#define STRUCT_ViewRecord
struct ViewRecord { // 568 bytes
    uint64_t frame;
    uint64_t draws;
    uint64_t members;
    uint64_t lights;
    uint64_t light_nodes;
    uint64_t counters;
    uint64_t radiance;
    uint64_t reservoirs;
    uint64_t reservoirs_before;
    uint64_t surfaces_before;
    uint64_t world;
    uint64_t surfaces;
    uint64_t light;
    uint64_t guides;
    uint64_t guides_before;
    uint64_t motions;
    uint64_t noisy;
    uint64_t history;
    uint64_t denoised;
    uint64_t strata;
    uint64_t gradients;
    uint64_t luminances;
    uint64_t fits;
    uint64_t composed;
    uint64_t sums;
    uint64_t movers;
    uint64_t exposure;
    uint64_t sky_map;
    uint width;
    uint height;
    uint light_width;
    uint light_height;
    vec2 light_step;
    uint visibility;
    uint color;
    uint albedo;
    float bake_scale;
    vec3 bounce;
    uint far_count;
    uint light_count;
    uint most_surfaces;
    uint asked;
    uint candidates;
    uint traits;
    float most_radiance;
    float highlight;
    uint samples;
    uint first_sample;
    uint first_sample_before;
    uint accumulated;
    uint seed;
    vec3 sky;
    vec3 sky_least;
    vec3 sky_scale;
    float contact_reach;
    vec3 ambient;
    uint paint;
    float pixel_spread;
    uint has_movers;
    uint sum_count;
    float exposure_rate;
    vec3 forward;
    vec3 pixel_origin;
    vec3 pixel_right;
    vec3 pixel_down;
    mat4 clip_before;
    vec4 depth_before;
    vec3 longest;
    uint spare_samples;
    uint most_spare_samples;
    vec3 origin_before;
    uint frame_number;
    uint padding;
};
#endif

#ifndef STRUCT_SurfaceTexel
#define STRUCT_SurfaceTexel
struct SurfaceTexel { // 36 bytes
    vec3 start;
    uint normal;
    uint geometric;
    uint albedo;
    uint specular;
    uint emission;
    uint properties;
};
#endif

#ifndef STRUCT_LightTexel
#define STRUCT_LightTexel
struct LightTexel { // 48 bytes
    vec3 direct;
    vec3 indirect;
    vec3 specular;
    vec3 towards;
};
#endif

#ifndef STRUCT_ChannelTexel
#define STRUCT_ChannelTexel
struct ChannelTexel { // 20 bytes
    uint colors[3];
    uint towards;
    uint deviations;
};
#endif

#ifndef STRUCT_GuideTexel
#define STRUCT_GuideTexel
struct GuideTexel { // 12 bytes
    float depth;
    uint normal;
    uint bits;
};
#endif

#ifndef STRUCT_MotionTexel
#define STRUCT_MotionTexel
struct MotionTexel { // 8 bytes
    uint offset;
    float depth;
};
#endif

#ifndef STRUCT_StratumTexel
#define STRUCT_StratumTexel
struct StratumTexel { // 12 bytes
    uint chosen;
    uint before;
    uint luminance;
};
#endif

#ifndef STRUCT_GradientTexel
#define STRUCT_GradientTexel
struct GradientTexel { // 12 bytes
    uint halves[3];
};
#endif

#ifndef STRUCT_FeatureFit
#define STRUCT_FeatureFit
struct FeatureFit { // 48 bytes
    vec3 direct;
    vec3 indirect;
    vec3 specular;
    vec3 towards;
};
#endif

#ifndef STRUCT_FitRecord
#define STRUCT_FitRecord
struct FitRecord { // 516 bytes
    vec3 normal;
    vec3 position;
    vec3 scale;
    FeatureFit features[10];
};
#endif

#ifndef STRUCT_LuminanceTexel
#define STRUCT_LuminanceTexel
struct LuminanceTexel { // 4 bytes
    uint word;
};
#endif

#ifndef STRUCT_RadianceTexel
#define STRUCT_RadianceTexel
struct RadianceTexel { // 24 bytes
    vec3 mean;
    vec3 squares;
};
#endif

#ifndef STRUCT_TraceCounters
#define STRUCT_TraceCounters
struct TraceCounters { // 24 bytes
    uint non_finite;
    uint limited;
    uint removed;
    uint rays;
    uint needy;
    uint padding;
};
#endif

#ifndef STRUCT_ReservoirTexel
#define STRUCT_ReservoirTexel
struct ReservoirTexel { // 20 bytes
    uint light;
    uint point;
    float weight;
    float count;
    float brings;
};
#endif

#ifndef STRUCT_ExposureSum
#define STRUCT_ExposureSum
struct ExposureSum { // 8 bytes
    float traced;
    float program;
};
#endif

#ifndef STRUCT_MoverSum
#define STRUCT_MoverSum
struct MoverSum { // 24 bytes
    uint traced[3];
    uint program[3];
};
#endif

#ifndef STRUCT_Exposure
#define STRUCT_Exposure
struct Exposure { // 4 bytes
    float scale;
};
#endif

#ifndef STRUCT_ViewPush
#define STRUCT_ViewPush
struct ViewPush { // 32 bytes
    uint64_t view;
    uint64_t source;
    uint64_t target;
    uint step;
    uint padding;
};
#endif

#ifndef STRUCT_RefitPush
#define STRUCT_RefitPush
struct RefitPush { // 64 bytes
    uint64_t structure;
    uint64_t sources;
    uint64_t corners;
    uint64_t order;
    uint64_t costs;
    uint64_t answer;
    uint nodes;
    uint first;
    uint count;
    uint padding;
};
#endif

#ifndef STRUCT_SkyPush
#define STRUCT_SkyPush
struct SkyPush { // 40 bytes
    uint64_t drawn;
    uint64_t map;
    vec3 open;
    uint level;
    uint remembers;
    uint padding;
};
#endif

#define BLEND_WORDS 1
#define BLEND_ENABLED_WORD 0
#define blend_enabled(w) (((w) >> 0) & 0x1u)
#define BLEND_SOURCE_WORD 0
#define blend_source(w) (((w) >> 1) & 0xfu)
#define BLEND_DESTINATION_WORD 0
#define blend_destination(w) (((w) >> 5) & 0xfu)
#define BLEND_EQUATION_WORD 0
#define blend_equation(w) (((w) >> 9) & 0x7u)
#define MAPS_WORDS 1
#define MAPS_UNIT_WORD 0
#define maps_unit(w) (((w) >> 0) & 0x3u)
#define MAPS_METAL_IN_NORMAL_WORD 0
#define maps_metal_in_normal(w) (((w) >> 2) & 0x1u)
#define MAPS_ROUGHNESS_IN_EMISSION_WORD 0
#define maps_roughness_in_emission(w) (((w) >> 3) & 0x1u)
#define MAPS_NORMAL_OF_TWO_WORD 0
#define maps_normal_of_two(w) (((w) >> 4) & 0x1u)
#define BLOCK_STEP 16u
#define FEATURES 10u
#define STRATUM_EDGE 3u
#define SURFACE_CLASSES 3u
#define MASK_STATIC 1u
#define MASK_MOVING 2u
#define MASK_VIEW_MODEL 4u
#define MEMBER_SHIFT 20u
#define NO_MAP 4294967295u
#define LIGHT_FAR 0u
#define LIGHT_LEAF 2147483648u
#define LIGHT_POINT 1u
#define LIGHT_SPHERE 2u
#define LIGHT_TRIANGLE 3u
#define LIGHT_TRIANGLE_BOTH 4u
#define MEMBER_OF_LIGHTS 2147483648u
#define NO_LIGHT 4294967295u
#define NO_TRAIL 4294967295u
#define SKY_EDGE 128u
#define SKY_LEVELS 6u
#define TRACE_INDEPENDENT 1u
#define TRACE_ROULETTE 8u
#define TRACE_PARALLEL 16u
#define TRACE_SMOOTH_EDGES 32u
#define TRACE_UNIFORM_LIGHTS 2u
#define TRACE_UNLIMITED 4u

#define SURFACE_NONE 0u
#define SURFACE_LIT 1u
#define SURFACE_CATCHER 2u
#define SURFACE_BAKED 3u
#define SURFACE_BAKED_MOVER 4u

#define PAINT_PICTURE 0u
#define PAINT_KIND 1u
#define PAINT_NORMAL 2u
#define PAINT_ALBEDO 3u
#define PAINT_DIRECT 4u
#define PAINT_INDIRECT 5u
#define PAINT_SKY 6u
#define PAINT_SPECULAR 7u
#define PAINT_MOTION 8u
#define PAINT_VARIANCE 9u
#define PAINT_GRADIENT 10u
#define PAINT_HISTORY 11u
#define PAINT_EDGES 12u

#define BLEND_FACTOR_ZERO 0u
#define BLEND_FACTOR_ONE 1u
#define BLEND_FACTOR_SOURCE_COLOR 2u
#define BLEND_FACTOR_ONE_MINUS_SOURCE_COLOR 3u
#define BLEND_FACTOR_DESTINATION_COLOR 4u
#define BLEND_FACTOR_ONE_MINUS_DESTINATION_COLOR 5u
#define BLEND_FACTOR_SOURCE_ALPHA 6u
#define BLEND_FACTOR_ONE_MINUS_SOURCE_ALPHA 7u
#define BLEND_FACTOR_DESTINATION_ALPHA 8u
#define BLEND_FACTOR_ONE_MINUS_DESTINATION_ALPHA 9u
#define BLEND_FACTOR_SOURCE_ALPHA_SATURATE 10u
#define BLEND_FACTOR_CONSTANT_COLOR 11u
#define BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR 12u
#define BLEND_FACTOR_CONSTANT_ALPHA 13u
#define BLEND_FACTOR_ONE_MINUS_CONSTANT_ALPHA 14u

#define BLEND_EQUATION_ADD 0u
#define BLEND_EQUATION_SUBTRACT 1u
#define BLEND_EQUATION_REVERSE_SUBTRACT 2u
#define BLEND_EQUATION_MIN 3u
#define BLEND_EQUATION_MAX 4u

#endif
