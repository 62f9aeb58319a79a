//! glXUseXFont.

use std::ffi::c_int;

use afterglow_api::constants::*;
use afterglow_gl::Context;

use crate::boundary::guarded;
use crate::glx::binding::{self, Binding};
use crate::glx::glyphs::{Font, Glyph};
use crate::glx::xlib::{self, Display, Xid};

/// Characters that a font has at most.
const MOST_CHARACTERS: c_int = 1 << 16;
/// How glBitmap has to read a glyph's rows.
const UNPACKING: [(u32, i32); 6] = [
    (GL_UNPACK_SWAP_BYTES, 0),
    (GL_UNPACK_LSB_FIRST, 0),
    (GL_UNPACK_ROW_LENGTH, 0),
    (GL_UNPACK_SKIP_ROWS, 0),
    (GL_UNPACK_SKIP_PIXELS, 0),
    (GL_UNPACK_ALIGNMENT, 1),
];

/// glXUseXFont: a display list with one glBitmap for each character.
pub unsafe fn use_x_font(font: Xid, first: c_int, count: c_int, list: c_int) {
    let make = |binding: &Binding, gl: &mut Context| {
        let display: *mut Display = std::ptr::with_exposed_provenance_mut(binding.display);
        let Some(xlib) = xlib::get().filter(|_| !display.is_null()) else { return };
        // SAFETY: the program keeps the display of what is current open.
        let font = unsafe {
            let root = (xlib.root_window)(display, binding.context.config.screen);
            Font::open(xlib, display, font, root)
        };
        if let Some(font) = font {
            lists(gl, &font, first, count.clamp(0, MOST_CHARACTERS), list);
        }
    };
    guarded(|| binding::with_gl(make));
}

fn lists(gl: &mut Context, font: &Font<'_>, first: c_int, count: c_int, list: c_int) {
    // Neither between Begin and End nor while a list is compiled.
    if gl.get_integer(GL_LIST_INDEX) != [0] {
        return;
    }
    let former = UNPACKING.map(|(pname, _)| gl.get_integer(pname).first().copied().unwrap_or(0));
    for (pname, value) in UNPACKING {
        gl.pixel_store(pname, value as f32);
    }
    for i in 0..count {
        let Glyph { size, origin, step, rows } = font.glyph(first.wrapping_add(i) as u32);
        gl.new_list(list.wrapping_add(i) as u32, GL_COMPILE);
        match rows {
            Some(rows) => gl.bitmap(size, origin, step, Some(&rows)),
            None => gl.bitmap((0, 0), (0.0, 0.0), step, None),
        }
        gl.end_list();
    }
    for ((pname, _), value) in UNPACKING.into_iter().zip(former) {
        gl.pixel_store(pname, value as f32);
    }
}
