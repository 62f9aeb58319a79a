// Vertices of a draw of the sky on one side of the cube about the eye, for devices without multiview.
#version 460
#extension GL_GOOGLE_include_directive : require
// The word is free for draws that are no rectangles of pixels.
#define SKY_SIDE push.pixels
#include "../raster/vertex.glsl"
