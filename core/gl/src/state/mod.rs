//! The state of a context, in the groups that glPushAttrib saves (OpenGL 1.5, table 6.x).

mod caps;
mod defaults;
mod groups;

pub use caps::{Cap, Caps};
pub use groups::*;

/// All server state that attribute groups cover.
#[derive(Debug, Clone)]
pub struct State {
    /// glEnable flags.
    pub caps: Caps,
    /// GL_CURRENT_BIT.
    pub current: Current,
    /// GL_POINT_BIT.
    pub point: Point,
    /// GL_LINE_BIT.
    pub line: Line,
    /// GL_POLYGON_BIT.
    pub polygon: Polygon,
    /// GL_POLYGON_STIPPLE_BIT.
    pub polygon_stipple: [u8; 128],
    /// GL_PIXEL_MODE_BIT.
    pub pixel: PixelMode,
    /// GL_LIGHTING_BIT.
    pub lighting: Lighting,
    /// GL_FOG_BIT.
    pub fog: Fog,
    /// GL_DEPTH_BUFFER_BIT.
    pub depth: DepthBuffer,
    /// GL_ACCUM_BUFFER_BIT: the clear value.
    pub accum_clear: [f32; 4],
    /// GL_STENCIL_BUFFER_BIT.
    pub stencil: StencilBuffer,
    /// GL_VIEWPORT_BIT.
    pub viewport: ViewportState,
    /// GL_TRANSFORM_BIT.
    pub transform: TransformState,
    /// GL_COLOR_BUFFER_BIT.
    pub color: ColorBuffer,
    /// GL_HINT_BIT: in the order of [`HINTS`].
    pub hints: [u32; HINTS.len()],
    /// GL_LIST_BIT: glListBase.
    pub list_base: u32,
    /// GL_TEXTURE_BIT without the bindings.
    pub texture: TextureState,
    /// GL_SCISSOR_BIT.
    pub scissor: crate::frame::Rect,
}
