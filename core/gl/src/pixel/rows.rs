//! Rows of pixels of any layout, as numbers: the general way, a row at a time.

use super::element::{Element, elements, write_elements};
use super::layout::{PackedType, PixelFormat, PixelLayout, PixelType};
use super::store::Packing;

/// Colour of a pixel: red, green, blue, alpha.
pub type Color = [f32; 4];

/// Turns rows into numbers; holds the memory that this takes.
#[derive(Debug)]
pub struct RowReader {
    layout: PixelLayout,
    swap_bytes: bool,
    lsb_first: bool,
    first_bit: usize,
    swapped: Vec<u8>,
}

impl RowReader {
    /// For rows that lie as `packing` says; bitmaps begin at bit `first_bit` of a row.
    pub fn new(layout: PixelLayout, packing: &Packing, first_bit: usize) -> RowReader {
        let (swap_bytes, lsb_first) = (packing.swap_bytes, packing.lsb_first);
        RowReader { layout, swap_bytes, lsb_first, first_bit, swapped: Vec::new() }
    }

    /// Appends the components of each pixel in memory's order, normalised.
    pub fn components(&mut self, row: &[u8], out: &mut Vec<f32>) {
        let kind = self.layout.kind;
        let row = self.native(row);
        match kind {
            PixelType::U8 => normalized::<u8>(row, out),
            PixelType::I8 => normalized::<i8>(row, out),
            PixelType::U16 => normalized::<u16>(row, out),
            PixelType::I16 => normalized::<i16>(row, out),
            PixelType::U32 => normalized::<u32>(row, out),
            PixelType::I32 => normalized::<i32>(row, out),
            PixelType::F32 => normalized::<f32>(row, out),
            PixelType::Packed(packed) => unpacked(packed, row, out),
            PixelType::Bitmap => {}
        }
    }

    /// Appends the colour of each pixel; components that the format lacks are 0, alpha is 1.
    pub fn colors(&mut self, row: &[u8], scratch: &mut Vec<f32>, out: &mut Vec<Color>) {
        scratch.clear();
        self.components(row, scratch);
        let format = self.layout.format;
        out.extend(scratch.chunks_exact(format.components()).map(|pixel| arrange(format, pixel)));
    }

    /// Appends the index of each pixel, at most `width` of them.
    pub fn indices(&mut self, row: &[u8], width: usize, out: &mut Vec<i64>) {
        if self.layout.kind == PixelType::Bitmap {
            let bits = (self.first_bit..self.first_bit + width).map(|i| bit(row, i, self.lsb_first));
            out.extend(bits.map(i64::from));
            return;
        }
        let kind = self.layout.kind;
        let row = self.native(row);
        match kind {
            PixelType::U8 => indices::<u8>(row, out),
            PixelType::I8 => indices::<i8>(row, out),
            PixelType::U16 => indices::<u16>(row, out),
            PixelType::I16 => indices::<i16>(row, out),
            PixelType::U32 => indices::<u32>(row, out),
            PixelType::I32 => indices::<i32>(row, out),
            PixelType::F32 => indices::<f32>(row, out),
            PixelType::Bitmap | PixelType::Packed(_) => {}
        }
    }

    /// The row in the machine's byte order.
    fn native<'a>(&'a mut self, row: &'a [u8]) -> &'a [u8] {
        if !self.swap_bytes || self.layout.kind.element_bytes() == 1 {
            return row;
        }
        self.swapped.clear();
        self.swapped.extend_from_slice(row);
        swap_elements(&mut self.swapped, self.layout.kind.element_bytes());
        &self.swapped
    }
}

/// Turns numbers into rows: the inverse of [`RowReader`]. Bitmaps keep the bits beside the row.
#[derive(Debug, Clone, Copy)]
pub struct RowWriter {
    layout: PixelLayout,
    swap_bytes: bool,
    lsb_first: bool,
    first_bit: usize,
}

impl RowWriter {
    /// For rows that shall lie as `packing` says.
    pub fn new(layout: PixelLayout, packing: &Packing, first_bit: usize) -> RowWriter {
        let (swap_bytes, lsb_first) = (packing.swap_bytes, packing.lsb_first);
        RowWriter { layout, swap_bytes, lsb_first, first_bit }
    }

    /// Writes normalised components in memory's order.
    pub fn components(self, values: &[f32], row: &mut [u8]) {
        match self.layout.kind {
            PixelType::U8 => denormalized::<u8>(values, row),
            PixelType::I8 => denormalized::<i8>(values, row),
            PixelType::U16 => denormalized::<u16>(values, row),
            PixelType::I16 => denormalized::<i16>(values, row),
            PixelType::U32 => denormalized::<u32>(values, row),
            PixelType::I32 => denormalized::<i32>(values, row),
            PixelType::F32 => denormalized::<f32>(values, row),
            PixelType::Packed(packed) => pack(packed, values, row),
            PixelType::Bitmap => {}
        }
        self.native(row);
    }

