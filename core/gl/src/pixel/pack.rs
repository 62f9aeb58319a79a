//! To the program's memory: colours, depths and stencil values (specification, 4.3.2).

use afterglow_api::constants::GL_INVALID_OPERATION;

use super::GlResult;
use super::bytes::{ByteFormat, byte_format, from_rgba};
use super::geometry::{Extent, Geometry};
use super::layout::{PixelFormat, PixelLayout};
use super::rows::{Color, RowWriter};
use super::store::Packing;
use super::transfer::PixelTransfer;

/// What luminance is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Luminance {
    /// Red + green + blue, as glReadPixels has it.
    Sum,
    /// Red, as glGetTexImage has it.
    Red,
}

/// Memory that an image is written to; it is known to be long enough. Bytes between rows are kept.
#[derive(Debug)]
pub struct PixelTarget<'a> {
    data: &'a mut [u8],
    layout: PixelLayout,
    packing: Packing,
    extent: Extent,
    geometry: Geometry,
}

impl<'a> PixelTarget<'a> {
    /// An image of that extent, to begin at `data`.
    ///
    /// # Errors
    /// GL_INVALID_OPERATION if the memory is too short for it.
    pub fn new(
        data: &'a mut [u8],
        layout: PixelLayout,
        packing: &Packing,
        extent: Extent,
    ) -> GlResult<PixelTarget<'a>> {
        let geometry = Geometry::new(packing, extent, layout)
            .filter(|geometry| geometry.end <= data.len())
            .ok_or(GL_INVALID_OPERATION)?;
        Ok(PixelTarget { data, layout, packing: *packing, extent, geometry })
    }

    /// Calls `write` with the pixels of each row and the row's memory.
    fn rows<T>(self, pixels: &[T], per_pixel: usize, mut write: impl FnMut(&[T], &mut [u8])) {
        let rows = pixels.chunks_exact((per_pixel * self.extent.width).max(1));
        for (start, row) in self.geometry.row_starts(self.extent).zip(rows) {
            write(row, &mut self.data[start..start + self.geometry.row_bytes]);
        }
    }

    fn writer(&self) -> RowWriter {
        RowWriter::new(self.layout, &self.packing, self.geometry.first_bit)
    }
}

/// Writes RGBA bytes, rows tightly one after another. Where the pixels end early the memory is kept.
///
/// # Errors
/// GL_INVALID_OPERATION if the target's format is none of colours.
pub fn pack_color(
    rgba: &[u8],
    transfer: Option<&PixelTransfer>,
    luminance: Luminance,
    target: PixelTarget,
) -> GlResult<()> {
    let format = target.layout.format;
    if !format.is_color() || format.is_index() {
        return Err(GL_INVALID_OPERATION);
    }
    let transfer = transfer.filter(|transfer| !transfer.modes.keeps_colors());
    let is_luminance = matches!(format, PixelFormat::Luminance | PixelFormat::LuminanceAlpha);
    let sum = luminance == Luminance::Sum && is_luminance;
    match byte_format(target.layout, target.packing.swap_bytes) {
        Some(format) if transfer.is_none() && !sum => pack_bytes(rgba, format, target),
        _ => pack_numbers(rgba, transfer, sum, target),
    }
    Ok(())
}

fn pack_bytes(rgba: &[u8], format: ByteFormat, target: PixelTarget) {
    target.rows(rgba, 4, |pixels, row| from_rgba(format, pixels, row));
}

fn pack_numbers(rgba: &[u8], transfer: Option<&PixelTransfer>, sum: bool, target: PixelTarget) {
    let writer = target.writer();
    let (mut colors, mut numbers) = (Vec::<Color>::new(), Vec::new());
    target.rows(rgba, 4, |pixels, row| {
        colors.clear();
        colors.extend(pixels.as_chunks::<4>().0.iter().map(|pixel| {
            let color = pixel.map(|byte| f32::from(byte) / 255.0);
            let color = transfer.map_or(color, |transfer| transfer.color(color));
            let red = if sum { color[0] + color[1] + color[2] } else { color[0] };
            [red, color[1], color[2], color[3]].map(|component| component.clamp(0.0, 1.0))
        }));
        writer.colors(&colors, &mut numbers, row);
    });
}

