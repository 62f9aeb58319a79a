//! Texels of every layout as four bytes or, where light may be beyond white, four half floats.

use half::f16;

use crate::read::Layout;

/// Texels along a block's side.
const EDGE: usize = 4;
/// Bytes of a decoded block, four a texel.
const BYTES: usize = 4 * EDGE * EDGE;

/// A level's texels: four bytes each, of BC6H four half floats. `texels` must have as many bytes as the layout says.
/// Channels that the layout lacks are 255, or 1.
pub(crate) fn unpack(layout: Layout, width: u32, height: u32, texels: &[u8]) -> Vec<u8> {
    let size = [width as usize, height as usize];
    match layout {
        Layout::Rgba8 | Layout::Rgbx8 => texels.to_vec(),
        Layout::R8 => each::<1>(texels, |[r]| [r, r, r, 255]),
        Layout::Rg8 => each::<2>(texels, |[r, g]| [r, g, 255, 255]),
        Layout::Rgb8 => each::<3>(texels, |[r, g, b]| [r, g, b, 255]),
        Layout::Bgr8 => each::<3>(texels, |[b, g, r]| [r, g, b, 255]),
        Layout::Bgra8 => each::<4>(texels, |[b, g, r, a]| [r, g, b, a]),
        Layout::Bgrx8 => each::<4>(texels, |[b, g, r, _]| [r, g, b, 255]),
        Layout::Bc1 => {
            opaque(blocks::<BYTES>(size, 8, texels, |block, out| bcdec_rs::bc1(block, out, 4 * EDGE)))
        }
        Layout::Bc1Alpha => {
            blocks::<BYTES>(size, 8, texels, |block, out| bcdec_rs::bc1(block, out, 4 * EDGE))
        }
        Layout::Bc2 => blocks::<BYTES>(size, 16, texels, |block, out| bcdec_rs::bc2(block, out, 4 * EDGE)),
        Layout::Bc3 => blocks::<BYTES>(size, 16, texels, |block, out| bcdec_rs::bc3(block, out, 4 * EDGE)),
        Layout::Bc7 => blocks::<BYTES>(size, 16, texels, |block, out| bcdec_rs::bc7(block, out, 4 * EDGE)),
        Layout::Bc4 => blocks::<BYTES>(size, 8, texels, |block, out| {
            let mut red = [0; EDGE * EDGE];
            bcdec_rs::bc4(block, &mut red, EDGE, false);
            out.copy_from_slice(&each::<1>(&red, |[r]| [r, r, r, 255]));
        }),
        Layout::Bc5 => blocks::<BYTES>(size, 16, texels, |block, out| {
            let mut two = [0; 2 * EDGE * EDGE];
            bcdec_rs::bc5(block, &mut two, 2 * EDGE, false);
            out.copy_from_slice(&each::<2>(&two, |[r, g]| [r, g, 255, 255]));
        }),
        Layout::Bc6h { is_signed } => blocks::<{ 2 * BYTES }>(size, 16, texels, |block, out| {
            let mut light = [0.0; 3 * EDGE * EDGE];
            bcdec_rs::bc6h_float(block, &mut light, 3 * EDGE, is_signed);
            let (light, _) = light.as_chunks::<3>();
            for (light, out) in light.iter().zip(out.as_chunks_mut::<8>().0) {
                let [r, g, b] = light.map(encoded);
                *out = bytemuck::cast([r, g, b, f16::ONE]);
            }
        }),
    }
}

fn each<const N: usize>(texels: &[u8], texel: impl Fn([u8; N]) -> [u8; 4]) -> Vec<u8> {
    texels.as_chunks::<N>().0.iter().flat_map(|stored| texel(*stored)).collect()
}

fn opaque(mut texels: Vec<u8>) -> Vec<u8> {
    texels.as_chunks_mut::<4>().0.iter_mut().for_each(|texel| texel[3] = 255);
    texels
}

/// Radiance as sRGB encodes it, beyond white as well; what is none counts as 0.
fn encoded(linear: f32) -> f16 {
    let linear = if linear.is_finite() { linear.max(0.0) } else { 0.0 };
    f16::from_f32(crate::mipmaps::srgb_from_linear(linear))
}

/// Decodes blocks of so many bytes to rows of texels; what of a block lies outside the picture is left out.
fn blocks<const N: usize>(
    [width, height]: [usize; 2],
    block_bytes: usize,
    texels: &[u8],
    decode: impl Fn(&[u8], &mut [u8; N]),
) -> Vec<u8> {
    let bytes = N / (EDGE * EDGE);
    let mut rows = vec![0; width * height * bytes];
    let across = width.div_ceil(EDGE);
    let mut decoded = [0; N];
    for (number, block) in texels.chunks_exact(block_bytes).enumerate() {
        decode(block, &mut decoded);
        let (left, top) = (number % across * EDGE, number / across * EDGE);
        let columns = EDGE.min(width - left) * bytes;
        for (y, row) in decoded.chunks_exact(EDGE * bytes).enumerate().take(height.saturating_sub(top)) {
            let first = ((top + y) * width + left) * bytes;
            rows[first..first + columns].copy_from_slice(&row[..columns]);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_come_in_order() {
        assert_eq!(unpack(Layout::Bgr8, 1, 1, &[1, 2, 3]), [3, 2, 1, 255]);
        assert_eq!(unpack(Layout::Bgra8, 1, 1, &[1, 2, 3, 4]), [3, 2, 1, 4]);
        assert_eq!(unpack(Layout::R8, 2, 1, &[7, 9]), [7, 7, 7, 255, 9, 9, 9, 255]);
    }

    #[test]
    fn blocks_reach_over_the_edge() {
        // Two blocks of BC4, one of 10 and one of 20, for 5x3 texels.
        let block = |value: u8| [value, 0, 0, 0, 0, 0, 0, 0];
        let texels = unpack(Layout::Bc4, 5, 3, &[block(10), block(20)].concat());
        let red: Vec<u8> = texels.iter().step_by(4).copied().collect();
        assert_eq!(red, [[10, 10, 10, 10, 20]; 3].concat());
    }
}
