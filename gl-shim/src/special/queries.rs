//! Answers that are no numbers in the program's memory.

use std::ffi::CString;

use afterglow_api::constants::*;
use afterglow_gl::Context;
use parking_lot::Mutex;

use crate::memory;

/// Answers of glGetString. The program keeps their addresses as long as it likes.
static STRINGS: Mutex<Vec<CString>> = Mutex::new(Vec::new());

/// The address of a string, 0 after an error.
pub fn get_string(gl: &mut Context, name: u32) -> usize {
    gl.get_string(name).map_or(0, kept)
}

/// The address of a copy that is never freed; there is one for each text.
fn kept(text: &str) -> usize {
    let mut strings = STRINGS.lock();
    if let Some(known) = strings.iter().find(|known| known.as_bytes() == text.as_bytes()) {
        return known.as_ptr() as usize;
    }
    let string = CString::new(text).unwrap_or_default();
    let address = string.as_ptr() as usize;
    strings.push(string);
    address
}

/// Whether all are resident. Only if they are not are they told one by one, and they always are.
pub unsafe fn are_textures_resident(gl: &mut Context, n: i32, textures: *const u32, _: *mut u8) -> bool {
    if n < 0 {
        gl.record_error(GL_INVALID_VALUE);
        return false;
    }
    // SAFETY: there are `n` names.
    gl.are_textures_resident(&unsafe { memory::list(textures, n, crate::number::uint) }).0
}
