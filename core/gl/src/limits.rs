//! Limits that the implementation has, as glGet tells them.

/// GL_MAX_MODELVIEW_STACK_DEPTH.
pub const MODELVIEW_STACK: usize = 64;
/// GL_MAX_PROJECTION_STACK_DEPTH.
pub const PROJECTION_STACK: usize = 32;
/// GL_MAX_TEXTURE_STACK_DEPTH.
pub const TEXTURE_STACK: usize = 10;
/// GL_MAX_ATTRIB_STACK_DEPTH and its client twin.
pub const ATTRIB_STACK: usize = 16;
/// GL_MAX_LIST_NESTING.
pub const LIST_NESTING: u32 = 64;
/// Lists that one glCallList may execute, those that lists call included.
pub const LIST_EXECUTIONS: u32 = 1 << 18;
/// GL_MAX_NAME_STACK_DEPTH.
pub const NAME_STACK: usize = 64;
/// GL_MAX_VIEWPORT_DIMS.
pub const VIEWPORT: i32 = 16384;
/// Greatest point size.
pub const POINT_SIZE_MAX: f32 = 255.0;
/// Greatest line width.
pub const LINE_WIDTH_MAX: f32 = 255.0;
/// GL_MAX_ELEMENTS_VERTICES and GL_MAX_ELEMENTS_INDICES.
pub const ELEMENTS: i32 = 65536;
/// Vertices of one draw; more is GL_OUT_OF_MEMORY.
pub const DRAW_VERTICES: usize = 1 << 26;
/// Words of vertices that a frame may hold before it is handed over early.
pub const FRAME_WORDS: usize = 1 << 23;
/// Bytes of a buffer object.
pub const BUFFER_BYTES: usize = 1 << 31;
/// Names that one glGen call may ask for.
pub const GENERATED_NAMES: i32 = 1 << 20;