    /// Writes colours; luminance is red.
    pub fn colors(self, colors: &[Color], scratch: &mut Vec<f32>, row: &mut [u8]) {
        scratch.clear();
        for color in colors {
            pick(self.layout.format, *color, scratch);
        }
        self.components(scratch, row);
    }

    /// Writes indices.
    pub fn indices(self, values: &[i64], row: &mut [u8]) {
        match self.layout.kind {
            PixelType::Bitmap => {
                for (i, value) in values.iter().enumerate() {
                    set_bit(row, self.first_bit + i, self.lsb_first, value & 1 == 1);
                }
                return;
            }
            PixelType::U8 => from_indices::<u8>(values, row),
            PixelType::I8 => from_indices::<i8>(values, row),
            PixelType::U16 => from_indices::<u16>(values, row),
            PixelType::I16 => from_indices::<i16>(values, row),
            PixelType::U32 => from_indices::<u32>(values, row),
            PixelType::I32 => from_indices::<i32>(values, row),
            PixelType::F32 => from_indices::<f32>(values, row),
            PixelType::Packed(_) => {}
        }
        self.native(row);
    }

    fn native(self, row: &mut [u8]) {
        if self.swap_bytes {
            swap_elements(row, self.layout.kind.element_bytes());
        }
    }
}

fn normalized<T: Element>(row: &[u8], out: &mut Vec<f32>) {
    out.extend(elements::<T>(row).map(T::normalized));
}

fn indices<T: Element>(row: &[u8], out: &mut Vec<i64>) {
    out.extend(elements::<T>(row).map(T::index));
}

fn denormalized<T: Element>(values: &[f32], row: &mut [u8]) {
    write_elements(values.iter().map(|value| T::from_normalized(*value)), row);
}

fn from_indices<T: Element>(values: &[i64], row: &mut [u8]) {
    write_elements(values.iter().map(|value| T::from_index(*value)), row);
}

fn unpacked(packed: PackedType, row: &[u8], out: &mut Vec<f32>) {
    let fields = &packed.fields()[..packed.components()];
    let split =
        |word: u32| fields.iter().map(move |(shift, max)| ((word >> shift) & max) as f32 / *max as f32);
    match packed.bytes {
        1 => out.extend(row.iter().flat_map(|byte| split(u32::from(*byte)))),
        2 => out.extend(elements::<u16>(row).flat_map(|word| split(u32::from(word)))),
        _ => out.extend(elements::<u32>(row).flat_map(split)),
    }
}

fn pack(packed: PackedType, values: &[f32], row: &mut [u8]) {
    let fields = &packed.fields()[..packed.components()];
    let words = values.chunks_exact(fields.len()).map(|pixel| {
        let field = |(value, (shift, max)): (&f32, &(u32, u32))| {
            ((value * *max as f32).round_ties_even() as u32).min(*max) << shift
        };
        pixel.iter().zip(fields).map(field).fold(0, |word, field| word | field)
    });
    match packed.bytes {
        1 => write_elements(words.map(|word| word as u8), row),
        2 => write_elements(words.map(|word| word as u16), row),
        _ => write_elements(words, row),
    }
}

/// Components in memory's order as a colour (specification, 3.6.4 "Conversion to RGB" and "Final
/// Expansion to RGBA").
fn arrange(format: PixelFormat, p: &[f32]) -> Color {
    match format {
        PixelFormat::Rgba => [p[0], p[1], p[2], p[3]],
        PixelFormat::Bgra => [p[2], p[1], p[0], p[3]],
        PixelFormat::Rgb => [p[0], p[1], p[2], 1.0],
        PixelFormat::Bgr => [p[2], p[1], p[0], 1.0],
        PixelFormat::Red => [p[0], 0.0, 0.0, 1.0],
        PixelFormat::Green => [0.0, p[0], 0.0, 1.0],
        PixelFormat::Blue => [0.0, 0.0, p[0], 1.0],
        PixelFormat::Alpha => [0.0, 0.0, 0.0, p[0]],
        PixelFormat::Luminance => [p[0], p[0], p[0], 1.0],
        PixelFormat::LuminanceAlpha => [p[0], p[0], p[0], p[1]],
        PixelFormat::ColorIndex | PixelFormat::StencilIndex | PixelFormat::Depth => [0.0; 4],
    }
}

