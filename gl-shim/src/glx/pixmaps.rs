//! What was drawn to a pixmap, put into the pixmap of X: programs copy it from there.

use std::ffi::{c_int, c_uint};

use super::xlib::{self, Display, Geometry, Xid};

/// ZPixmap: whole pixels.
const Z_PIXMAP: c_int = 2;
/// Bits that rows are padded to.
const PAD: c_int = 32;

/// Replaces what is in a pixmap of 24 or 32 bits; others stay as they are. `rgba` has its rows from the lowest upward.
///
/// # Safety
/// `display` is open.
pub unsafe fn put(display: *mut Display, pixmap: Xid, (width, height): (u32, u32), rgba: &[u8]) {
    let Some(xlib) = xlib::get() else { return };
    // SAFETY: the caller vouches for the display.
    let geometry = unsafe { xlib.geometry(display, pixmap) };
    let Some(Geometry { depth: depth @ (24 | 32), .. }) = geometry else { return };
    let mut pixels = packed(width as usize, rgba);
    if pixels.len() != width as usize * height as usize {
        return;
    }
    let (columns, rows) = (width as c_uint, height as c_uint);
    // SAFETY: the image has as many pixels as it says, and is freed before they are; XSync waits for its answer.
    unsafe {
        let data = pixels.as_mut_ptr().cast();
        let none = std::ptr::null_mut();
        let image = (xlib.create_image)(
            display,
            none,
            depth,
            Z_PIXMAP,
            0,
            data,
            columns,
            rows,
            PAD,
            (width * 4) as c_int,
        );
        if image.is_null() {
            return;
        }
        let gc = (xlib.create_gc)(display, pixmap, 0, std::ptr::null_mut());
        xlib.forgiving(display, || {
            (xlib.put_image)(display, pixmap, gc, image, 0, 0, 0, 0, columns, rows);
            (xlib.sync)(display, 0)
        });
        (xlib.free_gc)(display, gc);
        // Not XDestroyImage: it would free the pixels as well.
        (xlib.free)(image);
    }
}

/// Pixels as visuals of 8 bits a component have them, rows from the highest downward.
fn packed(width: usize, rgba: &[u8]) -> Vec<u32> {
    let rows = rgba.chunks_exact((4 * width).max(1)).rev();
    let pixels = rows.flat_map(|row| row.as_chunks::<4>().0);
    pixels.map(|&[red, green, blue, alpha]| u32::from_be_bytes([alpha, red, green, blue])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_turned_over() {
        let rgba = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16];
        assert_eq!(packed(2, &rgba), [0x0c09_0a0b, 0x100d_0e0f, 0x0401_0203, 0x0805_0607]);
        assert_eq!(packed(0, &rgba), [0u32; 0]);
    }
}
