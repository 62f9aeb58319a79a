//! Pixel formats as far as the graph needs them: how many bytes a pixel has, and whether it is depth.

/// A pixel format; the device crate maps each to its API's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    R8Unorm,
    R8Uint,
    Rg8Unorm,
    Rgba8Unorm,
    Rgba8Srgb,
    Bgra8Unorm,
    Bgra8Srgb,
    /// Ten bits each of red, green and blue, two of alpha.
    Rgb10A2Unorm,
    /// Unsigned floats of 11, 11 and 10 bits.
    Rg11B10Float,
    /// Three mantissas of nine bits with a shared exponent of five.
    Rgb9E5Float,
    R16Uint,
    R16Float,
    Rg16Float,
    Rg16Snorm,
    Rgba16Unorm,
    Rgba16Snorm,
    Rgba16Float,
    R32Uint,
    R32Float,
    Rg32Uint,
    Rg32Float,
    Rgba32Uint,
    Rgba32Float,
    D16Unorm,
    D32Float,
    S8Uint,
    D24UnormS8Uint,
    D32FloatS8Uint,
}

impl Format {
    /// Bytes of payload a pixel (one sample), without any padding that a device may add.
    pub const fn bytes_per_pixel(self) -> u32 {
        match self {
            Self::R8Unorm | Self::R8Uint | Self::S8Uint => 1,
            Self::Rg8Unorm | Self::R16Uint | Self::R16Float | Self::D16Unorm => 2,
            Self::Rgba8Unorm
            | Self::Rgba8Srgb
            | Self::Bgra8Unorm
            | Self::Bgra8Srgb
            | Self::Rgb10A2Unorm
            | Self::Rg11B10Float
            | Self::Rgb9E5Float
            | Self::Rg16Float
            | Self::Rg16Snorm
            | Self::R32Uint
            | Self::R32Float
            | Self::D32Float
            | Self::D24UnormS8Uint => 4,
            Self::D32FloatS8Uint => 5,
            Self::Rgba16Unorm | Self::Rgba16Snorm | Self::Rgba16Float | Self::Rg32Uint | Self::Rg32Float => 8,
            Self::Rgba32Uint | Self::Rgba32Float => 16,
        }
    }

    /// Whether the format holds depth, stencil or both, and no colour.
    pub const fn is_depth_stencil(self) -> bool {
        matches!(
            self,
            Self::D16Unorm | Self::D32Float | Self::S8Uint | Self::D24UnormS8Uint | Self::D32FloatS8Uint
        )
    }
}
