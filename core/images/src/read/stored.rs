//! What a file holds, before it is made fit for a device.

use crate::error::ImageError;
use crate::mipmaps::{self, Averaging};
use crate::picture::{Channels, Format, Picture, all_levels, level_side};
use crate::read::Abilities;
use crate::unpack;

/// How a file stores texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Layout {
    R8,
    Rg8,
    Rgb8,
    Bgr8,
    Rgba8,
    Bgra8,
    /// The fourth byte means nothing.
    Bgrx8,
    Rgbx8,
    Bc1,
    Bc1Alpha,
    Bc2,
    Bc3,
    Bc4,
    Bc5,
    Bc6h {
        is_signed: bool,
    },
    Bc7,
}

impl Layout {
    /// Bytes of a block of 4x4 texels, if texels come in such blocks.
    pub(crate) fn block_bytes(self) -> Option<usize> {
        match self {
            Layout::Bc1 | Layout::Bc1Alpha | Layout::Bc4 => Some(8),
            Layout::Bc2 | Layout::Bc3 | Layout::Bc5 | Layout::Bc6h { .. } | Layout::Bc7 => Some(16),
            _ => None,
        }
    }

    /// Bytes of a texel that stands alone.
    pub(crate) fn texel_bytes(self) -> usize {
        match self {
            Layout::R8 => 1,
            Layout::Rg8 => 2,
            Layout::Rgb8 | Layout::Bgr8 => 3,
            _ => 4,
        }
    }

    /// Bytes of a level; sides are at most [`MOST_SIDE`](crate::MOST_SIDE).
    pub(crate) fn bytes(self, width: u32, height: u32) -> usize {
        match self.block_bytes() {
            Some(block) => width.div_ceil(4) as usize * height.div_ceil(4) as usize * block,
            None => width as usize * height as usize * self.texel_bytes(),
        }
    }

    /// Which channels mean something.
    fn channels(self) -> Channels {
        match self {
            Layout::R8 | Layout::Bc4 => Channels::Grey,
            Layout::Rg8 | Layout::Bc5 => Channels::Two,
            Layout::Rgb8
            | Layout::Bgr8
            | Layout::Bgrx8
            | Layout::Rgbx8
            | Layout::Bc1
            | Layout::Bc6h { .. } => Channels::Rgb,
            Layout::Rgba8 | Layout::Bgra8 | Layout::Bc1Alpha | Layout::Bc2 | Layout::Bc3 | Layout::Bc7 => {
                Channels::Rgba
            }
        }
    }

    /// As devices have it that take blocks. Not BC6H: what it holds is linear, and all other colours are not.
    fn compressed(self) -> Option<Format> {
        Some(match self {
            Layout::Bc1 => Format::Bc1,
            Layout::Bc1Alpha => Format::Bc1Alpha,
            Layout::Bc2 => Format::Bc2,
            Layout::Bc3 => Format::Bc3,
            Layout::Bc4 => Format::Bc4,
            Layout::Bc5 => Format::Bc5,
            Layout::Bc7 => Format::Bc7,
            _ => return None,
        })
    }
}

/// A file's texels.
pub(crate) struct Stored {
    pub(crate) layout: Layout,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// At least one. Each has as many bytes as [`Layout::bytes`] says.
    pub(crate) levels: Vec<Vec<u8>>,
}

impl Stored {
    /// Cuts levels that follow one another out of `data`.
    ///
    /// # Errors
    /// If there is not enough of it, or there cannot be so many levels.
    pub(crate) fn cut(
        layout: Layout,
        [width, height]: [u32; 2],
        levels: u32,
        data: &[u8],
    ) -> Result<Self, ImageError> {
        let count = levels.max(1);
        if count > all_levels(width, height) {
            return Err(ImageError::Damaged(format!("{levels} levels")));
        }
        let mut rest = data;
        let mut cut = Vec::new();
        for level in 0..count {
            let bytes = layout.bytes(level_side(width, level), level_side(height, level));
            let (texels, after) =
                rest.split_at_checked(bytes).ok_or_else(|| ImageError::damaged("texels are missing"))?;
            cut.push(texels.to_vec());
            rest = after;
        }
        Ok(Self { layout, width, height, levels: cut })
    }

    /// A picture with mipmaps.
    pub(crate) fn picture(self, averaging: Averaging, abilities: Abilities) -> Result<Picture, ImageError> {
        let Stored { layout, width, height, mut levels } = self;
        let has_mipmaps = levels.len() > 1 || all_levels(width, height) == 1;
        let compressed = layout.compressed().filter(|_| abilities.compressed && has_mipmaps);
        let format = match (compressed, layout) {
            (Some(format), _) => format,
            (None, Layout::Bc6h { .. }) => Format::Rgba16F,
            _ => Format::Rgba8,
        };
        if compressed.is_none() {
            for (level, texels) in (0..).zip(&mut levels) {
                *texels = unpack::unpack(layout, level_side(width, level), level_side(height, level), texels);
            }
        }
        if !has_mipmaps {
            mipmaps::add(&mut levels, [width, height], format, averaging);
        }
        Ok(Picture { format, channels: layout.channels(), width, height, levels })
    }
}
