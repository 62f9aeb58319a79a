// Nothing was met.
#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "trace_payload.glsl"

layout(location = 0) rayPayloadInEXT TracePayload met;

void main() {
    met.instance = NO_INSTANCE;
}