/// Writes depths between 0 and 1, rows tightly one after another.
///
/// # Errors
/// GL_INVALID_OPERATION if the target's format is none of depths.
pub fn pack_depth(depths: &[f32], transfer: &PixelTransfer, target: PixelTarget) -> GlResult<()> {
    if target.layout.format != PixelFormat::Depth {
        return Err(GL_INVALID_OPERATION);
    }
    let writer = target.writer();
    let mut numbers = Vec::new();
    target.rows(depths, 1, |depths, row| {
        numbers.clear();
        numbers.extend(depths.iter().map(|depth| transfer.depth(*depth)));
        writer.components(&numbers, row);
    });
    Ok(())
}

/// Writes stencil values, rows tightly one after another.
///
/// # Errors
/// GL_INVALID_OPERATION if the target's format is none of stencil values.
pub fn pack_stencil(values: &[u8], transfer: &PixelTransfer, target: PixelTarget) -> GlResult<()> {
    if target.layout.format != PixelFormat::StencilIndex {
        return Err(GL_INVALID_OPERATION);
    }
    let writer = target.writer();
    let mut indices = Vec::new();
    target.rows(values, 1, |values, row| {
        indices.clear();
        indices.extend(values.iter().map(|value| transfer.stencil((*value).into())));
        writer.indices(&indices, row);
    });
    Ok(())
}

#[cfg(test)]
mod tests {
    use afterglow_api::constants::*;
    use proptest::prelude::*;

    use super::super::source::PixelSource;
    use super::super::unpack::unpack_color;
    use super::*;
    use crate::frame::BaseFormat;

