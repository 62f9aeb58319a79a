//! Pixel-store state: how rows and images lie in the program's memory (specification, 3.6.1 and 4.3.2).

use afterglow_api::constants::*;

use super::GlResult;

/// One direction of glPixelStore. Lengths count pixels, rows and images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Packing {
    /// The bytes of each element are in the other order.
    pub swap_bytes: bool,
    /// Bits of bitmaps count from the least significant.
    pub lsb_first: bool,
    /// Pixels from one row to the next; 0 for the image's width.
    pub row_length: usize,
    /// Rows from one image to the next; 0 for the image's height.
    pub image_height: usize,
    /// Rows before the first.
    pub skip_rows: usize,
    /// Pixels before the first of each row.
    pub skip_pixels: usize,
    /// Images before the first (three-dimensional images only).
    pub skip_images: usize,
    /// Rows begin at multiples of so many bytes: 1, 2, 4 or 8.
    pub alignment: usize,
}

impl Default for Packing {
    fn default() -> Self {
        Packing {
            swap_bytes: false,
            lsb_first: false,
            row_length: 0,
            image_height: 0,
            skip_rows: 0,
            skip_pixels: 0,
            skip_images: 0,
            alignment: 4,
        }
    }
}

impl Packing {
    /// Rows follow each other without a gap.
    pub fn tight() -> Packing {
        Packing { alignment: 1, ..Packing::default() }
    }

    fn set(&mut self, field: Field, value: f32) -> GlResult<()> {
        let length = match field {
            Field::SwapBytes | Field::LsbFirst => 0,
            _ => length(value)?,
        };
        match field {
            Field::SwapBytes => self.swap_bytes = value != 0.0,
            Field::LsbFirst => self.lsb_first = value != 0.0,
            Field::RowLength => self.row_length = length,
            Field::ImageHeight => self.image_height = length,
            Field::SkipRows => self.skip_rows = length,
            Field::SkipPixels => self.skip_pixels = length,
            Field::SkipImages => self.skip_images = length,
            Field::Alignment if matches!(length, 1 | 2 | 4 | 8) => self.alignment = length,
            Field::Alignment => return Err(GL_INVALID_VALUE),
        }
        Ok(())
    }

    fn get(&self, field: Field) -> i32 {
        let length = match field {
            Field::SwapBytes => self.swap_bytes.into(),
            Field::LsbFirst => self.lsb_first.into(),
            Field::RowLength => self.row_length,
            Field::ImageHeight => self.image_height,
            Field::SkipRows => self.skip_rows,
            Field::SkipPixels => self.skip_pixels,
            Field::SkipImages => self.skip_images,
            Field::Alignment => self.alignment,
        };
        length.try_into().unwrap_or(i32::MAX)
    }
}

/// Rounds to the nearest integer (specification, 2.8 of conversions); negative is an error.
fn length(value: f32) -> GlResult<usize> {
    let rounded = value.round();
    if rounded.is_nan() || rounded < 0.0 {
        return Err(GL_INVALID_VALUE);
    }
    Ok((rounded as i32) as usize)
}

#[derive(Debug, Clone, Copy)]
enum Field {
    SwapBytes,
    LsbFirst,
    RowLength,
    ImageHeight,
    SkipRows,
    SkipPixels,
    SkipImages,
    Alignment,
}

/// All of glPixelStore's state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PixelStore {
    /// Memory that is read.
    pub unpack: Packing,
    /// Memory that is written.
    pub pack: Packing,
}

impl PixelStore {
    /// glPixelStore.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for an unknown name; GL_INVALID_VALUE for a negative length or an alignment
    /// other than 1, 2, 4, 8.
    pub fn set(&mut self, pname: u32, value: f32) -> GlResult<()> {
        let (pack, field) = parameter(pname).ok_or(GL_INVALID_ENUM)?;
        if pack { self.pack.set(field, value) } else { self.unpack.set(field, value) }
    }

    /// The parameter as glGet tells it, if it is one of glPixelStore's.
    pub fn get(&self, pname: u32) -> Option<i32> {
        let (pack, field) = parameter(pname)?;
        Some(if pack { self.pack.get(field) } else { self.unpack.get(field) })
    }
}

/// Whether a parameter belongs to packing, and which it is.
fn parameter(pname: u32) -> Option<(bool, Field)> {
    Some(match pname {
        GL_UNPACK_SWAP_BYTES => (false, Field::SwapBytes),
        GL_UNPACK_LSB_FIRST => (false, Field::LsbFirst),
        GL_UNPACK_ROW_LENGTH => (false, Field::RowLength),
        GL_UNPACK_IMAGE_HEIGHT => (false, Field::ImageHeight),
        GL_UNPACK_SKIP_ROWS => (false, Field::SkipRows),
        GL_UNPACK_SKIP_PIXELS => (false, Field::SkipPixels),
        GL_UNPACK_SKIP_IMAGES => (false, Field::SkipImages),
        GL_UNPACK_ALIGNMENT => (false, Field::Alignment),
        GL_PACK_SWAP_BYTES => (true, Field::SwapBytes),
        GL_PACK_LSB_FIRST => (true, Field::LsbFirst),
        GL_PACK_ROW_LENGTH => (true, Field::RowLength),
        GL_PACK_IMAGE_HEIGHT => (true, Field::ImageHeight),
        GL_PACK_SKIP_ROWS => (true, Field::SkipRows),
        GL_PACK_SKIP_PIXELS => (true, Field::SkipPixels),
        GL_PACK_SKIP_IMAGES => (true, Field::SkipImages),
        GL_PACK_ALIGNMENT => (true, Field::Alignment),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_what_it_names() {
        let mut store = PixelStore::default();
        assert_eq!(store.set(GL_UNPACK_ROW_LENGTH, 7.4), Ok(()));
        assert_eq!(store.set(GL_PACK_ALIGNMENT, 1.0), Ok(()));
        assert_eq!(store.set(GL_PACK_SWAP_BYTES, 2.0), Ok(()));
        assert_eq!((store.unpack.row_length, store.unpack.alignment), (7, 4));
        assert_eq!(store.get(GL_PACK_SWAP_BYTES), Some(1));
        assert_eq!(store.get(GL_PACK_ALIGNMENT), Some(1));
        assert_eq!(store.get(GL_RGBA), None);
    }

    #[test]
    fn refuses_what_the_specification_refuses() {
        let mut store = PixelStore::default();
        assert_eq!(store.set(GL_RGBA, 1.0), Err(GL_INVALID_ENUM));
        for (pname, value) in
            [(GL_PACK_ALIGNMENT, 3.0), (GL_UNPACK_SKIP_ROWS, -1.0), (GL_UNPACK_SKIP_ROWS, f32::NAN)]
        {
            assert_eq!(store.set(pname, value), Err(GL_INVALID_VALUE));
        }
        assert_eq!(store, PixelStore::default());
    }
}
