// Written by afterglow-gen (./x gen) from the declarations in Rust; not to be edited.
#ifndef GENERATED_BLOCKS
#define GENERATED_BLOCKS

#ifndef STRUCT_Transform
#define STRUCT_Transform
struct Transform { // 228 bytes
    mat4 modelview;
    mat4 projection;
    mat4 modelview_projection;
    mat3 normal;
};
#endif

#ifndef STRUCT_Light
#define STRUCT_Light
struct Light { // 96 bytes
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
    vec4 position;
    vec3 spot_direction;
    float spot_exponent;
    vec3 attenuation;
    float spot_cos_cutoff;
};
#endif

#ifndef STRUCT_Lights
#define STRUCT_Lights
struct Lights { // 784 bytes
    Light lights[8];
    vec4 scene_ambient;
};
#endif

#ifndef STRUCT_MaterialFace
#define STRUCT_MaterialFace
struct MaterialFace { // 68 bytes
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
    vec4 emission;
    float shininess;
};
#endif

#ifndef STRUCT_Material
#define STRUCT_Material
struct Material { // 136 bytes
    MaterialFace faces[2];
};
#endif

#ifndef STRUCT_Environment
#define STRUCT_Environment
struct Environment { // 272 bytes
    mat4 env_color;
    vec4 lod_bias;
    vec4 fog_color;
    float fog_density;
    float fog_start;
    float fog_end;
    float alpha_reference;
    float point_size;
    float point_size_min;
    float point_size_max;
    float point_fade_threshold;
    vec3 point_attenuation;
    float line_width;
    uint polygon_stipple[32];
};
#endif

#ifndef STRUCT_TexGenUnit
#define STRUCT_TexGenUnit
struct TexGenUnit { // 128 bytes
    mat4 object;
    mat4 eye;
};
#endif

#ifndef STRUCT_TexGen
#define STRUCT_TexGen
struct TexGen { // 512 bytes
    TexGenUnit units[4];
};
#endif

#ifndef STRUCT_Matrix
#define STRUCT_Matrix
struct Matrix { // 64 bytes
    mat4 columns;
};
#endif

#ifndef STRUCT_TextureMatrices
#define STRUCT_TextureMatrices
struct TextureMatrices { // 256 bytes
    Matrix units[4];
};
#endif

#ifndef STRUCT_Plane
#define STRUCT_Plane
struct Plane { // 16 bytes
    vec4 coefficients;
};
#endif

#ifndef STRUCT_ClipPlanes
#define STRUCT_ClipPlanes
struct ClipPlanes { // 96 bytes
    Plane planes[6];
};
#endif

#ifndef STRUCT_CurrentAttributes
#define STRUCT_CurrentAttributes
struct CurrentAttributes { // 128 bytes
    vec4 normal;
    vec4 color;
    vec4 secondary;
    vec4 fog;
    Plane texture[4];
};
#endif

#endif
