// From light and surface to what a pixel shows.

#ifndef AFTERGLOW_PATHTRACE_RESOLVE_GLSL
#define AFTERGLOW_PATHTRACE_RESOLVE_GLSL

#include "color.glsl"
#include "../denoise/upsample.glsl"
#include "surface.glsl"

// Radiance of a pixel before exposure. `program` is the picture that the program itself made, linear.
vec3 radiance(SurfaceTexel surface, SeenLight light, vec3 program) {
    vec3 albedo = linear_from_srgb(unpack_unorm11(surface.albedo));
    switch (surface_kind(surface)) {
        case SURFACE_LIT:
            return albedo * (light.direct + light.indirect) + light.specular + unpack_shared_exponent(surface.emission);
        case SURFACE_CATCHER: return program * (light.direct + light.indirect);
        case SURFACE_BAKED: return program * light.indirect;
        default: return albedo * light.indirect;
    }
}

// The program's fog at a pixel; only such pixels have any whose draw is known.
vec3 fog_color(ViewRecord view, uint draw) {
    uint environment = SurfaceDrawTable(view.draws).entries[draw].environment;
    return EnvironmentTable(FrameTable(view.frame).entries[0].environments).entries[environment].fog_color.rgb;
}

#endif
