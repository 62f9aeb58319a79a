//! A picture as a device takes it.

use crate::error::ImageError;

/// Texels along a side, at most.
pub const MOST_SIDE: u32 = 16384;
/// Texels of a picture's first level, at most.
pub const MOST_TEXELS: u64 = 1 << 26;

/// How texels are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Four bytes, red first.
    Rgba8,
    /// Four half floats, red first.
    Rgba16F,
    /// Blocks of 4x4 texels in 8 bytes; alpha is not used.
    Bc1,
    /// Likewise; alpha of one bit is.
    Bc1Alpha,
    /// Blocks of 4x4 texels in 16 bytes.
    Bc2,
    Bc3,
    /// One channel in 8 bytes.
    Bc4,
    /// Two channels in 16 bytes.
    Bc5,
    Bc7,
}

/// Which channels mean something; others hold anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channels {
    /// Grey, in red.
    Grey,
    /// Red and green.
    Two,
    /// Red, green and blue.
    Rgb,
    /// All four.
    Rgba,
}

/// A picture with its mipmaps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    pub format: Format,
    pub channels: Channels,
    /// Texels of the first level.
    pub width: u32,
    pub height: u32,
    /// Bytes of each level, rows tightly packed as files have them; each level's sides are half of the one's before it,
    /// rounded down, and at least 1.
    pub levels: Vec<Vec<u8>>,
}

impl Picture {
    /// Bytes of all levels.
    pub fn bytes(&self) -> u64 {
        self.levels.iter().map(|level| level.len() as u64).sum()
    }
}

/// Texels along a level's side.
pub(crate) fn level_side(side: u32, level: u32) -> u32 {
    side.checked_shr(level).unwrap_or(0).max(1)
}

/// Levels down to a single texel.
pub(crate) fn all_levels(width: u32, height: u32) -> u32 {
    width.max(height).max(1).ilog2() + 1
}

/// That a picture of this size is taken.
///
/// # Errors
/// If it is empty or too large.
pub(crate) fn check_size(width: u32, height: u32) -> Result<(), ImageError> {
    let sides = 1..=MOST_SIDE;
    let fits = sides.contains(&width)
        && sides.contains(&height)
        && u64::from(width) * u64::from(height) <= MOST_TEXELS;
    fits.then_some(()).ok_or(ImageError::Size { width, height })
}
