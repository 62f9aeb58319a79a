//! From the program's memory: to colours, depths, stencil values and masks (specification, 3.6.4).

use std::sync::Arc;

use afterglow_api::constants::{GL_INVALID_OPERATION, GL_OUT_OF_MEMORY};

use crate::frame::BaseFormat;

use super::GlResult;
use super::bytes::{ByteFormat, byte_format, restrict, to_rgba};
use super::element::unorm8;
use super::layout::PixelFormat;
use super::memory::{copied, filled};
use super::packed::PackedTable;
use super::rows::{Color, RowReader, bit};
use super::source::PixelSource;
use super::transfer::PixelTransfer;

/// Pixels that are converted at a time, few enough for the nearest cache.
const BLOCK: usize = 2048;

/// Texels of a texture of that base format, in its storage.
///
/// # Errors
/// GL_INVALID_OPERATION if one is a depth and the other is not; GL_OUT_OF_MEMORY.
pub fn unpack_texels(
    source: &PixelSource,
    transfer: &PixelTransfer,
    base: BaseFormat,
) -> GlResult<Arc<[u8]>> {
    let depth = source.layout().format == PixelFormat::Depth;
    match (base, depth) {
        (BaseFormat::Depth, true) => depth_bytes(source, transfer),
        (BaseFormat::Depth, false) | (_, true) => Err(GL_INVALID_OPERATION),
        _ => unpack_color(source, transfer, base),
    }
}

/// RGBA bytes, of which `base` tells what is kept; [`BaseFormat::Rgba`] keeps everything.
///
/// # Errors
/// GL_INVALID_OPERATION if the pixels are no colours; GL_OUT_OF_MEMORY.
pub fn unpack_color(source: &PixelSource, transfer: &PixelTransfer, base: BaseFormat) -> GlResult<Arc<[u8]>> {
    if !source.layout().format.is_color() {
        return Err(GL_INVALID_OPERATION);
    }
    let format = byte_format(source.layout(), source.packing().swap_bytes);
    match format.filter(|_| transfer.modes.keeps_colors()) {
        Some(format) => bytes_to_color(source, format, base),
        None => filled(size(source, 4)?, |out| match packed_table(source, transfer) {
            Some(table) => packed_to_color(source, &table, base, out),
            None => numbers_to_color(source, transfer, base, out),
        }),
    }
}

fn packed_table(source: &PixelSource, transfer: &PixelTransfer) -> Option<PackedTable> {
    let plain = transfer.modes.keeps_colors() && !source.packing().swap_bytes;
    if plain { PackedTable::new(source.layout()) } else { None }
}

fn packed_to_color(source: &PixelSource, table: &PackedTable, base: BaseFormat, out: &mut [u8]) {
    let rows = out.chunks_exact_mut((4 * source.extent().width).max(1));
    for (row, out) in source.rows().zip(rows) {
        table.convert(row, out);
        restrict(base, out);
    }
}

fn bytes_to_color(source: &PixelSource, format: ByteFormat, base: BaseFormat) -> GlResult<Arc<[u8]>> {
    let contiguous = source.contiguous();
    if let (Some(bytes), ByteFormat::Rgba, BaseFormat::Rgba) = (contiguous, format, base) {
        return copied(bytes);
    }
    let pixel_bytes = source.layout().pixel_bytes();
    filled(size(source, 4)?, |out| match contiguous {
        Some(bytes) => blocks(format, base, pixel_bytes, bytes, out),
        None => {
            let rows = out.chunks_exact_mut((4 * source.extent().width).max(1));
            for (row, out) in source.rows().zip(rows) {
                blocks(format, base, pixel_bytes, row, out);
            }
        }
    })
}

/// Converts and restricts block by block.
fn blocks(format: ByteFormat, base: BaseFormat, pixel_bytes: usize, bytes: &[u8], out: &mut [u8]) {
    for (block, out) in bytes.chunks(BLOCK * pixel_bytes).zip(out.chunks_mut(4 * BLOCK)) {
        to_rgba(format, block, out);
        if !already(format, base) {
            restrict(base, out);
        }
    }
}

/// Pixels of that order are already what the base format keeps.
fn already(format: ByteFormat, base: BaseFormat) -> bool {
    match base {
        BaseFormat::Rgba => true,
        BaseFormat::Rgb => matches!(format, ByteFormat::Rgb | ByteFormat::Bgr | ByteFormat::Single(_)),
        BaseFormat::Luminance => format == ByteFormat::Single(0x00ff_ffff),
        BaseFormat::LuminanceAlpha => format == ByteFormat::LuminanceAlpha,
        BaseFormat::Alpha => format == ByteFormat::Alpha,
        BaseFormat::Intensity | BaseFormat::Depth => false,
    }
}

