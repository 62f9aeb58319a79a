//! Rows of bytes, four to a pixel: the ways that nearly every texture takes. Written for the compiler to
//! make vectors of.

use crate::frame::BaseFormat;

use super::layout::{PixelFormat, PixelLayout, PixelType};

const ALPHA: u32 = 0xff00_0000;

/// The format whose components lie as bytes in the order that `layout` has in memory, if there is one;
/// `None` means that the pixels are no bytes.
pub fn byte_format(layout: PixelLayout, swap_bytes: bool) -> Option<ByteFormat> {
    let reversed = match layout.kind {
        PixelType::U8 => false,
        PixelType::Packed(packed) if packed.bits == [8; 4] => {
            // A reversed type on a little-endian machine has its first component in the first byte.
            packed.reversed == (cfg!(target_endian = "big") != swap_bytes)
        }
        _ => return None,
    };
    Some(match (layout.format, reversed) {
        (PixelFormat::Rgba, false) => ByteFormat::Rgba,
        (PixelFormat::Rgba, true) => ByteFormat::Abgr,
        (PixelFormat::Bgra, false) => ByteFormat::Bgra,
        (PixelFormat::Bgra, true) => ByteFormat::Argb,
        (PixelFormat::Rgb, _) => ByteFormat::Rgb,
        (PixelFormat::Bgr, _) => ByteFormat::Bgr,
        (PixelFormat::Red, _) => ByteFormat::Single(0x0000_00ff),
        (PixelFormat::Green, _) => ByteFormat::Single(0x0000_ff00),
        (PixelFormat::Blue, _) => ByteFormat::Single(0x00ff_0000),
        (PixelFormat::Luminance, _) => ByteFormat::Single(0x00ff_ffff),
        (PixelFormat::Alpha, _) => ByteFormat::Alpha,
        (PixelFormat::LuminanceAlpha, _) => ByteFormat::LuminanceAlpha,
        _ => return None,
    })
}

/// Pixels of bytes, named by their order in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ByteFormat {
    Rgba,
    Bgra,
    Argb,
    Abgr,
    Rgb,
    Bgr,
    /// One byte, which goes to the bytes of the mask; alpha is 1.
    Single(u32),
    /// One byte, alpha.
    Alpha,
    LuminanceAlpha,
}

/// Writes a row of pixels as RGBA.
pub fn to_rgba(format: ByteFormat, row: &[u8], out: &mut [u8]) {
    match format {
        ByteFormat::Rgba => out.copy_from_slice(row),
        ByteFormat::Bgra => four(row, out, exchange_red_blue),
        ByteFormat::Argb => four(row, out, |argb| argb.rotate_right(8)),
        ByteFormat::Abgr => four(row, out, u32::swap_bytes),
        ByteFormat::Rgb => three(row, out, |rgb| rgb | ALPHA),
        ByteFormat::Bgr => three(row, out, |bgr| exchange_red_blue(bgr) | ALPHA),
        ByteFormat::Single(mask) => {
            one(row, out, |byte| ((u32::from(byte) * 0x0001_0101) & mask) | ALPHA);
        }
        ByteFormat::Alpha => one(row, out, |byte| u32::from(byte) << 24),
        ByteFormat::LuminanceAlpha => {
            for (out, pair) in out.as_chunks_mut().0.iter_mut().zip(row.as_chunks::<2>().0) {
                *out = [pair[0], pair[0], pair[0], pair[1]];
            }
        }
    }
}

/// Writes RGBA pixels as `format` has them; luminance is red. A `Single` format takes the first byte of
/// its mask.
pub fn from_rgba(format: ByteFormat, rgba: &[u8], out: &mut [u8]) {
    let pixels = rgba.as_chunks::<4>().0;
    match format {
        ByteFormat::Rgba => out.copy_from_slice(rgba),
        ByteFormat::Bgra => four(rgba, out, exchange_red_blue),
        ByteFormat::Argb => four(rgba, out, |rgba| rgba.rotate_left(8)),
        ByteFormat::Abgr => four(rgba, out, u32::swap_bytes),
        ByteFormat::Rgb => write(pixels, out, |p| [p[0], p[1], p[2]]),
        ByteFormat::Bgr => write(pixels, out, |p| [p[2], p[1], p[0]]),
        ByteFormat::Single(mask) => {
            let component = (mask.trailing_zeros() / 8) as usize & 3;
            write(pixels, out, |p| [p[component]]);
        }
        ByteFormat::Alpha => write(pixels, out, |p| [p[3]]),
        ByteFormat::LuminanceAlpha => write(pixels, out, |p| [p[0], p[3]]),
    }
}

/// Leaves of RGBA pixels what a texture of that base format keeps, expanded as
/// [`TexelFormat::Rgba8`](crate::frame::TexelFormat::Rgba8) has it (specification, table 3.15).
pub fn restrict(base: BaseFormat, rgba: &mut [u8]) {
    let spread = |x: u32| (x & 0xff) * 0x0001_0101;
    match base {
        BaseFormat::Rgba | BaseFormat::Depth => {}
        BaseFormat::Rgb => each(rgba, |x| x | ALPHA),
        BaseFormat::Alpha => each(rgba, |x| x & ALPHA),
        BaseFormat::Luminance => each(rgba, |x| spread(x) | ALPHA),
        BaseFormat::LuminanceAlpha => each(rgba, |x| spread(x) | (x & ALPHA)),
        BaseFormat::Intensity => each(rgba, |x| spread(x) | (x << 24)),
    }
}

