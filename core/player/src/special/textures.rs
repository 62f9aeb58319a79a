//! Texture images. One function serves a command's forms of one, two and three dimensions, `D`.

use afterglow_gl::Context;
use afterglow_gl::texture::{ImageDefinition, SubImage};

use crate::args::*;

/// Most bytes that an image that is read back may have.
const LARGEST_READ: usize = 1 << 28;

/// glTexImage.
pub fn tex_image<const D: usize>(gl: &mut Context, a: Args) -> Option<()> {
    let pixels = (a.get(4 + D, uint)?, a.get(5 + D, uint)?);
    gl.tex_image((a.get(0, uint)?, D), definition::<D>(a)?, pixels, a.memory(6 + D)?);
    Some(())
}

/// glTexSubImage.
pub fn tex_sub_image<const D: usize>(gl: &mut Context, a: Args) -> Option<()> {
    let pixels = (a.get(2 + 2 * D, uint)?, a.get(3 + 2 * D, uint)?);
    gl.tex_sub_image((a.get(0, uint)?, D), part::<D>(a)?, pixels, a.bytes(4 + 2 * D)?);
    Some(())
}

/// glCompressedTexImage.
pub fn compressed_tex_image<const D: usize>(gl: &mut Context, a: Args) -> Option<()> {
    let data = counted_bytes(a, 4 + D)?;
    gl.compressed_tex_image((a.get(0, uint)?, D), definition::<D>(a)?, data);
    Some(())
}

/// glCompressedTexSubImage.
pub fn compressed_tex_sub_image<const D: usize>(gl: &mut Context, a: Args) -> Option<()> {
    let (format, data) = (a.get(2 + 2 * D, uint)?, counted_bytes(a, 3 + 2 * D)?);
    gl.compressed_tex_sub_image((a.get(0, uint)?, D), part::<D>(a)?, format, data);
    Some(())
}

/// glCopyTexImage.
pub fn copy_tex_image<const D: usize>(gl: &mut Context, a: Args) -> Option<()> {
    let (target, level, internal_format) = (a.get(0, uint)?, a.get(1, int)?, a.get(2, uint)?);
    let [x, y, width] = numbers(a, 3)?;
    let height = if D > 1 { Some(a.get(6, int)?) } else { None };
    gl.copy_tex_image(target, level, internal_format, x, y, width, height, a.get(5 + D, int)?);
    Some(())
}

/// glCopyTexSubImage.
pub fn copy_tex_sub_image<const D: usize>(gl: &mut Context, a: Args) -> Option<()> {
    let mut offset = [0; 3];
    offset[..D].copy_from_slice(&numbers::<D>(a, 2)?);
    let [x, y, width] = numbers(a, 2 + D)?;
    let height = if D > 1 { a.get(5 + D, int)? } else { 1 };
    gl.copy_tex_sub_image(a.get(0, uint)?, a.get(1, int)?, offset, x, y, width, height);
    Some(())
}

/// glGetTexImage: what is read is dropped.
pub fn get_tex_image(gl: &mut Context, a: Args) -> Option<()> {
    let (target, level) = (a.get(0, uint)?, a.get(1, int)?);
    let (format, kind) = (a.get(2, uint)?, a.get(3, uint)?);
    let bytes = gl.tex_image_bytes(target, level, format, kind).unwrap_or(0);
    let mut texels = vec![0; Some(bytes).filter(|&bytes| bytes <= LARGEST_READ)?];
    gl.get_tex_image(target, level, format, kind, &mut texels);
    Some(())
}

/// Level, internal format, size and border, after the target.
fn definition<const D: usize>(a: Args) -> Option<ImageDefinition> {
    let mut size = [1; 3];
    size[..D].copy_from_slice(&numbers::<D>(a, 3)?);
    let (level, internal_format) = (a.get(1, int)?, a.get(2, uint)?);
    Some(ImageDefinition { level, internal_format, size, border: a.get(3 + D, int)? })
}

/// Level, offset and size, after the target.
fn part<const D: usize>(a: Args) -> Option<SubImage> {
    let (mut offset, mut size) = ([0; 3], [1; 3]);
    offset[..D].copy_from_slice(&numbers::<D>(a, 2)?);
    size[..D].copy_from_slice(&numbers::<D>(a, 2 + D)?);
    Some(SubImage { level: a.get(1, int)?, offset, size })
}

fn numbers<const N: usize>(a: Args, first: usize) -> Option<[i32; N]> {
    let mut numbers = [0; N];
    for (i, number) in numbers.iter_mut().enumerate() {
        *number = a.get(first + i, int)?;
    }
    Some(numbers)
}

/// A number of bytes, and then the memory that has so many.
fn counted_bytes(a: Args<'_>, index: usize) -> Option<&[u8]> {
    a.bytes(index + 1)?.get(..usize::try_from(a.get(index, int)?).ok()?)
}