/// Appends the components that the format has, in memory's order.
fn pick(format: PixelFormat, [r, g, b, a]: Color, out: &mut Vec<f32>) {
    match format {
        PixelFormat::Rgba => out.extend([r, g, b, a]),
        PixelFormat::Bgra => out.extend([b, g, r, a]),
        PixelFormat::Rgb => out.extend([r, g, b]),
        PixelFormat::Bgr => out.extend([b, g, r]),
        PixelFormat::Red | PixelFormat::Luminance => out.push(r),
        PixelFormat::Green => out.push(g),
        PixelFormat::Blue => out.push(b),
        PixelFormat::Alpha => out.push(a),
        PixelFormat::LuminanceAlpha => out.extend([r, a]),
        PixelFormat::ColorIndex | PixelFormat::StencilIndex | PixelFormat::Depth => {}
    }
}

fn swap_elements(row: &mut [u8], bytes: usize) {
    for element in row.chunks_exact_mut(bytes) {
        element.reverse();
    }
}

/// Byte of a bit, and its mask within the byte.
fn place(i: usize, lsb_first: bool) -> (usize, u8) {
    (i / 8, if lsb_first { 1 << (i % 8) } else { 0x80 >> (i % 8) })
}

/// Bit `i` of a row of a bitmap.
pub fn bit(row: &[u8], i: usize, lsb_first: bool) -> bool {
    let (byte, mask) = place(i, lsb_first);
    row[byte] & mask != 0
}

fn set_bit(row: &mut [u8], i: usize, lsb_first: bool, value: bool) {
    let (byte, mask) = place(i, lsb_first);
    row[byte] = if value { row[byte] | mask } else { row[byte] & !mask };
}

#[cfg(test)]
mod tests {
    use afterglow_api::constants::*;

    use super::*;

    fn reader(format: u32, kind: u32, packing: &Packing) -> RowReader {
        RowReader::new(PixelLayout::from_gl(format, kind).unwrap(), packing, 0)
    }

    fn colors(format: u32, kind: u32, row: &[u8]) -> Vec<Color> {
        let mut out = Vec::new();
        reader(format, kind, &Packing::default()).colors(row, &mut Vec::new(), &mut out);
        out
    }

    #[test]
    fn packed_pixels() {
        let word = 0b1000_0000_0011_1111_u16.to_ne_bytes();
        let [r, g, b, a] = colors(GL_RGB, GL_UNSIGNED_SHORT_5_6_5, &word)[0];
        assert_eq!([r, g, b, a], [16.0 / 31.0, 1.0 / 63.0, 1.0, 1.0]);
        let word = 0xc000_0bff_u32.to_ne_bytes();
        // From the least significant bit: 0x3ff, 2, 0, 3.
        assert_eq!(colors(GL_BGRA, GL_UNSIGNED_INT_2_10_10_10_REV, &word), [[0.0, 2.0 / 1023.0, 1.0, 1.0]]);
        assert_eq!(colors(GL_RGB, GL_UNSIGNED_BYTE_3_3_2, &[0xe1]), [[1.0, 0.0, 1.0 / 3.0, 1.0]]);
    }

    #[test]
    fn formats_expand() {
        assert_eq!(colors(GL_GREEN, GL_UNSIGNED_BYTE, &[255]), [[0.0, 1.0, 0.0, 1.0]]);
        assert_eq!(colors(GL_ALPHA, GL_UNSIGNED_BYTE, &[255]), [[0.0, 0.0, 0.0, 1.0]]);
        assert_eq!(colors(GL_LUMINANCE_ALPHA, GL_BYTE, &[127, 0x80]), [[1.0, 1.0, 1.0, -1.0]]);
    }

    #[test]
    fn swapped_and_back() {
        let packing = Packing { swap_bytes: true, ..Packing::default() };
        let row = [0x12, 0x34, 0xff, 0x00];
        let mut values = Vec::new();
        reader(GL_RED, GL_UNSIGNED_SHORT, &packing).components(&row, &mut values);
        let expected = [[0x34, 0x12], [0x00, 0xff]].map(|bytes| u16::from_ne_bytes(bytes).normalized());
        assert_eq!(values, expected);
        let mut back = [0; 4];
        let layout = PixelLayout::from_gl(GL_RED, GL_UNSIGNED_SHORT).unwrap();
        RowWriter::new(layout, &packing, 0).components(&values, &mut back);
        assert_eq!(back, row);
    }

    #[test]
    fn bits_in_both_orders() {
        let layout = PixelLayout::from_gl(GL_COLOR_INDEX, GL_BITMAP).unwrap();
        for (lsb_first, expected) in [(false, [1, 1, 0, 1]), (true, [1, 1, 0, 1])] {
            let packing = Packing { lsb_first, ..Packing::default() };
            let mut out = Vec::new();
            RowReader::new(layout, &packing, 6).indices(&[0b1100_0011, 0b0100_0010], 4, &mut out);
            assert_eq!(out, expected);
            let mut row = [0, 0xff];
            RowWriter::new(layout, &packing, 6).indices(&out, &mut row);
            let read: Vec<i64> = (6..10).map(|i| bit(&row, i, lsb_first).into()).collect();
            assert_eq!(read, out);
        }
    }
}
