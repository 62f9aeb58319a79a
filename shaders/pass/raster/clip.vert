// Vertices of a draw with clip planes. A shader that writes clip distances is clipped by all of them,
// so this is a shader of its own.
#version 460
#define WITH_CLIP_PLANES
out float gl_ClipDistance[6];
#include "vertex.glsl"
