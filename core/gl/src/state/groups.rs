//! The groups of state.

use afterglow_api::constants::*;
use glam::Vec4;

use crate::frame::{CLIP_PLANES, Light, Material, SLOTS, TEXTURE_UNITS, TexGenUnit, UnitWords};

/// Current attributes and raster position.
#[derive(Debug, Clone)]
pub struct Current {
    /// By [`Slot`](crate::frame::Slot); the position's entry is unused.
    pub attributes: [Vec4; SLOTS],
    /// Edge flag.
    pub edge_flag: bool,
    /// Colour index (kept for glGet only).
    pub index: f32,
    /// Current raster position.
    pub raster: RasterPosition,
}

/// The current raster position and what belongs to it.
#[derive(Debug, Clone)]
pub struct RasterPosition {
    /// Window coordinates x, y, z (0 to 1) and clip w.
    pub window: [f32; 4],
    /// Whether it was inside the clip volume.
    pub valid: bool,
    /// Eye distance.
    pub distance: f32,
    /// Its colour, lit if lighting is on.
    pub color: [f32; 4],
    /// Its secondary colour.
    pub secondary: [f32; 4],
    /// Its texture coordinates.
    pub texture: [[f32; 4]; TEXTURE_UNITS],
}

/// Points.
#[derive(Debug, Clone)]
pub struct Point {
    /// Size in pixels.
    pub size: f32,
    /// Least size after attenuation.
    pub size_min: f32,
    /// Greatest size after attenuation.
    pub size_max: f32,
    /// Fade threshold.
    pub fade_threshold: f32,
    /// Constant, linear, quadratic.
    pub attenuation: [f32; 3],
}

/// Lines.
#[derive(Debug, Clone)]
pub struct Line {
    /// Width in pixels.
    pub width: f32,
    /// Stipple factor, 1 to 256.
    pub stipple_factor: u16,
    /// Stipple pattern.
    pub stipple_pattern: u16,
}

/// Polygons.
#[derive(Debug, Clone)]
pub struct Polygon {
    /// GL_FRONT, GL_BACK or GL_FRONT_AND_BACK.
    pub cull_face: u32,
    /// GL_CW or GL_CCW.
    pub front_face: u32,
    /// Mode of front and back faces.
    pub mode: [u32; 2],
    /// Polygon offset factor and units.
    pub offset: (f32, f32),
}

/// Pixel operations.
#[derive(Debug, Clone)]
pub struct PixelMode {
    /// glPixelZoom.
    pub zoom: (f32, f32),
    /// glReadBuffer.
    pub read_buffer: u32,
}

/// Lights, materials, light model.
#[derive(Debug, Clone)]
pub struct Lighting {
    /// The lights in eye space.
    pub lights: [Light; crate::frame::LIGHTS],
    /// Cut-off angles in degrees as given (the lights hold cosines).
    pub cutoffs: [f32; crate::frame::LIGHTS],
    /// Which lights are enabled.
    pub enabled: u8,
    /// GL_LIGHT_MODEL_AMBIENT.
    pub model_ambient: [f32; 4],
    /// GL_LIGHT_MODEL_LOCAL_VIEWER.
    pub local_viewer: bool,
    /// GL_LIGHT_MODEL_TWO_SIDE.
    pub two_side: bool,
    /// GL_LIGHT_MODEL_COLOR_CONTROL is separate.
    pub separate_specular: bool,
    /// Material of both sides.
    pub material: Material,
    /// glColorMaterial's face.
    pub color_material_face: u32,
    /// glColorMaterial's mode.
    pub color_material_mode: u32,
    /// GL_SMOOTH or GL_FLAT.
    pub shade_model: u32,
    /// GL_SINGLE_COLOR (the vertex processing's view of ambient etc.) has no other state.
    pub color_indexes: [[f32; 3]; 2],
}

