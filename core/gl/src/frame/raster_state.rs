//! Rasterization and the operations on fragments after they are coloured.

use std::hash::{Hash, Hasher};

/// A float that is compared and hashed by its bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct FloatBits(u32);

impl From<f32> for FloatBits {
    fn from(value: f32) -> Self {
        FloatBits(value.to_bits())
    }
}

impl FloatBits {
    /// The float.
    pub fn get(self) -> f32 {
        f32::from_bits(self.0)
    }
}

/// A comparison, numbered as GL_NEVER to GL_ALWAYS and as Vulkan's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Compare {
    /// Never passes.
    Never,
    /// Incoming < stored.
    Less,
    /// Incoming = stored.
    Equal,
    /// Incoming <= stored.
    LessEqual,
    /// Incoming > stored.
    Greater,
    /// Incoming != stored.
    NotEqual,
    /// Incoming >= stored.
    GreaterEqual,
    /// Always passes.
    Always,
}

/// A factor of blending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BlendFactor {
    Zero,
    One,
    SourceColor,
    OneMinusSourceColor,
    DestinationColor,
    OneMinusDestinationColor,
    SourceAlpha,
    OneMinusSourceAlpha,
    DestinationAlpha,
    OneMinusDestinationAlpha,
    SourceAlphaSaturate,
    ConstantColor,
    OneMinusConstantColor,
    ConstantAlpha,
    OneMinusConstantAlpha,
}

/// An equation of blending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BlendEquation {
    Add,
    Subtract,
    ReverseSubtract,
    Min,
    Max,
}

/// Blending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Blend {
    /// Source and destination factor of colour.
    pub rgb: (BlendFactor, BlendFactor),
    /// Source and destination factor of alpha.
    pub alpha: (BlendFactor, BlendFactor),
    /// Equation of colour.
    pub equation_rgb: BlendEquation,
    /// Equation of alpha.
    pub equation_alpha: BlendEquation,
    /// GL_BLEND_COLOR.
    pub constant: [FloatBits; 4],
}

/// What happens to the stencil value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StencilOp {
    Keep,
    Zero,
    Replace,
    Increment,
    Decrement,
    Invert,
    IncrementWrap,
    DecrementWrap,
}

/// Stencil test, for one or both faces alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Stencil {
    pub compare: Compare,
    pub reference: u32,
    pub compare_mask: u32,
    pub write_mask: u32,
    pub fail: StencilOp,
    pub depth_fail: StencilOp,
    pub pass: StencilOp,
}

/// Depth test. With the test off nothing is written, whatever the mask.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Depth {
    /// The comparison.
    pub compare: Compare,
    /// GL_DEPTH_WRITEMASK.
    pub write: bool,
}

/// Which polygons are dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Cull {
    #[default]
    None,
    Front,
    Back,
    FrontAndBack,
}

/// A rectangle of the window, in pixels from the lower left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Rect {
    /// Left edge.
    pub x: i32,
    /// Lower edge.
    pub y: i32,
    /// Width.
    pub width: i32,
    /// Height.
    pub height: i32,
}

/// Rasterization and per-fragment state of a draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RasterState {
    /// Blending, if enabled.
    pub blend: Option<Blend>,
    /// Logic operation (GL_CLEAR + value), if enabled; it replaces blending.
    pub logic_op: Option<u8>,
    /// Colour mask: bit 0 red, 1 green, 2 blue, 3 alpha.
    pub color_mask: u8,
    /// Depth test, if enabled.
    pub depth: Option<Depth>,
    /// Stencil test, if enabled.
    pub stencil: Option<Stencil>,
    /// Face culling (polygons only).
    pub cull: Cull,
    /// Counter-clockwise polygons are front-facing.
    pub front_ccw: bool,
    /// Polygon offset: factor, units; if enabled for what the draw is made of.
    pub depth_bias: Option<(FloatBits, FloatBits)>,
    /// Line width in pixels.
    pub line_width: FloatBits,
    /// Line stipple: factor, pattern; if enabled.
    pub line_stipple: Option<(u16, u16)>,
}

/// Quick, because every change of state between draws asks for it: what seldom differs alone is left out.
impl Hash for RasterState {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        let blend = self.blend.map_or(0, |b| {
            1 | (b.rgb.0 as u64) << 1
                | (b.rgb.1 as u64) << 5
                | (b.alpha.0 as u64) << 9
                | (b.alpha.1 as u64) << 13
        });
        let depth = self.depth.map_or(0, |d| 1 | (d.compare as u64) << 1 | u64::from(d.write) << 4);
        let stencil = self.stencil.map_or(0, |s| {
            1 | (s.compare as u64) << 1 | (s.pass as u64) << 4 | (u64::from(s.reference) & 255) << 8
        });
        let other = u64::from(self.color_mask) | (self.cull as u64) << 4 | u64::from(self.front_ccw) << 6;
        hasher.write_u64(blend | depth << 17 | stencil << 22 | other << 38);
        hasher.write_u32(self.line_width.0 ^ self.depth_bias.map_or(0, |(factor, _)| factor.0));
    }
}
