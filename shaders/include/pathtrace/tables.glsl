// What the passes of a view read and write, through device addresses.

#ifndef AFTERGLOW_PATHTRACE_TABLES_GLSL
#define AFTERGLOW_PATHTRACE_TABLES_GLSL

#include "../fixed/tables.glsl"
#include "../generated/pathtrace.glsl"

TABLE(ViewTable, ViewRecord);
TABLE(SurfaceDrawTable, SurfaceDraw);
TABLE(MemberTable, MeshMember);
TABLE(LightSourceTable, LightSource);
TABLE(LightNodeTable, LightNode);

#define TEXELS(NAME, TYPE) \
    layout(buffer_reference, scalar, buffer_reference_align = 4) buffer NAME { TYPE entries[]; }

TEXELS(SurfaceTexels, SurfaceTexel);
TEXELS(LightTexels, LightTexel);
TEXELS(RadianceTexels, RadianceTexel);
TEXELS(Reservoirs, ReservoirTexel);
TEXELS(Counters, TraceCounters);
TEXELS(Guides, GuideTexel);
TEXELS(Motions, MotionTexel);
TEXELS(Strata, StratumTexel);
TEXELS(Gradients, GradientTexel);
TEXELS(Fits, FitRecord);
TEXELS(Luminances, LuminanceTexel);
TEXELS(SkyTexels, vec4);
TEXELS(ExposureSums, ExposureSum);
TEXELS(MoverSums, MoverSum);
TEXELS(ExposureBuffer, Exposure);

uvec2 view_size(ViewRecord view) {
    return uvec2(view.width, view.height);
}

#endif
