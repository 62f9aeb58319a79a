//! What there is: versions, extensions, addresses.

use std::ffi::{CStr, c_char, c_int, c_void};
use std::ptr::null;

use afterglow_api::constants::glx::*;

use super::put;
use crate::boundary::guarded;
use crate::glx::displays::{self, Codes};
use crate::glx::proc_address;
use crate::glx::xlib::Display;

const EXTENSIONS: &CStr = c"GLX_ARB_create_context GLX_ARB_create_context_profile GLX_ARB_get_proc_address \
GLX_EXT_swap_control GLX_EXT_visual_info GLX_EXT_visual_rating GLX_MESA_swap_control GLX_SGI_make_current_read GLX_SGI_swap_control \
GLX_SGIX_fbconfig GLX_SGIX_pbuffer ";

/// glXQueryExtension. Error and event codes are those of the server's own GLX, if it has it.
pub unsafe fn query_extension(
    display: *mut Display,
    error_base: *mut c_int,
    event_base: *mut c_int,
) -> c_int {
    // SAFETY: the program vouches for the display.
    let known = guarded(|| unsafe { displays::get(display) }).flatten();
    let Codes { first_error, first_event, .. } = known.map_or_else(Codes::default, |known| known.codes);
    // SAFETY: the program vouches for its pointers.
    unsafe { put(error_base, first_error) };
    // SAFETY: as above.
    unsafe { put(event_base, first_event) };
    1
}

/// glXQueryVersion.
pub unsafe fn query_version(major: *mut c_int, minor: *mut c_int) -> c_int {
    // SAFETY: the program vouches for its pointers.
    unsafe { put(major, 1) };
    // SAFETY: as above.
    unsafe { put(minor, 4) };
    1
}

/// glXQueryExtensionsString.
pub fn query_extensions_string() -> *const c_char {
    EXTENSIONS.as_ptr()
}

/// glXGetClientString and glXQueryServerString: nothing of the server is used.
pub fn query_string(name: c_int) -> *const c_char {
    match name as u32 {
        GLX_VENDOR => c"Afterglow".as_ptr(),
        GLX_VERSION => c"1.4".as_ptr(),
        GLX_EXTENSIONS => EXTENSIONS.as_ptr(),
        _ => null(),
    }
}

/// glXGetProcAddress.
pub unsafe fn get_proc_address(name: *const u8) -> *const c_void {
    if name.is_null() {
        return null();
    }
    // SAFETY: the program vouches for a string that ends.
    let name = unsafe { CStr::from_ptr(name.cast()) };
    guarded(|| proc_address::find(name)).flatten().unwrap_or(null())
}