fn exchange_red_blue(x: u32) -> u32 {
    (x & 0xff00_ff00) | ((x >> 16) & 0xff) | ((x & 0xff) << 16)
}

fn each(pixels: &mut [u8], change: impl Fn(u32) -> u32) {
    for pixel in pixels.as_chunks_mut().0 {
        *pixel = change(u32::from_le_bytes(*pixel)).to_le_bytes();
    }
}

fn four(row: &[u8], out: &mut [u8], change: impl Fn(u32) -> u32) {
    for (out, pixel) in out.as_chunks_mut().0.iter_mut().zip(row.as_chunks().0) {
        *out = change(u32::from_le_bytes(*pixel)).to_le_bytes();
    }
}

fn one(row: &[u8], out: &mut [u8], pixel: impl Fn(u8) -> u32) {
    for (out, byte) in out.as_chunks_mut().0.iter_mut().zip(row) {
        *out = pixel(*byte).to_le_bytes();
    }
}

/// Four pixels at a time, from three words; `pixel` gets arbitrary alpha.
fn three(row: &[u8], out: &mut [u8], pixel: impl Fn(u32) -> u32) {
    let (quads, rest) = row.as_chunks::<12>();
    let (out_quads, out_rest) = out.as_chunks_mut::<16>();
    for (out, quad) in out_quads.iter_mut().zip(quads) {
        let word = |i: usize| u32::from_le_bytes([quad[i], quad[i + 1], quad[i + 2], quad[i + 3]]);
        let (a, b, c) = (word(0), word(4), word(8));
        let pixels = [a, (a >> 24) | (b << 8), (b >> 16) | (c << 16), c >> 8];
        for (out, value) in out.as_chunks_mut().0.iter_mut().zip(pixels) {
            *out = pixel(value).to_le_bytes();
        }
    }
    for (out, rgb) in out_rest.as_chunks_mut().0.iter_mut().zip(rest.as_chunks::<3>().0) {
        *out = pixel(u32::from_le_bytes([rgb[0], rgb[1], rgb[2], 0])).to_le_bytes();
    }
}

fn write<const N: usize>(pixels: &[[u8; 4]], out: &mut [u8], pick: impl Fn(&[u8; 4]) -> [u8; N]) {
    for (out, pixel) in out.as_chunks_mut().0.iter_mut().zip(pixels) {
        *out = pick(pixel);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rgba(format: ByteFormat, row: &[u8], pixels: usize) -> Vec<u8> {
        let mut out = vec![99; 4 * pixels];
        to_rgba(format, row, &mut out);
        out
    }

    #[test]
    fn orders() {
        let row = [1, 2, 3, 4, 5, 6, 7, 8];
        assert_eq!(rgba(ByteFormat::Bgra, &row, 2), [3, 2, 1, 4, 7, 6, 5, 8]);
        assert_eq!(rgba(ByteFormat::Argb, &row, 2), [2, 3, 4, 1, 6, 7, 8, 5]);
        assert_eq!(rgba(ByteFormat::Abgr, &row, 2), [4, 3, 2, 1, 8, 7, 6, 5]);
        assert_eq!(rgba(ByteFormat::Alpha, &row[..1], 1), [0, 0, 0, 1]);
        assert_eq!(rgba(ByteFormat::Single(0xff00), &row[..1], 1), [0, 1, 0, 255]);
        assert_eq!(rgba(ByteFormat::LuminanceAlpha, &row[..2], 1), [1, 1, 1, 2]);
    }

    #[test]
    fn triples_of_any_number() {
        let row: Vec<u8> = (1..=27).collect();
        for pixels in 1..=9 {
            let expected: Vec<u8> =
                (0..pixels as u8).flat_map(|i| [3 * i + 1, 3 * i + 2, 3 * i + 3, 255]).collect();
            assert_eq!(rgba(ByteFormat::Rgb, &row[..3 * pixels], pixels), expected);
        }
        assert_eq!(rgba(ByteFormat::Bgr, &row[..15], 5)[16..], [15, 14, 13, 255]);
    }

    #[test]
    fn base_formats() {
        let restricted = |base| {
            let mut pixel = [10, 20, 30, 40];
            restrict(base, &mut pixel);
            pixel
        };
        assert_eq!(restricted(BaseFormat::Alpha), [0, 0, 0, 40]);
        assert_eq!(restricted(BaseFormat::Luminance), [10, 10, 10, 255]);
        assert_eq!(restricted(BaseFormat::LuminanceAlpha), [10, 10, 10, 40]);
        assert_eq!(restricted(BaseFormat::Intensity), [10, 10, 10, 10]);
        assert_eq!(restricted(BaseFormat::Rgb), [10, 20, 30, 255]);
        assert_eq!(restricted(BaseFormat::Rgba), [10, 20, 30, 40]);
    }

    #[test]
    fn packed_words_are_bytes() {
        let of = |format, kind, swap| byte_format(PixelLayout::from_gl(format, kind).unwrap(), swap);
        use afterglow_api::constants::*;
        assert_eq!(of(GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, false), Some(ByteFormat::Rgba));
        assert_eq!(of(GL_BGRA, GL_UNSIGNED_INT_8_8_8_8, false), Some(ByteFormat::Argb));
        assert_eq!(of(GL_BGRA, GL_UNSIGNED_INT_8_8_8_8, true), Some(ByteFormat::Bgra));
        assert_eq!(of(GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, false), None);
        assert_eq!(of(GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, false), None);
    }
}