fn numbers_to_color(source: &PixelSource, transfer: &PixelTransfer, base: BaseFormat, out: &mut [u8]) {
    let width = source.extent().width.max(1);
    let mut reader = RowReader::new(source.layout(), source.packing(), source.first_bit());
    let (mut numbers, mut indices, mut colors) = (Vec::new(), Vec::new(), Vec::<Color>::new());
    for (row, out) in source.rows().zip(out.chunks_exact_mut(4 * width)) {
        colors.clear();
        if source.layout().format == PixelFormat::ColorIndex {
            indices.clear();
            reader.indices(row, width, &mut indices);
            colors.extend(indices.iter().map(|index| transfer.index_to_color(*index)));
        } else {
            reader.colors(row, &mut numbers, &mut colors);
            if !transfer.modes.keeps_colors() {
                colors.iter_mut().for_each(|color| *color = transfer.color(*color));
            }
        }
        for (out, color) in out.as_chunks_mut().0.iter_mut().zip(&colors) {
            *out = color.map(unorm8);
        }
        restrict(base, out);
    }
}

/// Depths between 0 and 1.
///
/// # Errors
/// GL_INVALID_OPERATION if the pixels are no depths; GL_OUT_OF_MEMORY.
pub fn unpack_depth(source: &PixelSource, transfer: &PixelTransfer) -> GlResult<Arc<[f32]>> {
    let bytes = depth_bytes(source, transfer)?;
    Ok(bytes.as_chunks().0.iter().map(|depth| f32::from_ne_bytes(*depth)).collect())
}

fn depth_bytes(source: &PixelSource, transfer: &PixelTransfer) -> GlResult<Arc<[u8]>> {
    if source.layout().format != PixelFormat::Depth {
        return Err(GL_INVALID_OPERATION);
    }
    filled(size(source, 4)?, |out| {
        let mut reader = RowReader::new(source.layout(), source.packing(), source.first_bit());
        let mut depths = Vec::new();
        let rows = out.chunks_exact_mut((4 * source.extent().width).max(1));
        for (row, out) in source.rows().zip(rows) {
            depths.clear();
            reader.components(row, &mut depths);
            for (out, depth) in out.as_chunks_mut().0.iter_mut().zip(&depths) {
                *out = transfer.depth(*depth).to_ne_bytes();
            }
        }
    })
}

/// Stencil values, reduced to eight bits.
///
/// # Errors
/// GL_INVALID_OPERATION if the pixels are no stencil values; GL_OUT_OF_MEMORY.
pub fn unpack_stencil(source: &PixelSource, transfer: &PixelTransfer) -> GlResult<Arc<[u8]>> {
    if source.layout().format != PixelFormat::StencilIndex {
        return Err(GL_INVALID_OPERATION);
    }
    let width = source.extent().width.max(1);
    filled(size(source, 1)?, |out| {
        let mut reader = RowReader::new(source.layout(), source.packing(), source.first_bit());
        let mut indices = Vec::new();
        for (row, out) in source.rows().zip(out.chunks_exact_mut(width)) {
            indices.clear();
            reader.indices(row, width, &mut indices);
            for (out, index) in out.iter_mut().zip(&indices) {
                *out = transfer.stencil(*index) as u8;
            }
        }
    })
}

/// Bits of a bitmap (format GL_COLOR_INDEX, type GL_BITMAP), one byte each, 0 or 1. No transfer applies (3.7).
///
/// # Errors
/// GL_INVALID_OPERATION if the pixels are no bits; GL_OUT_OF_MEMORY.
pub fn unpack_mask(source: &PixelSource) -> GlResult<Arc<[u8]>> {
    if source.layout().kind != super::PixelType::Bitmap {
        return Err(GL_INVALID_OPERATION);
    }
    let (first, lsb_first) = (source.first_bit(), source.packing().lsb_first);
    filled(size(source, 1)?, |out| {
        let rows = out.chunks_exact_mut(source.extent().width.max(1));
        for (row, out) in source.rows().zip(rows) {
            for (i, out) in out.iter_mut().enumerate() {
                *out = bit(row, first + i, lsb_first).into();
            }
        }
    })
}

/// Bytes of all pixels.
fn size(source: &PixelSource, pixel_bytes: usize) -> GlResult<usize> {
    source.extent().pixels().and_then(|pixels| pixels.checked_mul(pixel_bytes)).ok_or(GL_OUT_OF_MEMORY)
}

#[cfg(test)]
mod tests {
    use afterglow_api::constants::*;

    use super::super::geometry::Extent;
    use super::super::layout::PixelLayout;
    use super::super::store::Packing;
    use super::*;

