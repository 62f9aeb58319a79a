// Which triangle a hit names, and whether a ray that meets it there goes through. Includers get the push constants of a
// view's passes with it.

#ifndef AFTERGLOW_PATHTRACE_ACCEPT_GLSL
#define AFTERGLOW_PATHTRACE_ACCEPT_GLSL

#include "hit.glsl"
#include "tables.glsl"

layout(push_constant, scalar) uniform Push { ViewPush push; };

uint member_of(ViewRecord view, uint instance, uint primitive, out uint triangle) {
    MeshMember member = MemberTable(view.members).entries[instance + (primitive >> MEMBER_SHIFT)];
    triangle = member.first_triangle + (primitive & ((1u << MEMBER_SHIFT) - 1u));
    return member.draw;
}

vec3 corner_weights(vec2 barycentrics) {
    return vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
}

bool accept_hit(uint instance, uint primitive, vec2 barycentrics) {
    ViewRecord view = ViewTable(push.view).entries[0];
    uint triangle;
    uint draw = member_of(view, instance, primitive, triangle);
    return is_solid(view, draw, triangle, corner_weights(barycentrics));
}

#endif
