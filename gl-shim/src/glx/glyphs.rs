//! Pictures of a core X font's characters, for glXUseXFont.

use std::ffi::{c_int, c_uint};

use super::xlib::{Char2b, CharStruct, Display, FontStruct, Xid, Xlib};

/// Width and height that a character may have, pixels.
const MOST_EXTENT: i32 = 2048;
/// ZPixmap's twin for one plane: XYPixmap.
const XY_PIXMAP: c_int = 1;

/// A character as glBitmap wants it.
pub struct Glyph {
    /// Width and height, pixels.
    pub size: (i32, i32),
    /// Where the raster position is in it, from the lower left corner.
    pub origin: (f32, f32),
    /// How far the raster position moves.
    pub step: (f32, f32),
    /// Rows from the lowest upward, each of whole bytes, the leftmost pixel in the highest bit.
    pub rows: Option<Vec<u8>>,
}

/// A font of a display, with what is needed to draw it.
pub struct Font<'a> {
    xlib: &'a Xlib,
    display: *mut Display,
    info: *mut FontStruct,
    font: Xid,
    root: Xid,
}

impl<'a> Font<'a> {
    /// Nothing if there is no such font.
    ///
    /// # Safety
    /// `display` is open as long as the font is in use; `root` is a window of it.
    pub unsafe fn open(xlib: &'a Xlib, display: *mut Display, font: Xid, root: Xid) -> Option<Self> {
        // SAFETY: the caller vouches for the display; the query waits for its answer.
        let info = unsafe { xlib.forgiving(display, || (xlib.query_font)(display, font)) };
        (!info.is_null()).then_some(Self { xlib, display, info, font, root })
    }

    /// A character; an empty one if the font does not have it.
    pub fn glyph(&self, character: u32) -> Glyph {
        // SAFETY: Xlib's structure lives as long as `self`.
        let metrics = metrics(unsafe { &*self.info }, character);
        let empty = Glyph { size: (0, 0), origin: (0.0, 0.0), step: (0.0, 0.0), rows: None };
        let Some(metrics) = metrics else { return empty };
        let step = (f32::from(metrics.width), 0.0);
        let width = i32::from(metrics.rbearing) - i32::from(metrics.lbearing);
        let height = i32::from(metrics.ascent) + i32::from(metrics.descent);
        let is_drawn = |extent| (1..=MOST_EXTENT).contains(&extent);
        if !(is_drawn(width) && is_drawn(height)) {
            return Glyph { step, ..empty };
        }
        let start = (-i32::from(metrics.lbearing), i32::from(metrics.ascent));
        Glyph {
            size: (width, height),
            origin: (start.0 as f32, f32::from(metrics.descent)),
            step,
            rows: self.draw(character, (width, height), start),
        }
    }

    /// Draws a character in a pixmap of one plane and reads it back.
    fn draw(&self, character: u32, (width, height): (i32, i32), start: (i32, i32)) -> Option<Vec<u8>> {
        let Self { xlib, display, .. } = *self;
        let (columns, lines) = (width as c_uint, height as c_uint);
        let text = Char2b { byte1: (character >> 8) as u8, byte2: character as u8 };
        // SAFETY: the display is open (`open`); XGetImage waits for its answer.
        unsafe {
            let pixmap = (xlib.create_pixmap)(display, self.root, columns, lines, 1);
            let gc = (xlib.create_gc)(display, pixmap, 0, std::ptr::null_mut());
            let image = xlib.forgiving(display, || {
                (xlib.set_font)(display, gc, self.font);
                (xlib.set_foreground)(display, gc, 0);
                (xlib.fill_rectangle)(display, pixmap, gc, 0, 0, columns, lines);
                (xlib.set_foreground)(display, gc, 1);
                (xlib.draw_string16)(display, pixmap, gc, start.0, start.1, &text, 1);
                (xlib.get_image)(display, pixmap, 0, 0, columns, lines, 1, XY_PIXMAP)
            });
            (xlib.free_gc)(display, gc);
            (xlib.free_pixmap)(display, pixmap);
            if image.is_null() {
                return None;
            }
            let rows = packed((width, height), |x, y| (xlib.get_pixel)(image, x, y) != 0);
            (xlib.destroy_image)(image);
            Some(rows)
        }
    }
}

impl Drop for Font<'_> {
    fn drop(&mut self) {
        // SAFETY: the structure came from XQueryFont.
        unsafe { (self.xlib.free_font_info)(std::ptr::null_mut(), self.info, 1) };
    }
}

/// The measures of a character, if the font has it.
fn metrics(font: &FontStruct, character: u32) -> Option<CharStruct> {
    let (row, column) = (character >> 8, character & 0xff);
    // A font of one row counts its characters through.
    let (row, column) = if font.max_byte1 == 0 { (0, character) } else { (row, column) };
    let columns = font.min_char_or_byte2..=font.max_char_or_byte2;
    if !columns.contains(&column) || !(font.min_byte1..=font.max_byte1).contains(&row) {
        return None;
    }
    if font.per_char.is_null() {
        return Some(font.max_bounds);
    }
    let in_row = columns.end() - columns.start() + 1;
    let index = (row - font.min_byte1) * in_row + column - font.min_char_or_byte2;
    // SAFETY: the array has an element for each column of each row.
    Some(unsafe { *font.per_char.add(index as usize) })
}

/// Pixels as bits; `is_set` counts rows downward.
fn packed((width, height): (i32, i32), is_set: impl Fn(i32, i32) -> bool) -> Vec<u8> {
    let stride = width as usize / 8 + usize::from(width % 8 != 0);
    let mut rows = vec![0; stride * height as usize];
    for (y, row) in rows.chunks_exact_mut(stride).rev().enumerate() {
        for x in (0..width).filter(|x| is_set(*x, y as i32)) {
            row[x as usize / 8] |= 0x80 >> (x % 8);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_become_bits() {
        let rows = packed((9, 2), |x, y| (x, y) == (0, 0) || (x, y) == (8, 1));
        assert_eq!(rows, [0, 0x80, 0x80, 0]);
    }

    #[test]
    fn characters_that_a_font_lacks_have_no_measures() {
        let wide = CharStruct { width: 7, ..CharStruct::default() };
        let per_char = [CharStruct::default(), wide, CharStruct::default(), wide];
        let mut font = FontStruct {
            ext_data: std::ptr::null_mut(),
            fid: 0,
            direction: 0,
            min_char_or_byte2: 32,
            max_char_or_byte2: 33,
            min_byte1: 0,
            max_byte1: 0,
            all_chars_exist: 0,
            default_char: 0,
            n_properties: 0,
            properties: std::ptr::null_mut(),
            min_bounds: wide,
            max_bounds: wide,
            per_char: per_char.as_ptr(),
            ascent: 1,
            descent: 0,
        };
        let width = |font: &FontStruct, character| metrics(font, character).map(|metrics| metrics.width);
        assert_eq!([31, 32, 33, 34].map(|c| width(&font, c)), [None, Some(0), Some(7), None]);
        font.max_byte1 = 1;
        assert_eq!([33, 0x120, 0x121, 0x221].map(|c| width(&font, c)), [Some(7), Some(0), Some(7), None]);
        font.per_char = std::ptr::null();
        assert_eq!(width(&font, 32), Some(7));
    }
}
