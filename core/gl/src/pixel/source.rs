//! An image in the program's memory, to be read.

use afterglow_api::constants::GL_INVALID_OPERATION;

use super::GlResult;
use super::geometry::{Extent, Geometry};
use super::layout::PixelLayout;
use super::store::Packing;

/// Memory with an image in it; it is known to be long enough.
#[derive(Debug, Clone, Copy)]
pub struct PixelSource<'a> {
    data: &'a [u8],
    layout: PixelLayout,
    packing: Packing,
    extent: Extent,
    geometry: Geometry,
}

impl<'a> PixelSource<'a> {
    /// The image of that extent which begins at `data`.
    ///
    /// # Errors
    /// GL_INVALID_OPERATION if the memory is too short for it.
    pub fn new(
        data: &'a [u8],
        layout: PixelLayout,
        packing: &Packing,
        extent: Extent,
    ) -> GlResult<PixelSource<'a>> {
        Geometry::new(packing, extent, layout)
            .filter(|geometry| geometry.end <= data.len())
            .map(|geometry| PixelSource { data, layout, packing: *packing, extent, geometry })
            .ok_or(GL_INVALID_OPERATION)
    }

    /// The part of the image that begins at pixel `first` (x, y, z) and has the extent `extent`.
    ///
    /// # Errors
    /// GL_INVALID_OPERATION if that is no part of the image.
    pub fn crop(&self, first: [usize; 3], extent: Extent) -> GlResult<PixelSource<'a>> {
        let inside = |first: usize, length: usize, whole: usize| {
            first.checked_add(length).is_some_and(|end| end <= whole)
        };
        if !inside(first[0], extent.width, self.extent.width)
            || !inside(first[1], extent.height, self.extent.height)
            || !inside(first[2], extent.depth, self.extent.depth)
        {
            return Err(GL_INVALID_OPERATION);
        }
        let old = &self.packing;
        let or = |length, otherwise| if length == 0 { otherwise } else { length };
        let packing = Packing {
            row_length: or(old.row_length, self.extent.width),
            image_height: or(old.image_height, self.extent.height),
            skip_pixels: old.skip_pixels + first[0],
            skip_rows: old.skip_rows + first[1],
            skip_images: old.skip_images + first[2],
            ..*old
        };
        PixelSource::new(self.data, self.layout, &packing, extent)
    }

    /// Format and type.
    pub fn layout(&self) -> PixelLayout {
        self.layout
    }

    /// Size in pixels.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    pub(super) fn packing(&self) -> &Packing {
        &self.packing
    }

    pub(super) fn first_bit(&self) -> usize {
        self.geometry.first_bit
    }

    /// The bytes of each row, lowest row of the first image first.
    pub(super) fn rows(&self) -> impl Iterator<Item = &'a [u8]> {
        let (data, bytes) = (self.data, self.geometry.row_bytes);
        self.geometry.row_starts(self.extent).map(move |start| &data[start..start + bytes])
    }

    /// All bytes, if the rows follow each other without a gap.
    pub(super) fn contiguous(&self) -> Option<&'a [u8]> {
        let geometry = self.geometry;
        if self.extent.is_empty() {
            return Some(&[]);
        }
        geometry.is_contiguous(self.extent).then(|| &self.data[geometry.start..geometry.end])
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{PixelFormat, PixelType};
    use super::*;

    const BYTE: PixelLayout = PixelLayout { format: PixelFormat::Red, kind: PixelType::U8 };

    #[test]
    fn rows_and_crops() {
        let data: Vec<u8> = (0..24).collect();
        let source = PixelSource::new(&data, BYTE, &Packing::tight(), Extent::volume(4, 3, 2)).unwrap();
        assert_eq!(source.contiguous(), Some(&data[..]));
        let part = source.crop([1, 1, 0], Extent::volume(2, 2, 2)).unwrap();
        let rows: Vec<&[u8]> = part.rows().collect();
        assert_eq!(rows, [[5, 6], [9, 10], [17, 18], [21, 22]]);
        assert_eq!(part.contiguous(), None);
        assert!(source.crop([1, 0, 0], Extent::volume(4, 1, 1)).is_err());
    }

    #[test]
    fn too_short() {
        let extent = Extent::plane(3, 2);
        assert!(PixelSource::new(&[0; 7], BYTE, &Packing::default(), extent).is_ok());
        let short = PixelSource::new(&[0; 6], BYTE, &Packing::default(), extent);
        assert_eq!(short.err(), Some(GL_INVALID_OPERATION));
    }

    #[test]
    fn empty() {
        let source = PixelSource::new(&[], BYTE, &Packing::tight(), Extent::volume(0, 0, 1 << 30)).unwrap();
        assert_eq!(source.rows().count(), 0);
        assert_eq!(source.contiguous(), Some(&[][..]));
    }
}
