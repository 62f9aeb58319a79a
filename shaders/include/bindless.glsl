// The one descriptor set: every image and sampler, named by index. Twin of core/gpu/src/bindless.rs.
//
// The includer enables GL_EXT_nonuniform_qualifier, for arrays without a length.

#ifndef AFTERGLOW_BINDLESS_GLSL
#define AFTERGLOW_BINDLESS_GLSL

layout(set = 0, binding = 0) uniform texture2D textures_2d[];
layout(set = 0, binding = 1) uniform textureCube textures_cube[];
layout(set = 0, binding = 2) uniform texture3D textures_3d[];
layout(set = 0, binding = 3) uniform sampler samplers[];

#endif
