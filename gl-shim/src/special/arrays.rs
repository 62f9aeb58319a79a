//! Arrays whose elements another argument describes: lists' names, buffers' bytes.

use std::ffi::c_void;

use afterglow_api::constants::*;
use afterglow_gl::{Context, list_offset_bytes, list_offsets};

use crate::memory;

pub unsafe fn call_lists(gl: &mut Context, n: i32, kind: u32, lists: *const c_void) {
    let Ok(count) = usize::try_from(n) else { return gl.record_error(GL_INVALID_VALUE) };
    let Some(size) = list_offset_bytes(kind) else { return gl.record_error(GL_INVALID_ENUM) };
    // SAFETY: there are `n` offsets.
    let bytes = unsafe { memory::bytes(lists, count.saturating_mul(size)) };
    if let Some(offsets) = list_offsets(kind, bytes, count) {
        gl.call_lists(&offsets);
    }
}

pub unsafe fn buffer_data(gl: &mut Context, target: u32, size: isize, data: *const c_void, usage: u32) {
    // SAFETY: there are `size` bytes, unless there is no data.
    let bytes = usize::try_from(size).map(|count| unsafe { memory::bytes(data, count) });
    gl.buffer_data(target, size, bytes.ok().filter(|_| !data.is_null()), usage);
}

pub unsafe fn buffer_sub_data(
    gl: &mut Context,
    target: u32,
    offset: isize,
    size: isize,
    data: *const c_void,
) {
    let Ok(count) = usize::try_from(size) else { return gl.record_error(GL_INVALID_VALUE) };
    if data.is_null() {
        // Nothing is written, but the range has to be one: it is looked at as a query does.
        gl.get_buffer_sub_data(target, offset, size);
        return;
    }
    // SAFETY: there are `size` bytes.
    gl.buffer_sub_data(target, offset, unsafe { memory::bytes(data, count) });
}

/// The address of the mapped bytes, 0 if there are none.
pub fn map_buffer(gl: &mut Context, target: u32, access: u32) -> usize {
    if !gl.map_buffer(target, access) {
        return 0;
    }
    gl.get_buffer_pointer(target, GL_BUFFER_MAP_POINTER).unwrap_or(0)
}

pub unsafe fn get_buffer_pointerv(gl: &mut Context, target: u32, pname: u32, params: *mut *mut c_void) {
    // SAFETY: there is room for one pointer.
    unsafe { memory::store(gl.get_buffer_pointer(target, pname), params) };
}
