// Vertices of a draw without clip planes.
#version 460
#include "vertex.glsl"
