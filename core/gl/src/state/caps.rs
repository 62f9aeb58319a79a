//! glEnable flags as bits.

use afterglow_api::constants::*;

macro_rules! caps {
    ($($(#[$meta:meta])* $name:ident = $gl:ident,)*) => {
        /// A capability of glEnable that is neither a light, a clip plane nor part of a texture unit.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[repr(u8)]
        pub enum Cap { $($(#[$meta])* $name,)* }

        impl Cap {
            /// The capability that an enumerant names.
            pub fn from_gl(cap: u32) -> Option<Cap> {
                match cap { $($gl => Some(Cap::$name),)* _ => None }
            }
        }
    };
}

caps! {
    AlphaTest = GL_ALPHA_TEST,
    AutoNormal = GL_AUTO_NORMAL,
    Blend = GL_BLEND,
    ColorLogicOp = GL_COLOR_LOGIC_OP,
    IndexLogicOp = GL_INDEX_LOGIC_OP,
    ColorMaterial = GL_COLOR_MATERIAL,
    ColorSum = GL_COLOR_SUM,
    CullFace = GL_CULL_FACE,
    DepthTest = GL_DEPTH_TEST,
    Dither = GL_DITHER,
    Fog = GL_FOG,
    Lighting = GL_LIGHTING,
    LineSmooth = GL_LINE_SMOOTH,
    LineStipple = GL_LINE_STIPPLE,
    Multisample = GL_MULTISAMPLE,
    Normalize = GL_NORMALIZE,
    PointSmooth = GL_POINT_SMOOTH,
    PointSprite = GL_POINT_SPRITE_ARB,
    PolygonOffsetFill = GL_POLYGON_OFFSET_FILL,
    PolygonOffsetLine = GL_POLYGON_OFFSET_LINE,
    PolygonOffsetPoint = GL_POLYGON_OFFSET_POINT,
    PolygonSmooth = GL_POLYGON_SMOOTH,
    PolygonStipple = GL_POLYGON_STIPPLE,
    RescaleNormal = GL_RESCALE_NORMAL,
    SampleAlphaToCoverage = GL_SAMPLE_ALPHA_TO_COVERAGE,
    SampleAlphaToOne = GL_SAMPLE_ALPHA_TO_ONE,
    SampleCoverage = GL_SAMPLE_COVERAGE,
    ScissorTest = GL_SCISSOR_TEST,
    StencilTest = GL_STENCIL_TEST,
    Map1Color4 = GL_MAP1_COLOR_4,
    Map1Index = GL_MAP1_INDEX,
    Map1Normal = GL_MAP1_NORMAL,
    Map1TextureCoord1 = GL_MAP1_TEXTURE_COORD_1,
    Map1TextureCoord2 = GL_MAP1_TEXTURE_COORD_2,
    Map1TextureCoord3 = GL_MAP1_TEXTURE_COORD_3,
    Map1TextureCoord4 = GL_MAP1_TEXTURE_COORD_4,
    Map1Vertex3 = GL_MAP1_VERTEX_3,
    Map1Vertex4 = GL_MAP1_VERTEX_4,
    Map2Color4 = GL_MAP2_COLOR_4,
    Map2Index = GL_MAP2_INDEX,
    Map2Normal = GL_MAP2_NORMAL,
    Map2TextureCoord1 = GL_MAP2_TEXTURE_COORD_1,
    Map2TextureCoord2 = GL_MAP2_TEXTURE_COORD_2,
    Map2TextureCoord3 = GL_MAP2_TEXTURE_COORD_3,
    Map2TextureCoord4 = GL_MAP2_TEXTURE_COORD_4,
    Map2Vertex3 = GL_MAP2_VERTEX_3,
    Map2Vertex4 = GL_MAP2_VERTEX_4,
}

/// A set of capabilities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Caps(u64);

impl Caps {
    /// Whether `cap` is in the set.
    #[inline]
    pub fn has(self, cap: Cap) -> bool {
        self.0 & Self::bit(cap) != 0
    }

    /// Puts `cap` in or takes it out; whether that changed anything.
    pub fn set(&mut self, cap: Cap, on: bool) -> bool {
        let before = self.0;
        if on {
            self.0 |= Self::bit(cap);
        } else {
            self.0 &= !Self::bit(cap);
        }
        self.0 != before
    }

    /// The set of these capabilities.
    pub fn of(caps: &[Cap]) -> Caps {
        caps.iter().fold(Caps(0), |set, &cap| Caps(set.0 | Self::bit(cap)))
    }

    /// This set, but as `other` within `mask`.
    #[must_use]
    pub fn merged(self, other: Caps, mask: Caps) -> Caps {
        Caps((self.0 & !mask.0) | (other.0 & mask.0))
    }

    const fn bit(cap: Cap) -> u64 {
        1 << cap as u8
    }
}
