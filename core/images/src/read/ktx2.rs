//! KTX2 by the `ktx2` crate, with or without zstd (Khronos, KTX File Format Specification, version 2).

use std::io::Read;

use ktx2::{Format, Reader, SupercompressionScheme};
use ruzstd::decoding::StreamingDecoder;

use super::stored::{Layout, Stored};
use crate::error::ImageError;
use crate::picture::{all_levels, check_size, level_side};

/// Reads a two-dimensional picture. Which of UNORM and SRGB a format is makes no difference: texels stay as they are.
pub(super) fn read(bytes: &[u8]) -> Result<Stored, ImageError> {
    let reader = Reader::new(bytes).map_err(ImageError::damaged)?;
    let header = reader.header();
    let (width, height) = (header.pixel_width, header.pixel_height.max(1));
    check_size(width, height)?;
    match () {
        () if header.pixel_depth > 1 => return Err(ImageError::Kind("three-dimensional pictures")),
        () if header.layer_count > 1 => return Err(ImageError::Kind("arrays of pictures")),
        () if header.face_count > 1 => return Err(ImageError::Kind("cube maps")),
        () if header.level_count > all_levels(width, height) => {
            return Err(ImageError::Damaged(format!("{} levels", header.level_count)));
        }
        () => {}
    }
    let layout = header.format.and_then(layout);
    let layout = layout.ok_or_else(|| ImageError::Format(format!("{:?}", header.format)))?;
    let levels = (0..).zip(reader.levels()).map(|(level, stored)| {
        let bytes = layout.bytes(level_side(width, level), level_side(height, level));
        unpacked(stored.data, header.supercompression_scheme, bytes)
    });
    let levels = levels.collect::<Result<_, _>>()?;
    Ok(Stored { layout, width, height, levels })
}

/// A level's texels, of which there must be so many bytes.
fn unpacked(
    data: &[u8],
    scheme: Option<SupercompressionScheme>,
    bytes: usize,
) -> Result<Vec<u8>, ImageError> {
    let texels = match scheme {
        None => data.to_vec(),
        Some(SupercompressionScheme::Zstandard) => {
            let mut decoder = StreamingDecoder::new(data).map_err(ImageError::damaged)?;
            let mut texels = Vec::new();
            decoder.by_ref().take(bytes as u64 + 1).read_to_end(&mut texels).map_err(ImageError::damaged)?;
            texels
        }
        Some(other) => return Err(ImageError::Format(format!("{other:?}"))),
    };
    if texels.len() != bytes {
        return Err(ImageError::Damaged(format!("a level of {} bytes, not {bytes}", texels.len())));
    }
    Ok(texels)
}

fn layout(format: Format) -> Option<Layout> {
    Some(match format {
        Format::R8_UNORM | Format::R8_SRGB => Layout::R8,
        Format::R8G8_UNORM | Format::R8G8_SRGB => Layout::Rg8,
        Format::R8G8B8_UNORM | Format::R8G8B8_SRGB => Layout::Rgb8,
        Format::B8G8R8_UNORM | Format::B8G8R8_SRGB => Layout::Bgr8,
        Format::R8G8B8A8_UNORM | Format::R8G8B8A8_SRGB => Layout::Rgba8,
        Format::B8G8R8A8_UNORM | Format::B8G8R8A8_SRGB => Layout::Bgra8,
        Format::BC1_RGB_UNORM_BLOCK | Format::BC1_RGB_SRGB_BLOCK => Layout::Bc1,
        Format::BC1_RGBA_UNORM_BLOCK | Format::BC1_RGBA_SRGB_BLOCK => Layout::Bc1Alpha,
        Format::BC2_UNORM_BLOCK | Format::BC2_SRGB_BLOCK => Layout::Bc2,
        Format::BC3_UNORM_BLOCK | Format::BC3_SRGB_BLOCK => Layout::Bc3,
        Format::BC4_UNORM_BLOCK => Layout::Bc4,
        Format::BC5_UNORM_BLOCK => Layout::Bc5,
        Format::BC6H_UFLOAT_BLOCK => Layout::Bc6h { is_signed: false },
        Format::BC6H_SFLOAT_BLOCK => Layout::Bc6h { is_signed: true },
        Format::BC7_UNORM_BLOCK | Format::BC7_SRGB_BLOCK => Layout::Bc7,
        _ => return None,
    })
}