/// Fog.
#[derive(Debug, Clone)]
pub struct Fog {
    /// GL_LINEAR, GL_EXP, GL_EXP2.
    pub mode: u32,
    /// Colour.
    pub color: [f32; 4],
    /// Density.
    pub density: f32,
    /// Start of linear fog.
    pub start: f32,
    /// End of linear fog.
    pub end: f32,
    /// Colour index (kept for glGet only).
    pub index: f32,
    /// GL_FRAGMENT_DEPTH or GL_FOG_COORDINATE.
    pub coordinate_source: u32,
}

/// Depth buffer.
#[derive(Debug, Clone)]
pub struct DepthBuffer {
    /// Comparison, GL_NEVER and so on.
    pub func: u32,
    /// Write mask.
    pub mask: bool,
    /// Clear value.
    pub clear: f64,
}

/// Stencil buffer.
#[derive(Debug, Clone)]
pub struct StencilBuffer {
    /// Comparison.
    pub func: u32,
    /// Reference value.
    pub reference: i32,
    /// Mask of the comparison.
    pub value_mask: u32,
    /// Operations: stencil fails, depth fails, passes.
    pub ops: [u32; 3],
    /// Write mask.
    pub write_mask: u32,
    /// Clear value.
    pub clear: i32,
}

/// Viewport and depth range.
#[derive(Debug, Clone)]
pub struct ViewportState {
    /// glViewport.
    pub rect: crate::frame::Rect,
    /// Near and far.
    pub depth_range: [f64; 2],
}

/// Matrix mode and clip planes.
#[derive(Debug, Clone)]
pub struct TransformState {
    /// GL_MODELVIEW and so on.
    pub matrix_mode: u32,
    /// Planes in eye space.
    pub clip_planes: [[f64; 4]; CLIP_PLANES],
    /// Which are enabled.
    pub clip_enabled: u8,
}

/// Colour buffer.
#[derive(Debug, Clone)]
pub struct ColorBuffer {
    /// Clear value.
    pub clear: [f32; 4],
    /// Clear index (kept for glGet only).
    pub clear_index: f32,
    /// Write mask of red, green, blue, alpha.
    pub mask: [bool; 4],
    /// Index mask (kept for glGet only).
    pub index_mask: u32,
    /// Alpha comparison.
    pub alpha_func: u32,
    /// Alpha reference.
    pub alpha_reference: f32,
    /// Source and destination factor, colour then alpha.
    pub blend: [[u32; 2]; 2],
    /// Blend equation, colour then alpha.
    pub equation: [u32; 2],
    /// Blend colour.
    pub blend_color: [f32; 4],
    /// Logic operation.
    pub logic_op: u32,
    /// glDrawBuffer.
    pub draw_buffer: u32,
}

/// Hints that are kept.
pub const HINTS: [u32; 7] = [
    GL_PERSPECTIVE_CORRECTION_HINT,
    GL_POINT_SMOOTH_HINT,
    GL_LINE_SMOOTH_HINT,
    GL_POLYGON_SMOOTH_HINT,
    GL_FOG_HINT,
    GL_GENERATE_MIPMAP_HINT,
    GL_TEXTURE_COMPRESSION_HINT,
];

/// Texture units.
#[derive(Debug, Clone)]
pub struct TextureState {
    /// glActiveTexture, from 0.
    pub active: usize,
    /// The units.
    pub units: [TextureUnit; TEXTURE_UNITS],
}

/// A texture target's index: one-, two-, three-dimensional, cube.
pub const TARGETS: [u32; 4] = [GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP];

/// One texture unit without what is bound.
#[derive(Debug, Clone)]
pub struct TextureUnit {
    /// Enabled targets, a bit for each of [`TARGETS`].
    pub targets: u8,
    /// Enabled texture generation, a bit for each of s, t, r, q.
    pub gen_enabled: u8,
    /// Texture generation modes for s, t, r, q.
    pub gen_mode: [u32; 4],
    /// Texture generation planes.
    pub gen_planes: TexGenUnit,
    /// GL_TEXTURE_ENV_COLOR.
    pub env_color: [f32; 4],
    /// GL_TEXTURE_LOD_BIAS of the unit.
    pub lod_bias: f32,
    /// Environment mode, combiners and GL_COORD_REPLACE, packed.
    pub words: UnitWords,
}
