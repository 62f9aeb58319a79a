// Fragments of a draw that also leave which triangle they are of.
#version 460
#extension GL_GOOGLE_include_directive : require
#define WITH_VISIBILITY
#include "../raster/fragment.glsl"
