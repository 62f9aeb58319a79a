//! Texture images and samplers as a frame names them.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::raster_state::{Compare, FloatBits, Rect};
use super::words::BaseFormat;

/// Names an image of fixed shape; unique in the process, never used again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ImageKey(pub u64);

static NEXT_IMAGE: AtomicU64 = AtomicU64::new(1);

impl ImageKey {
    /// A key that was never used before.
    pub fn unique() -> ImageKey {
        ImageKey(NEXT_IMAGE.fetch_add(1, Ordering::Relaxed))
    }
}

/// Dimensionality of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Dimension {
    /// Two dimensions (one-dimensional textures have height 1).
    D2 = 1,
    /// Three dimensions.
    D3 = 2,
    /// Six square faces, as layers in OpenGL's order (+x, -x, +y, -y, +z, -z).
    Cube = 3,
}

/// Texel storage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TexelFormat {
    /// Four bytes. Every colour base format is expanded: alpha is (0, 0, 0, A), luminance (L, L, L, 1),
    /// luminance-alpha (L, L, L, A), intensity (I, I, I, I), RGB (R, G, B, 1).
    Rgba8,
    /// One f32.
    Depth32,
}

/// Shape of an image; level 0 is the texture's base level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ImageShape {
    /// Dimensionality.
    pub dimension: Dimension,
    /// Width of level 0, texels.
    pub width: u32,
    /// Height of level 0.
    pub height: u32,
    /// Depth of level 0, 1 unless three-dimensional.
    pub depth: u32,
    /// Number of levels.
    pub levels: u32,
    /// Texel storage.
    pub format: TexelFormat,
    /// What the texels mean to the texture environment.
    pub base_format: BaseFormat,
}

/// A box of texels of one level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Region {
    /// Level.
    pub level: u32,
    /// Face of a cube map, else 0.
    pub layer: u32,
    /// First texel.
    pub offset: [u32; 3],
    /// Texels.
    pub extent: [u32; 3],
}

/// New texels, tightly packed rows from t = 0 upward.
#[derive(Debug, Clone)]
pub struct ImageUpload {
    /// Which image.
    pub image: ImageKey,
    /// Where in it.
    pub region: Region,
    /// The texels, in the image's format.
    pub texels: Arc<[u8]>,
}

/// Texels copied from the frame buffer (glCopyTexImage, glCopyTexSubImage).
#[derive(Debug, Clone, Copy)]
pub struct ImageCopy {
    /// Which image.
    pub image: ImageKey,
    /// Where in it; depth 1.
    pub region: Region,
    /// What of the window, lower left corner first; row 0 of the region is the lowest.
    pub source: Rect,
    /// What the texels mean; unused components are expanded as in [`TexelFormat::Rgba8`].
    pub base_format: BaseFormat,
}

/// Wrap mode of a texture coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wrap {
    Repeat,
    /// GL_CLAMP: to [0, 1], so that linear filtering blends with the border.
    Clamp,
    ClampToEdge,
    ClampToBorder,
    MirroredRepeat,
}

/// How a texture is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Linear magnification.
    pub mag_linear: bool,
    /// Linear minification within a level.
    pub min_linear: bool,
    /// Between levels: none (level 0 only), nearest (false), linear (true).
    pub mip_linear: Option<bool>,
    /// Wrap modes for s, t, r.
    pub wrap: [Wrap; 3],
    /// Least level of detail.
    pub min_lod: FloatBits,
    /// Greatest level of detail.
    pub max_lod: FloatBits,
    /// GL_TEXTURE_BORDER_COLOR.
    pub border_color: [FloatBits; 4],
    /// Greatest anisotropy, 1 for none.
    pub anisotropy: FloatBits,
    /// Depth comparison, if the texture compares.
    pub compare: Option<Compare>,
}

/// What a texture unit samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct TextureBinding {
    /// The image.
    pub image: ImageKey,
    /// How.
    pub sampler: Sampler,
}
