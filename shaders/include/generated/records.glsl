// Written by afterglow-gen (./x gen) from the declarations in Rust; not to be edited.
#ifndef GENERATED_RECORDS
#define GENERATED_RECORDS

#ifndef STRUCT_FrameRecord
#define STRUCT_FrameRecord
struct FrameRecord { // 88 bytes
    uint64_t draws;
    uint64_t transforms;
    uint64_t lights;
    uint64_t materials;
    uint64_t environments;
    uint64_t texgens;
    uint64_t texture_matrices;
    uint64_t clip_planes;
    uint64_t current;
    uint64_t pixels;
    vec2 window_size;
};
#endif

#ifndef STRUCT_DrawRecord
#define STRUCT_DrawRecord
struct DrawRecord { // 48 bytes
    uint64_t vertices;
    uint last_vertex;
    uint transform;
    uint lights;
    uint material;
    uint environment;
    uint texgen;
    uint texture_matrices;
    uint clip_planes;
    uint current;
    float depth_offset;
};
#endif

#ifndef STRUCT_DrawPush
#define STRUCT_DrawPush
struct DrawPush { // 64 bytes
    uint64_t frame;
    uint environment;
    uint pixels;
    uint textures[4];
    vec4 fog_color;
    float fog_density;
    float fog_end;
    float fog_scale;
    float alpha_reference;
};
#endif

#ifndef STRUCT_PixelRecord
#define STRUCT_PixelRecord
struct PixelRecord { // 56 bytes
    uint64_t source;
    vec2 position;
    vec2 zoom;
    vec2 size;
    int row_step;
    uint kind;
    float depth;
    uint current;
    uint stencil_bit;
    uint first_pixel;
};
#endif

#ifndef STRUCT_ClearPush
#define STRUCT_ClearPush
struct ClearPush { // 20 bytes
    vec4 color;
    float depth;
};
#endif

#ifndef STRUCT_FlipRecord
#define STRUCT_FlipRecord
struct FlipRecord { // 40 bytes
    uint64_t source;
    uint64_t target;
    uint source_width;
    uint source_height;
    uint width;
    uint height;
    uint first_row;
    uint rows;
};
#endif

#ifndef STRUCT_FlipPush
#define STRUCT_FlipPush
struct FlipPush { // 16 bytes
    uint64_t records;
    uint depth_maximum;
    uint first;
};
#endif

#ifndef STRUCT_AccumulatePush
#define STRUCT_AccumulatePush
struct AccumulatePush { // 64 bytes
    uint64_t accumulation;
    uint64_t colors;
    uint rectangle[4];
    uint pitch;
    uint operation;
    float value;
    uint padding;
    vec4 clear;
};
#endif

#define PIXELS_COLOR 0u
#define PIXELS_MASK 1u
#define PIXELS_DEPTH 2u
#define PIXELS_DEPTH24 3u
#define PIXELS_STENCIL 4u

#define ACCUMULATE_ACCUMULATE 0u
#define ACCUMULATE_LOAD 1u
#define ACCUMULATE_RETURN 2u
#define ACCUMULATE_MULTIPLY 3u
#define ACCUMULATE_ADD 4u
#define ACCUMULATE_CLEAR 5u

#define WHITE_ALBEDO 2147483648u
#define BAKE_SHIFT 28u
#define BAKE_MASK 1879048192u
#define BAKE_NONE 0u
#define BAKE_LAYER 5u
#define BAKE_DOUBLED_LAYER 6u
#define BAKE_COLORS 7u

#endif
