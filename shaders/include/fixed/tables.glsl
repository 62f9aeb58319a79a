// The frame's tables, read through device addresses.
//
// The includer enables GL_EXT_buffer_reference, GL_EXT_scalar_block_layout and
// GL_EXT_shader_explicit_arithmetic_types_int64.

#ifndef AFTERGLOW_FIXED_TABLES_GLSL
#define AFTERGLOW_FIXED_TABLES_GLSL

#include "../generated/gl_blocks.glsl"
#include "../generated/records.glsl"

#define TABLE(NAME, TYPE) \
    layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer NAME { TYPE entries[]; }

TABLE(Words, uint);
TABLE(FrameTable, FrameRecord);
TABLE(DrawTable, DrawRecord);
TABLE(PixelTable, PixelRecord);
TABLE(TransformTable, Transform);
TABLE(LightsTable, Lights);
TABLE(MaterialTable, Material);
TABLE(EnvironmentTable, Environment);
TABLE(TexGenTable, TexGen);
TABLE(TextureMatricesTable, TextureMatrices);
TABLE(ClipPlanesTable, ClipPlanes);
TABLE(CurrentTable, CurrentAttributes);

#endif
