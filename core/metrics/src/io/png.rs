//! PNG by the `image` crate.

use std::io::{BufRead, Seek, Write};

use image::codecs::png::{PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, Limits};

use crate::error::FormatError;
use crate::image::{Encoding, Image, MAX_PIXELS, MAX_SIDE, checked_pixel_count, unit_from_u8};

/// Bytes of the largest pixel of a PNG: RGBA of 16 bits.
const LARGEST_PIXEL: u64 = 8;

/// Reads display values of 8 or 16 bits. Grey becomes equal channels, a palette its colours, alpha is dropped; colour profiles and
/// gamma chunks are ignored (sRGB is assumed).
///
/// # Errors
/// If the bytes are no PNG, are damaged or cut off, or the picture is too large.
pub fn read(reader: &mut (impl BufRead + Seek)) -> Result<Image, FormatError> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE as u32);
    limits.max_image_height = Some(MAX_SIDE as u32);
    limits.max_alloc = Some(2 * LARGEST_PIXEL * MAX_PIXELS as u64);
    let decoder = PngDecoder::with_limits(reader, limits)?;
    let (width, height) = decoder.dimensions();
    let (width, height) = (width as usize, height as usize);
    checked_pixel_count(width, height)?;
    let pixels = pixels(DynamicImage::from_decoder(decoder)?);
    Image::new(width, height, Encoding::Srgb, pixels)
}

fn pixels(decoded: DynamicImage) -> Vec<[f32; 3]> {
    use DynamicImage::{ImageLuma16, ImageLumaA16, ImageRgb16, ImageRgba16};
    let sixteen_bits = matches!(decoded, ImageLuma16(_) | ImageLumaA16(_) | ImageRgb16(_) | ImageRgba16(_));
    if sixteen_bits {
        let rgb = decoded.into_rgb16();
        rgb.pixels().map(|p| p.0.map(|v| f32::from(v) / 65535.0)).collect()
    } else {
        let rgb = decoded.into_rgb8();
        rgb.pixels().map(|p| p.0.map(unit_from_u8)).collect()
    }
}

/// Writes 8 bits a channel, sRGB-encoded and clamped, rounded to nearest; NaN becomes 0.
///
/// # Errors
/// If the writer fails.
pub fn write(image: &Image, writer: &mut impl Write) -> Result<(), FormatError> {
    let (width, height) = (image.width() as u32, image.height() as u32);
    let bytes = image.to_rgb8();
    Ok(PngEncoder::new(writer).write_image(&bytes, width, height, ExtendedColorType::Rgb8)?)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::test_images as synthetic;

    fn encoded(bytes: &[u8], width: u32, height: u32, kind: ExtendedColorType) -> Vec<u8> {
        let mut file = Vec::new();
        PngEncoder::new(&mut file).write_image(bytes, width, height, kind).unwrap();
        file
    }

    #[test]
    fn sixteen_bits_keep_their_precision() {
        let samples: Vec<u8> =
            [0u16, 1, 65535, 32768, 258, 40000].into_iter().flat_map(u16::to_ne_bytes).collect();
        let file = encoded(&samples, 2, 1, ExtendedColorType::Rgb16);
        let image = read(&mut Cursor::new(file)).unwrap();
        assert_eq!(image.encoding(), Encoding::Srgb);
        assert_eq!(image.pixel(0, 0), [0.0, 1.0 / 65535.0, 1.0]);
        assert_eq!(image.pixel(1, 0), [32768.0 / 65535.0, 258.0 / 65535.0, 40000.0 / 65535.0]);
    }

    #[test]
    fn grey_and_alpha_become_rgb() {
        let file = encoded(&[51, 0, 255, 255], 2, 1, ExtendedColorType::La8);
        let image = read(&mut Cursor::new(file)).unwrap();
        assert_eq!(image.pixels(), [[0.2; 3], [1.0; 3]]);
    }

    #[test]
    fn absurd_sizes_and_damage_are_refused() {
        let mut file = Vec::new();
        write(&synthetic::stripes(), &mut file).unwrap();
        assert!(read(&mut Cursor::new(&file)).is_ok());
        assert!(read(&mut Cursor::new(&file[..file.len() / 2])).is_err());
        assert!(read(&mut Cursor::new(b"no picture at all")).is_err());
        // A header of 2^31 - 1 pixels a side, with its right checksum.
        let mut huge = file[..8].to_vec();
        huge.extend_from_slice(b"\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x02\0\0\0");
        huge.extend_from_slice(&HUGE_CRC.to_be_bytes());
        huge.extend_from_slice(&file[33..]);
        let error = read(&mut Cursor::new(huge)).unwrap_err();
        assert!(error.to_string().to_lowercase().contains("limit"), "{error}");
    }

    /// CRC-32 of the chunk in the test above.
    const HUGE_CRC: u32 = 0x9bab_9c31;
}
