// From light and surface to what a pixel shows.

#ifndef AFTERGLOW_PATHTRACE_RESOLVE_GLSL
#define AFTERGLOW_PATHTRACE_RESOLVE_GLSL

#include "color.glsl"
#include "spherical_harmonics.glsl"
#include "surface.glsl"

// Irradiance over pi of indirect light where a surface faces along a unit vector.
vec3 indirect_facing(IndirectTexel light, vec3 normal) {
    return irradiance_facing(light.color, light.towards, normal);
}

// Radiance of a pixel before exposure. `program` is the picture that the program itself made, linear.
vec3 radiance(SurfaceTexel surface, LightTexel light, vec3 indirect, vec3 program) {
    vec3 albedo = linear_from_srgb(unpack_color(surface.albedo));
    switch (surface_kind(surface)) {
        case SURFACE_LIT:
            return albedo * (light.direct + indirect) + light.specular + linear_from_srgb(unpack_color(surface.emission));
        case SURFACE_CATCHER: return program * (light.direct + indirect);
        case SURFACE_BAKED: return program * indirect;
        default: return albedo * indirect;
    }
}

// The program's fog at a pixel; only such pixels have any whose draw is known.
vec3 fog_color(ViewRecord view, uint draw) {
    uint environment = SurfaceDrawTable(view.draws).entries[draw].environment;
    return EnvironmentTable(FrameTable(view.frame).entries[0].environments).entries[environment].fog_color.rgb;
}

#endif
