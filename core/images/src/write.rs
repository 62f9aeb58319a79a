//! Textures as files.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use crate::error::ImageError;

/// Writes texels of four bytes, the first row first, as a PNG: without alpha if all of it is 255.
///
/// # Errors
/// If it cannot be written, or there are not as many texels as the size says.
pub fn write_png(path: &Path, [width, height]: [u32; 2], rgba: &[u8]) -> Result<(), ImageError> {
    let (texels, rest) = rgba.as_chunks::<4>();
    if !rest.is_empty() || texels.len() as u64 != u64::from(width) * u64::from(height) {
        return Err(ImageError::Damaged(format!("{} bytes for {width}x{height} texels", rgba.len())));
    }
    let encoder = PngEncoder::new(BufWriter::new(File::create(path)?));
    let written = if texels.iter().all(|texel| texel[3] == 255) {
        let rgb: Vec<u8> = texels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        encoder.write_image(&rgb, width, height, ExtendedColorType::Rgb8)
    } else {
        encoder.write_image(rgba, width, height, ExtendedColorType::Rgba8)
    };
    written.map_err(|error| ImageError::Unreadable(std::io::Error::other(error)))
}