    fn target<'a>(data: &'a mut [u8], format: u32, kind: u32, width: usize) -> PixelTarget<'a> {
        let layout = PixelLayout::from_gl(format, kind).unwrap();
        PixelTarget::new(data, layout, &Packing::tight(), Extent::plane(width, 1)).unwrap()
    }

    #[test]
    fn luminance_of_reading_is_a_sum() {
        let mut out = [0; 2];
        let rgba = [10, 20, 30, 40, 200, 100, 50, 0];
        let luminance = target(&mut out, GL_LUMINANCE, GL_UNSIGNED_BYTE, 2);
        pack_color(&rgba, None, Luminance::Sum, luminance).unwrap();
        assert_eq!(out, [60, 255]);
        let luminance = target(&mut out, GL_LUMINANCE, GL_UNSIGNED_BYTE, 2);
        pack_color(&rgba, None, Luminance::Red, luminance).unwrap();
        assert_eq!(out, [10, 200]);
    }

    #[test]
    fn other_types() {
        let mut out = [0; 4];
        let rgba = [255, 0, 128, 255];
        pack_color(&rgba, None, Luminance::Sum, target(&mut out, GL_RED, GL_FLOAT, 1)).unwrap();
        assert_eq!(f32::from_ne_bytes(out), 1.0);
        let packed = target(&mut out[..2], GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, 1);
        pack_color(&rgba, None, Luminance::Sum, packed).unwrap();
        assert_eq!(u16::from_ne_bytes([out[0], out[1]]), 0xf08f);
        let index = target(&mut out, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, 1);
        assert_eq!(pack_color(&rgba, None, Luminance::Sum, index), Err(GL_INVALID_OPERATION));
    }

    #[test]
    fn depth_and_stencil() {
        let mut out = [0; 8];
        let transfer = PixelTransfer::default();
        pack_depth(&[0.5, 1.0], &transfer, target(&mut out, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 2)).unwrap();
        let words: Vec<u32> = super::super::element::elements(&out).collect();
        assert_eq!(words, [0x8000_0000, 0xffff_ffff]);
        let stencil = target(&mut out[..1], GL_STENCIL_INDEX, GL_BITMAP, 3);
        pack_stencil(&[1, 2, 3], &transfer, stencil).unwrap();
        assert_eq!(out[0] & 0xe0, 0b1010_0000);
    }

    #[test]
    fn padding_is_kept() {
        let layout = PixelLayout::from_gl(GL_RGB, GL_UNSIGNED_BYTE).unwrap();
        let mut out = [9; 8];
        let extent = Extent::plane(1, 2);
        assert!(PixelTarget::new(&mut out[..6], layout, &Packing::default(), extent).is_err());
        let target = PixelTarget::new(&mut out, layout, &Packing::default(), extent).unwrap();
        pack_color(&[1, 2, 3, 4, 5, 6, 7, 8], None, Luminance::Sum, target).unwrap();
        assert_eq!(out, [1, 2, 3, 9, 5, 6, 7, 9]);
    }

    const BYTE_LAYOUTS: [(u32, u32); 14] = [
        (GL_RGBA, GL_UNSIGNED_BYTE),
        (GL_BGRA, GL_UNSIGNED_BYTE),
        (GL_RGB, GL_UNSIGNED_BYTE),
        (GL_BGR, GL_UNSIGNED_BYTE),
        (GL_RED, GL_UNSIGNED_BYTE),
        (GL_GREEN, GL_UNSIGNED_BYTE),
        (GL_BLUE, GL_UNSIGNED_BYTE),
        (GL_ALPHA, GL_UNSIGNED_BYTE),
        (GL_LUMINANCE, GL_UNSIGNED_BYTE),
        (GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE),
        (GL_RGBA, GL_UNSIGNED_INT_8_8_8_8),
        (GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV),
        (GL_BGRA, GL_UNSIGNED_SHORT_4_4_4_4),
        (GL_RGB, GL_UNSIGNED_BYTE_2_3_3_REV),
    ];

    prop_compose! {
        fn packing()(
            swap_bytes: bool,
            alignment in prop::sample::select(vec![1usize, 2, 4, 8]),
            row_length in prop::sample::select(vec![0usize, 9, 20]),
            (skip_rows, skip_pixels, skip_images) in (0usize..3, 0usize..3, 0usize..2),
            image_height in prop::sample::select(vec![0usize, 3, 5]),
        ) -> Packing {
            let lsb_first = false;
            Packing {
                swap_bytes, lsb_first, row_length, image_height, skip_rows, skip_pixels, skip_images, alignment,
            }
        }
    }

    proptest! {
        #[test]
        fn what_is_read_can_be_written_back(
            layout in prop::sample::select(&BYTE_LAYOUTS[..]),
            read in packing(),
            written in packing(),
            (width, height, depth) in (0usize..9, 0usize..4, 0usize..3),
            seed: u8,
            slow: bool,
        ) {
            let layout = PixelLayout::from_gl(layout.0, layout.1).unwrap();
            let extent = Extent::volume(width, height, depth);
            let length = |packing| super::super::image_size(packing, extent, layout).unwrap();
            let data: Vec<u8> = (0..length(&read)).map(|i| (i as u8).wrapping_mul(37) ^ seed).collect();
            let source = PixelSource::new(&data, layout, &read, extent).unwrap();
            let mut transfer = PixelTransfer::default();
            if slow {
                // Changes nothing that is a byte, but takes the way of numbers.
                transfer.modes.bias[0] = 1e-6;
            }
            let rgba = unpack_color(&source, &transfer, BaseFormat::Rgba).unwrap();
            let mut out = vec![0; length(&written)];
            let target = PixelTarget::new(&mut out, layout, &written, extent).unwrap();
            pack_color(&rgba, Some(&transfer), Luminance::Red, target).unwrap();
            let again = PixelSource::new(&out, layout, &written, extent).unwrap();
            let bytes = |source: &PixelSource, swap: bool| {
                let mut bytes: Vec<u8> = source.rows().flatten().copied().collect();
                if swap {
                    bytes.chunks_exact_mut(layout.kind.element_bytes()).for_each(<[u8]>::reverse);
                }
                bytes
            };
            prop_assert_eq!(bytes(&source, read.swap_bytes), bytes(&again, written.swap_bytes));
        }
    }
}
