// The closest hit, of a triangle or a sphere. A geometry is a mesh's member.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require

#include "generated/pathtrace.glsl"
#include "trace_payload.glsl"

layout(location = 0) rayPayloadInEXT TracePayload met;
hitAttributeEXT vec2 barycentrics;

void main() {
    uint primitive = uint(gl_GeometryIndexEXT) << MEMBER_SHIFT | uint(gl_PrimitiveID);
    bool front = gl_HitKindEXT == gl_HitKindFrontFacingTriangleEXT || gl_HitKindEXT == SPHERE_FRONT;
    met = TracePayload(gl_HitTEXT, barycentrics, primitive, uint(gl_InstanceCustomIndexEXT), uint(front));
}
