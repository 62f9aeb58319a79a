//! Texture images. Functions of one, two and three dimensions share those that take sizes as arrays.

use std::ffi::c_void;

use afterglow_gl::texture::{ImageDefinition, MAX_3D_SIZE, MAX_SIZE, SubImage};
use afterglow_gl::{Context, Extent};

use super::image;
use crate::memory;

/// The extent of a texture image in memory; none if a texture cannot be so large, and is in error.
fn extent(dimensions: usize, size: [i32; 3]) -> Option<Extent> {
    let most = if dimensions == 3 { MAX_3D_SIZE } else { MAX_SIZE };
    // A border adds two.
    if size.iter().any(|side| !(0..=most as i32 + 2).contains(side)) {
        return None;
    }
    let [width, height, depth] = size.map(|side| side as usize);
    Some(if dimensions == 3 { Extent::volume(width, height, depth) } else { Extent::plane(width, height) })
}

unsafe fn tex_image(
    gl: &mut Context,
    target: (u32, usize),
    definition: ImageDefinition,
    pixels: (u32, u32),
    data: *const c_void,
) {
    // SAFETY: the contract is the same.
    let data = unsafe { image(gl, extent(target.1, definition.size), pixels, data) };
    gl.tex_image(target, definition, pixels, data);
}

unsafe fn tex_sub_image(
    gl: &mut Context,
    target: (u32, usize),
    part: SubImage,
    pixels: (u32, u32),
    data: *const c_void,
) {
    // SAFETY: the contract is the same.
    let data = unsafe { image(gl, extent(target.1, part.size), pixels, data) };
    gl.tex_sub_image(target, part, pixels, data.unwrap_or_default());
}

pub unsafe fn get_tex_image(
    gl: &mut Context,
    target: u32,
    level: i32,
    format: u32,
    kind: u32,
    texels: *mut c_void,
) {
    let size = gl.tex_image_bytes(target, level, format, kind).unwrap_or(0);
    // SAFETY: the program has room for such an image there.
    gl.get_tex_image(target, level, format, kind, unsafe { memory::bytes_mut(texels, size) });
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn tex_image_1d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: i32,
    width: i32,
    border: i32,
    format: u32,
    kind: u32,
    pixels: *const c_void,
) {
    let definition =
        ImageDefinition { level, internal_format: internal_format as u32, size: [width, 1, 1], border };
    // SAFETY: the contract is the same.
    unsafe { tex_image(gl, (target, 1), definition, (format, kind), pixels) };
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn tex_sub_image_1d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    width: i32,
    format: u32,
    kind: u32,
    pixels: *const c_void,
) {
    let part = SubImage { level, offset: [x_offset, 0, 0], size: [width, 1, 1] };
    // SAFETY: the contract is the same.
    unsafe { tex_sub_image(gl, (target, 1), part, (format, kind), pixels) };
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn tex_image_2d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: i32,
    width: i32,
    height: i32,
    border: i32,
    format: u32,
    kind: u32,
    pixels: *const c_void,
) {
    let definition =
        ImageDefinition { level, internal_format: internal_format as u32, size: [width, height, 1], border };
    // SAFETY: the contract is the same.
    unsafe { tex_image(gl, (target, 2), definition, (format, kind), pixels) };
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn tex_sub_image_2d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    y_offset: i32,
    width: i32,
    height: i32,
    format: u32,
    kind: u32,
    pixels: *const c_void,
) {
    let part = SubImage { level, offset: [x_offset, y_offset, 0], size: [width, height, 1] };
    // SAFETY: the contract is the same.
    unsafe { tex_sub_image(gl, (target, 2), part, (format, kind), pixels) };
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn tex_image_3d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: i32,
    width: i32,
    height: i32,
    depth: i32,
    border: i32,
    format: u32,
    kind: u32,
    pixels: *const c_void,
) {
    let definition = ImageDefinition {
        level,
        internal_format: internal_format as u32,
        size: [width, height, depth],
        border,
    };
    // SAFETY: the contract is the same.
    unsafe { tex_image(gl, (target, 3), definition, (format, kind), pixels) };
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn tex_sub_image_3d(
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
    kind: u32,
    pixels: *const c_void,
) {
    let part = SubImage { level, offset: [x_offset, y_offset, z_offset], size: [width, height, depth] };
    // SAFETY: the contract is the same.
    unsafe { tex_sub_image(gl, (target, 3), part, (format, kind), pixels) };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_texture_is_larger_than_the_greatest() {
        let (flat, deep) = (MAX_SIZE as i32 + 2, MAX_3D_SIZE as i32 + 2);
        assert!(extent(2, [flat, flat, 1]).is_some() && extent(2, [flat + 1, 1, 1]).is_none());
        assert!(extent(3, [deep; 3]).is_some() && extent(3, [1, deep + 1, 1]).is_none());
        assert!(extent(1, [-1, 1, 1]).is_none());
    }
}
