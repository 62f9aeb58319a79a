// Vertices of a draw of a traced view, without clip planes.
#version 460
#extension GL_GOOGLE_include_directive : require
#define WITH_VISIBILITY
#include "../raster/vertex.glsl"
