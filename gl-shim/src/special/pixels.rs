//! Images that are no textures, and maps of pixels.

use std::ffi::c_void;

use afterglow_api::constants::*;
use afterglow_gl::{Context, Extent};

use crate::{memory, number};

/// The memory of an image that is read; none for a null pointer, and nothing where format, type or size are errors,
/// of which the context then tells.
pub unsafe fn image<'a>(
    gl: &Context,
    extent: Option<Extent>,
    (format, kind): (u32, u32),
    pixels: *const c_void,
) -> Option<&'a [u8]> {
    let size = extent.and_then(|extent| gl.pixel_image_size(extent, format, kind, false));
    // SAFETY: the program has an image of that extent there.
    (!pixels.is_null()).then(|| unsafe { memory::bytes(pixels, size.unwrap_or(0)) })
}

fn plane(width: i32, height: i32) -> Option<Extent> {
    Some(Extent::plane(usize::try_from(width).ok()?, usize::try_from(height).ok()?))
}

pub unsafe fn draw_pixels(
    gl: &mut Context,
    width: i32,
    height: i32,
    format: u32,
    kind: u32,
    pixels: *const c_void,
) {
    // SAFETY: the contract is the same.
    let data = unsafe { image(gl, plane(width, height), (format, kind), pixels) };
    gl.draw_pixels(width, height, format, kind, data.unwrap_or_default());
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn bitmap(
    gl: &mut Context,
    width: i32,
    height: i32,
    x_origin: f32,
    y_origin: f32,
    x_step: f32,
    y_step: f32,
    bits: *const u8,
) {
    // SAFETY: the contract is the same.
    let data = unsafe { image(gl, plane(width, height), (GL_COLOR_INDEX, GL_BITMAP), bits.cast()) };
    gl.bitmap((width, height), (x_origin, y_origin), (x_step, y_step), data);
}

pub unsafe fn polygon_stipple(gl: &mut Context, mask: *const u8) {
    // SAFETY: the contract is the same.
    if let Some(data) = unsafe { image(gl, plane(32, 32), (GL_COLOR_INDEX, GL_BITMAP), mask.cast()) } {
        gl.polygon_stipple_image(data);
    }
}

pub unsafe fn get_polygon_stipple(gl: &mut Context, mask: *mut u8) {
    let size = gl.pixel_image_size(Extent::plane(32, 32), GL_COLOR_INDEX, GL_BITMAP, true);
    // SAFETY: the program has room for such an image there.
    gl.get_polygon_stipple_image(unsafe { memory::bytes_mut(mask.cast(), size.unwrap_or(0)) });
}

#[expect(clippy::too_many_arguments, reason = "the command has them")]
pub unsafe fn read_pixels(
    gl: &mut Context,
    x: i32,
    y: i32,
    width: i32,
    height: i32,
    format: u32,
    kind: u32,
    pixels: *mut c_void,
) {
    let size = plane(width, height).and_then(|extent| gl.pixel_image_size(extent, format, kind, true));
    // SAFETY: the program has room for such an image there.
    let data = unsafe { memory::bytes_mut(pixels, size.unwrap_or(0)) };
    gl.read_pixels(x, y, width, height, format, kind, data);
}

pub unsafe fn pixel_mapfv(gl: &mut Context, map: u32, size: i32, values: *const f32) {
    if size < 1 {
        return gl.record_error(GL_INVALID_VALUE);
    }
    // SAFETY: there are `size` values.
    gl.pixel_map(map, &unsafe { memory::list(values, size, number::float) });
}

pub unsafe fn pixel_mapuiv(gl: &mut Context, map: u32, size: i32, values: *const u32) {
    // SAFETY: the contract is the same.
    unsafe { pixel_map_integers(gl, map, size, values, u32::MAX) };
}

pub unsafe fn pixel_mapusv(gl: &mut Context, map: u32, size: i32, values: *const u16) {
    // SAFETY: the contract is the same.
    unsafe { pixel_map_integers(gl, map, size, values, u16::MAX.into()) };
}

unsafe fn pixel_map_integers<T: Copy + Into<u32>>(
    gl: &mut Context,
    map: u32,
    size: i32,
    values: *const T,
    greatest: u32,
) {
    if size < 1 {
        return gl.record_error(GL_INVALID_VALUE);
    }
    // SAFETY: there are `size` values.
    gl.pixel_map_integers(map, &unsafe { memory::list(values, size, T::into) }, greatest);
}

pub unsafe fn get_pixel_mapuiv(gl: &mut Context, map: u32, values: *mut u32) {
    // SAFETY: there is room for all values of the map.
    unsafe { memory::store(gl.get_pixel_map_integers(map, u32::MAX), values) };
}

pub unsafe fn get_pixel_mapusv(gl: &mut Context, map: u32, values: *mut u16) {
    let integers = gl.get_pixel_map_integers(map, u16::MAX.into());
    let shorts: Vec<u16> = integers.into_iter().map(|value| value as u16).collect();
    // SAFETY: there is room for all values of the map.
    unsafe { memory::store(shorts, values) };
}
