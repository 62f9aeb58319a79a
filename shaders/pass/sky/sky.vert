// Vertices of a draw of the sky, on all sides of the cube about the eye at once.
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#define SKY_SIDE gl_ViewIndex
#include "../raster/vertex.glsl"
