// Vertices of a draw of a traced view with clip planes.
#version 460
#extension GL_GOOGLE_include_directive : require
#define WITH_VISIBILITY
#define WITH_CLIP_PLANES
out float gl_ClipDistance[6];
#include "../raster/vertex.glsl"
