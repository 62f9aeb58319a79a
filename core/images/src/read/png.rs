//! PNG by the `image` crate.

use std::io::Cursor;

use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder, Limits};

use super::stored::{Layout, Stored};
use crate::error::ImageError;
use crate::picture::{MOST_SIDE, MOST_TEXELS, check_size};

/// Bytes of the largest texel of a PNG: RGBA of 16 bits.
const LARGEST_TEXEL: u64 = 8;

/// Reads texels of 8 or 16 bits; of the latter the upper 8 are kept. Colour profiles and gamma are ignored.
pub(super) fn read(bytes: &[u8]) -> Result<Stored, ImageError> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST_SIDE);
    limits.max_image_height = Some(MOST_SIDE);
    limits.max_alloc = Some(2 * LARGEST_TEXEL * MOST_TEXELS);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(ImageError::damaged)?;
    let (width, height) = decoder.dimensions();
    check_size(width, height)?;
    let decoded = DynamicImage::from_decoder(decoder).map_err(ImageError::damaged)?;
    // Transparent colours and palettes have become alpha.
    let has_alpha = decoded.color().has_alpha();
    let (layout, texels) = match decoded {
        DynamicImage::ImageLuma8(grey) => (Layout::R8, grey.into_raw()),
        decoded if has_alpha => (Layout::Rgba8, decoded.into_rgba8().into_raw()),
        decoded => (Layout::Rgb8, decoded.into_rgb8().into_raw()),
    };
    Ok(Stored { layout, width, height, levels: vec![texels] })
}
