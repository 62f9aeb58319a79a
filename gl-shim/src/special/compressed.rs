//! Compressed texture images.

use std::ffi::c_void;

use afterglow_gl::Context;
use afterglow_gl::texture::{ImageDefinition, SubImage};

use crate::memory;

/// So many bytes; a negative number is an error of which the context tells, as the image then has too few.
unsafe fn counted<'a>(data: *const c_void, count: i32) -> &'a [u8] {
    // SAFETY: the program has so many bytes there.
    unsafe { memory::bytes(data, usize::try_from(count).unwrap_or(0)) }
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn compressed_tex_image_1d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: u32,
    width: i32,
    border: i32,
    bytes: i32,
    data: *const c_void,
) {
    let definition = ImageDefinition { level, internal_format, size: [width, 1, 1], border };
    // SAFETY: the contract is the same.
    gl.compressed_tex_image((target, 1), definition, unsafe { counted(data, bytes) });
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn compressed_tex_sub_image_1d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    width: i32,
    format: u32,
    bytes: i32,
    data: *const c_void,
) {
    let part = SubImage { level, offset: [x_offset, 0, 0], size: [width, 1, 1] };
    // SAFETY: the contract is the same.
    gl.compressed_tex_sub_image((target, 1), part, format, unsafe { counted(data, bytes) });
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn compressed_tex_image_2d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: u32,
    width: i32,
    height: i32,
    border: i32,
    bytes: i32,
    data: *const c_void,
) {
    let definition = ImageDefinition { level, internal_format, size: [width, height, 1], border };
    // SAFETY: the contract is the same.
    gl.compressed_tex_image((target, 2), definition, unsafe { counted(data, bytes) });
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn compressed_tex_sub_image_2d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    y_offset: i32,
    width: i32,
    height: i32,
    format: u32,
    bytes: i32,
    data: *const c_void,
) {
    let part = SubImage { level, offset: [x_offset, y_offset, 0], size: [width, height, 1] };
    // SAFETY: the contract is the same.
    gl.compressed_tex_sub_image((target, 2), part, format, unsafe { counted(data, bytes) });
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn compressed_tex_image_3d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: u32,
    width: i32,
    height: i32,
    depth: i32,
    border: i32,
    bytes: i32,
    data: *const c_void,
) {
    let definition = ImageDefinition { level, internal_format, size: [width, height, depth], border };
    // SAFETY: the contract is the same.
    gl.compressed_tex_image((target, 3), definition, unsafe { counted(data, bytes) });
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn compressed_tex_sub_image_3d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    y_offset: i32,
    z_offset: i32,
    width: i32,
    height: i32,
    depth: i32,
    format: u32,
    bytes: i32,
    data: *const c_void,
) {
    let part = SubImage { level, offset: [x_offset, y_offset, z_offset], size: [width, height, depth] };
    // SAFETY: the contract is the same.
    gl.compressed_tex_sub_image((target, 3), part, format, unsafe { counted(data, bytes) });
}
