//! The entry points. `table` declares all that do something; what they do is in the other modules, each a thin form of
//! what the modules beside this one do.

mod configs;
mod contexts;
mod drawables;
mod fonts;
mod server;
mod stubs;
mod swap;
mod table;

pub use stubs::*;
pub use table::*;

use std::ffi::{c_int, c_void};

/// Writes a result, if the program wants it.
///
/// # Safety
/// `to` is null or can be written.
unsafe fn put<T>(to: *mut T, value: T) {
    if !to.is_null() {
        // SAFETY: the caller vouches for it.
        unsafe { to.write_unaligned(value) };
    }
}

unsafe extern "C" {
    fn malloc(bytes: usize) -> *mut c_void;
}

/// An array that the program frees with XFree; null if it would be empty. Its length goes to `count`.
///
/// # Safety
/// `count` is null or can be written.
unsafe fn array<T: Copy>(elements: &[T], count: *mut c_int) -> *mut T {
    // SAFETY: the caller vouches for it.
    unsafe { put(count, elements.len() as c_int) };
    if elements.is_empty() {
        return std::ptr::null_mut();
    }
    // SAFETY: any size is allowed.
    let memory = unsafe { malloc(size_of_val(elements)) }.cast::<T>();
    if !memory.is_null() {
        // SAFETY: the memory is as large as the elements, and aligned for everything.
        unsafe { memory.copy_from_nonoverlapping(elements.as_ptr(), elements.len()) };
    }
    memory
}
