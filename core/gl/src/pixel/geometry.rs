//! Where the rows of an image are in memory (specification, 3.6.4 "Unpacking").

use super::layout::{PixelLayout, PixelType};
use super::store::Packing;

/// Size of an image in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Extent {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Images.
    pub depth: usize,
    /// Three-dimensional: GL_UNPACK_SKIP_IMAGES and GL_UNPACK_IMAGE_HEIGHT count.
    pub volume: bool,
}

impl Extent {
    /// A plane, or a line if `height` is 1.
    pub const fn plane(width: usize, height: usize) -> Extent {
        Extent { width, height, depth: 1, volume: false }
    }

    /// A three-dimensional image.
    pub const fn volume(width: usize, height: usize, depth: usize) -> Extent {
        Extent { width, height, depth, volume: true }
    }

    /// Number of pixels, if it can be told.
    pub fn pixels(self) -> Option<usize> {
        self.width.checked_mul(self.height)?.checked_mul(self.depth)
    }

    /// There are no pixels.
    pub const fn is_empty(self) -> bool {
        self.width == 0 || self.height == 0 || self.depth == 0
    }
}

/// Bytes that an image takes in memory, from the pointer on to the last byte that is touched; `None` if
/// that is no number of bytes that memory could have.
pub fn image_size(packing: &Packing, extent: Extent, layout: PixelLayout) -> Option<usize> {
    Geometry::new(packing, extent, layout).map(|geometry| geometry.end)
}

/// Places of an image's rows, in bytes from the pointer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Geometry {
    /// First byte of the first row.
    pub start: usize,
    /// First bit within the first byte of each row (bitmaps).
    pub first_bit: usize,
    /// Bytes of a row that are touched.
    pub row_bytes: usize,
    /// From one row to the next.
    pub row_stride: usize,
    /// From one image to the next.
    pub image_stride: usize,
    /// One past the last byte that is touched; 0 for an empty image.
    pub end: usize,
}

impl Geometry {
    /// `None` if a place exceeds the address space.
    pub fn new(packing: &Packing, extent: Extent, layout: PixelLayout) -> Option<Geometry> {
        let row_length = or(packing.row_length, extent.width);
        let (before, first_bit, row_bytes) = match layout.kind {
            PixelType::Bitmap => {
                let bit = packing.skip_pixels % 8;
                (packing.skip_pixels / 8, bit, extent.width.checked_add(bit)?.div_ceil(8))
            }
            _ => {
                let bytes = layout.pixel_bytes();
                (packing.skip_pixels.checked_mul(bytes)?, 0, extent.width.checked_mul(bytes)?)
            }
        };
        let row_stride = row_stride(row_length, packing.alignment, layout)?;
        let image_height = if extent.volume { packing.image_height } else { 0 };
        let image_stride = row_stride.checked_mul(or(image_height, extent.height))?;
        let skip_images = if extent.volume { packing.skip_images } else { 0 };
        let start = before
            .checked_add(packing.skip_rows.checked_mul(row_stride)?)?
            .checked_add(skip_images.checked_mul(image_stride)?)?;
        let end = if extent.is_empty() {
            0
        } else {
            start
                .checked_add((extent.height - 1).checked_mul(row_stride)?)?
                .checked_add((extent.depth - 1).checked_mul(image_stride)?)?
                .checked_add(row_bytes)?
        };
        Some(Geometry { start, first_bit, row_bytes, row_stride, image_stride, end })
    }

    /// First byte of each row, images one after another. Empty for an empty image.
    pub fn row_starts(self, extent: Extent) -> impl Iterator<Item = usize> {
        let images = if extent.is_empty() { 0 } else { extent.depth };
        (0..images).flat_map(move |image| {
            (0..extent.height).map(move |row| self.start + image * self.image_stride + row * self.row_stride)
        })
    }

    /// The rows follow each other without a gap.
    pub fn is_contiguous(self, extent: Extent) -> bool {
        self.first_bit == 0
            && (extent.height <= 1 || self.row_stride == self.row_bytes)
            && (extent.depth <= 1 || self.image_stride == self.row_bytes * extent.height)
    }
}

fn or(length: usize, otherwise: usize) -> usize {
    if length == 0 { otherwise } else { length }
}

/// Equation 3.13: rows of `n l` elements of `s` bytes, padded to the alignment where an element is smaller.
fn row_stride(row_length: usize, alignment: usize, layout: PixelLayout) -> Option<usize> {
    let bytes = match layout.kind {
        PixelType::Bitmap => row_length.div_ceil(8),
        _ => row_length.checked_mul(layout.pixel_bytes())?,
    };
    if layout.kind.element_bytes() >= alignment {
        return Some(bytes);
    }
    bytes.checked_next_multiple_of(alignment)
}

#[cfg(test)]
mod tests {
    use super::super::layout::PixelFormat;
    use super::*;

    const RGB8: PixelLayout = PixelLayout { format: PixelFormat::Rgb, kind: PixelType::U8 };
    const BITS: PixelLayout = PixelLayout { format: PixelFormat::ColorIndex, kind: PixelType::Bitmap };

    #[test]
    fn rows_are_aligned() {
        let packing = Packing::default();
        // Rows of 9 bytes begin 12 apart; the last has no padding.
        assert_eq!(image_size(&packing, Extent::plane(3, 2), RGB8), Some(21));
        assert_eq!(image_size(&Packing::tight(), Extent::plane(3, 2), RGB8), Some(18));
        // An element as large as the alignment is never padded.
        let float = PixelLayout { format: PixelFormat::Red, kind: PixelType::F32 };
        assert_eq!(image_size(&packing, Extent::plane(3, 2), float), Some(24));
        let eight = Packing { alignment: 8, ..packing };
        assert_eq!(image_size(&eight, Extent::plane(3, 2), float), Some(28));
    }

    #[test]
    fn skips_count() {
        let packing =
            Packing { row_length: 10, skip_rows: 2, skip_pixels: 1, skip_images: 5, ..Packing::tight() };
        let geometry = Geometry::new(&packing, Extent::plane(3, 2), RGB8).unwrap();
        assert_eq!((geometry.start, geometry.row_stride, geometry.end), (63, 30, 63 + 30 + 9));
        let starts: Vec<usize> = geometry.row_starts(Extent::plane(3, 2)).collect();
        assert_eq!(starts, [63, 93]);
        let packing = Packing { image_height: 4, ..packing };
        let geometry = Geometry::new(&packing, Extent::volume(3, 2, 2), RGB8).unwrap();
        assert_eq!((geometry.start, geometry.image_stride), (63 + 5 * 120, 120));
    }

    #[test]
    fn bitmaps_count_bits() {
        let packing = Packing { skip_pixels: 11, ..Packing::default() };
        let geometry = Geometry::new(&packing, Extent::plane(6, 2), BITS).unwrap();
        assert_eq!((geometry.start, geometry.first_bit, geometry.row_bytes), (1, 3, 2));
        assert_eq!((geometry.row_stride, geometry.end), (4, 7));
    }

    #[test]
    fn empty_and_absurd() {
        assert_eq!(image_size(&Packing::default(), Extent::plane(0, 7), RGB8), Some(0));
        assert_eq!(image_size(&Packing::default(), Extent::volume(usize::MAX / 2, 2, 2), RGB8), None);
        let far = Packing { skip_rows: usize::MAX / 3, ..Packing::default() };
        assert_eq!(image_size(&far, Extent::plane(4, 1), RGB8), None);
    }
}
