//! Images that are no textures.

use afterglow_gl::{Context, Extent};

use crate::args::*;

/// Most bytes that a read-back may have.
const LARGEST_READ: usize = 1 << 28;

/// glBitmap.
pub fn bitmap(gl: &mut Context, a: Args) -> Option<()> {
    let size = (a.get(0, int)?, a.get(1, int)?);
    let origin = (a.get(2, float)?, a.get(3, float)?);
    let step = (a.get(4, float)?, a.get(5, float)?);
    gl.bitmap(size, origin, step, a.memory(6)?);
    Some(())
}

/// glPolygonStipple: bytes one by one, or as memory.
pub fn polygon_stipple(gl: &mut Context, a: Args) -> Option<()> {
    match a.vector::<u32, 128>(0, uint) {
        Some(bytes) => gl.polygon_stipple(&bytes.map(|byte| byte as u8)),
        None => gl.polygon_stipple(a.bytes(0)?),
    }
    Some(())
}

/// glReadPixels: what is read is dropped.
pub fn read_pixels(gl: &mut Context, a: Args) -> Option<()> {
    let [x, y, width, height] = [a.get(0, int)?, a.get(1, int)?, a.get(2, int)?, a.get(3, int)?];
    let (format, kind) = (a.get(4, uint)?, a.get(5, uint)?);
    let extent = Extent {
        width: usize::try_from(width).ok()?,
        height: usize::try_from(height).ok()?,
        depth: 1,
        volume: false,
    };
    let bytes = gl.pixel_image_size(extent, format, kind, true).unwrap_or(0);
    let mut pixels = vec![0; Some(bytes).filter(|&bytes| bytes <= LARGEST_READ)?];
    gl.read_pixels(x, y, width, height, format, kind, &mut pixels);
    Some(())
}

/// glPixelMapfv.
pub fn pixel_map_floats(gl: &mut Context, a: Args) -> Option<()> {
    let values = a.list(2, a.get(1, int)?, float)?;
    gl.pixel_map(a.get(0, uint)?, &values);
    Some(())
}

/// glPixelMapuiv and glPixelMapusv, whose greatest value is `MAX`.
pub fn pixel_map_integers<const MAX: u32>(gl: &mut Context, a: Args) -> Option<()> {
    let values = a.list(2, a.get(1, int)?, uint)?;
    gl.pixel_map_integers(a.get(0, uint)?, &values, MAX);
    Some(())
}