    fn source(format: u32, kind: u32, data: &[u8], width: usize) -> PixelSource<'_> {
        let layout = PixelLayout::from_gl(format, kind).unwrap();
        PixelSource::new(data, layout, &Packing::tight(), Extent::plane(width, 1)).unwrap()
    }

    fn color(format: u32, kind: u32, data: &[u8], width: usize, base: BaseFormat) -> Vec<u8> {
        let source = source(format, kind, data, width);
        unpack_color(&source, &PixelTransfer::default(), base).unwrap().to_vec()
    }

    #[test]
    fn colors_by_hand() {
        let rgb = [1, 2, 3, 250, 128, 0];
        assert_eq!(
            color(GL_RGB, GL_UNSIGNED_BYTE, &rgb, 2, BaseFormat::Rgba),
            [1, 2, 3, 255, 250, 128, 0, 255]
        );
        assert_eq!(color(GL_BGR, GL_UNSIGNED_BYTE, &rgb[..3], 1, BaseFormat::Intensity), [3, 3, 3, 3]);
        let word = 0xf81f_u16.to_ne_bytes();
        assert_eq!(color(GL_RGB, GL_UNSIGNED_SHORT_5_6_5, &word, 1, BaseFormat::Rgb), [255, 0, 255, 255]);
        let floats: Vec<u8> = [0.5f32, 2.0, -1.0, 0.2].iter().flat_map(|f| f.to_ne_bytes()).collect();
        assert_eq!(color(GL_RGBA, GL_FLOAT, &floats, 1, BaseFormat::Rgba), [128, 255, 0, 51]);
        let shorts: Vec<u8> = [0x8080u16, 0xffff].iter().flat_map(|s| s.to_ne_bytes()).collect();
        let expected = [128, 128, 128, 255];
        assert_eq!(color(GL_LUMINANCE_ALPHA, GL_UNSIGNED_SHORT, &shorts, 1, BaseFormat::Rgba), expected);
    }

    #[test]
    fn transfer_applies() {
        let mut transfer = PixelTransfer::default();
        transfer.modes.bias[3] = -0.5;
        let source = source(GL_RGB, GL_UNSIGNED_BYTE, &[51, 102, 255], 1);
        let texel = unpack_color(&source, &transfer, BaseFormat::Rgba).unwrap();
        assert_eq!(*texel, [51, 102, 255, 128]);
    }

    #[test]
    fn color_indices_use_the_tables() {
        let mut transfer = PixelTransfer::default();
        transfer.maps.set(GL_PIXEL_MAP_I_TO_G, &[0.2, 1.0]).unwrap();
        let source = source(GL_COLOR_INDEX, GL_BITMAP, &[0b0100_0000], 2);
        let texels = unpack_color(&source, &transfer, BaseFormat::Rgba).unwrap();
        assert_eq!(*texels, [0, 51, 0, 0, 0, 255, 0, 0]);
    }

    #[test]
    fn depth_stencil_and_mask() {
        let transfer = PixelTransfer::default();
        let shorts: Vec<u8> = [0u16, 0xffff].iter().flat_map(|s| s.to_ne_bytes()).collect();
        let depths = source(GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, &shorts, 2);
        assert_eq!(*unpack_depth(&depths, &transfer).unwrap(), [0.0, 1.0]);
        assert_eq!(unpack_color(&depths, &transfer, BaseFormat::Rgba), Err(GL_INVALID_OPERATION));
        assert_eq!(unpack_texels(&depths, &transfer, BaseFormat::Rgb), Err(GL_INVALID_OPERATION));
        let indices = source(GL_STENCIL_INDEX, GL_UNSIGNED_SHORT, &shorts, 2);
        assert_eq!(*unpack_stencil(&indices, &transfer).unwrap(), [0, 255]);
        let bits = source(GL_COLOR_INDEX, GL_BITMAP, &[0b1010_0000], 4);
        assert_eq!(*unpack_mask(&bits).unwrap(), [1, 0, 1, 0]);
        assert_eq!(unpack_mask(&indices), Err(GL_INVALID_OPERATION));
    }

    #[test]
    fn gaps_between_rows() {
        let layout = PixelLayout::from_gl(GL_RGB, GL_UNSIGNED_BYTE).unwrap();
        let data = [1, 1, 1, 0, 2, 2, 2];
        let source = PixelSource::new(&data, layout, &Packing::default(), Extent::plane(1, 2)).unwrap();
        let texels = unpack_color(&source, &PixelTransfer::default(), BaseFormat::Rgb).unwrap();
        assert_eq!(*texels, [1, 1, 1, 255, 2, 2, 2, 255]);
    }

    #[test]
    fn empty_images() {
        let source = source(GL_RGB, GL_UNSIGNED_SHORT, &[], 0);
        assert!(unpack_color(&source, &PixelTransfer::default(), BaseFormat::Rgb).unwrap().is_empty());
    }
}
