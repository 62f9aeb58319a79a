// Fragments of a draw.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "fragment.glsl"
