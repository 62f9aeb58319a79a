//! Copies from the frame buffer to texture images.

use afterglow_gl::Context;

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub fn copy_tex_image_1d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: u32,
    x: i32,
    y: i32,
    width: i32,
    border: i32,
) {
    gl.copy_tex_image(target, level, internal_format, x, y, width, None, border);
}

pub fn copy_tex_sub_image_1d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    x: i32,
    y: i32,
    width: i32,
) {
    gl.copy_tex_sub_image(target, level, [x_offset, 0, 0], x, y, width, 1);
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub fn copy_tex_image_2d(
    gl: &mut Context,
    target: u32,
    level: i32,
    internal_format: u32,
    x: i32,
    y: i32,
    width: i32,
    height: i32,
    border: i32,
) {
    gl.copy_tex_image(target, level, internal_format, x, y, width, Some(height), border);
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub fn copy_tex_sub_image_2d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    y_offset: i32,
    x: i32,
    y: i32,
    width: i32,
    height: i32,
) {
    gl.copy_tex_sub_image(target, level, [x_offset, y_offset, 0], x, y, width, height);
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub fn copy_tex_sub_image_3d(
    gl: &mut Context,
    target: u32,
    level: i32,
    x_offset: i32,
    y_offset: i32,
    z_offset: i32,
    x: i32,
    y: i32,
    width: i32,
    height: i32,
) {
    gl.copy_tex_sub_image(target, level, [x_offset, y_offset, z_offset], x, y, width, height);
}
