//! Packed pixels of at most 16 bits as RGBA bytes, by a table for each component.

use super::element::{Element, elements, unorm8};
use super::layout::{PackedType, PixelFormat, PixelLayout, PixelType};

/// Greatest number of bits of a component.
const BITS: usize = 6;

/// What each value of each component adds to a pixel.
#[derive(Debug)]
pub struct PackedTable {
    kind: PackedType,
    shifts: [u32; 4],
    bytes: [[u32; 1 << BITS]; 4],
    /// Added to all pixels: alpha, if the pixels have none.
    constant: u32,
}

impl PackedTable {
    /// The table of a layout, if it is one of packed pixels of that size.
    pub fn new(layout: PixelLayout) -> Option<PackedTable> {
        let PixelType::Packed(kind) = layout.kind else { return None };
        if kind.bytes > 2 {
            return None;
        }
        let places = if layout.format == PixelFormat::Bgra { [16, 8, 0, 24] } else { [0, 8, 16, 24] };
        let fields = kind.fields();
        let bytes = std::array::from_fn(|i| {
            let (_, max) = fields[i];
            let byte = |value: u32| unorm8(value as f32 / max.max(1) as f32);
            std::array::from_fn(|value| u32::from(byte((value as u32).min(max))) << places[i])
        });
        let constant = if kind.components() == 3 { 0xff00_0000 } else { 0 };
        Some(PackedTable { kind, shifts: fields.map(|(shift, _)| shift), bytes, constant })
    }

    /// Writes a row, whose elements are in the machine's byte order, as RGBA.
    pub fn convert(&self, row: &[u8], out: &mut [u8]) {
        match self.kind.bytes {
            1 => self.convert_elements::<u8>(row, out),
            _ => self.convert_elements::<u16>(row, out),
        }
    }

    fn convert_elements<T: Element + Into<u32>>(&self, row: &[u8], out: &mut [u8]) {
        let masks = self.kind.bits.map(|bits| (1usize << bits) - 1);
        for (out, word) in out.as_chunks_mut().0.iter_mut().zip(elements::<T>(row)) {
            let word: u32 = word.into();
            let component =
                |i: usize| self.bytes[i][(word >> self.shifts[i]) as usize & masks[i] & ((1 << BITS) - 1)];
            let pixel = component(0) | component(1) | component(2) | component(3) | self.constant;
            *out = pixel.to_le_bytes();
        }
    }
}

#[cfg(test)]
mod tests {
    use afterglow_api::constants::*;

    use super::super::rows::RowReader;
    use super::super::store::Packing;
    use super::*;

    #[test]
    fn as_by_numbers() {
        let row: Vec<u8> = (0..=u16::MAX).flat_map(u16::to_ne_bytes).collect();
        for (format, kind) in [
            (GL_RGB, GL_UNSIGNED_BYTE_3_3_2),
            (GL_RGB, GL_UNSIGNED_BYTE_2_3_3_REV),
            (GL_RGB, GL_UNSIGNED_SHORT_5_6_5),
            (GL_RGB, GL_UNSIGNED_SHORT_5_6_5_REV),
            (GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4),
            (GL_BGRA, GL_UNSIGNED_SHORT_4_4_4_4_REV),
            (GL_RGBA, GL_UNSIGNED_SHORT_5_5_5_1),
            (GL_BGRA, GL_UNSIGNED_SHORT_1_5_5_5_REV),
        ] {
            let layout = PixelLayout::from_gl(format, kind).unwrap();
            let mut colors = Vec::new();
            RowReader::new(layout, &Packing::default(), 0).colors(&row, &mut Vec::new(), &mut colors);
            let expected: Vec<u8> = colors.iter().flat_map(|color| color.map(unorm8)).collect();
            let mut out = vec![0; expected.len()];
            PackedTable::new(layout).unwrap().convert(&row, &mut out);
            assert_eq!(out, expected, "{format:#x} {kind:#x}");
        }
        let large = PixelLayout::from_gl(GL_RGBA, GL_UNSIGNED_INT_10_10_10_2).unwrap();
        assert!(PackedTable::new(large).is_none());
    }
}
