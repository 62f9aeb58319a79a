//! GL_GENERATE_MIPMAP: levels above the base by a box filter (specification, 3.8.8). They are defined when
//! the base changes, and computed when someone looks.

use std::sync::Arc;

use crate::frame::TexelFormat;
use crate::pixel::allocate;

use super::images::mip_size;
use super::level::{TEXEL_BYTES, Texels};
use super::object::TextureObject;

impl TextureObject {
    /// Computes the levels that are still to be derived. Those of a base that is only on the device cannot be;
    /// the texture is then sampled without.
    pub(super) fn settle_mipmaps(&mut self) {
        let stale = std::mem::take(&mut self.stale);
        for face in (0..self.faces.len()).filter(|face| stale & (1 << face) != 0) {
            self.derive_texels(face);
        }
    }

    fn derive_texels(&mut self, face: usize) {
        let base_level = self.parameters.base_level;
        let Some(base) = self.level(face, base_level) else { return };
        let (mut size, format) = (base.size, base.format.texel_format());
        let mut texels = match &base.texels {
            Texels::Memory(texels) => texels.clone(),
            Texels::Undefined => return self.underivable &= !(1 << face),
            Texels::Device => return self.underivable |= 1 << face,
        };
        self.underivable &= !(1 << face);
        for level in self.faces[face].iter_mut().skip(base_level + 1) {
            let next = mip_size(size, 1);
            let Some(level) = level.as_mut().filter(|level| level.size == next) else { return };
            let Some(halved) = halve(&texels, size, format) else { return };
            (level.texels, level.held_by) = (Texels::Memory(halved.clone()), None);
            (texels, size) = (halved, next);
            if size == [1; 3] {
                return;
            }
        }
    }
}

/// The next level. `None` if there is no memory.
fn halve(texels: &[u8], size: [u32; 3], format: TexelFormat) -> Option<Arc<[u8]>> {
    let next = mip_size(size, 1);
    let bytes = next.iter().map(|n| *n as usize).product::<usize>() * TEXEL_BYTES;
    let mut out = allocate(bytes).ok()?;
    let average = match format {
        TexelFormat::Rgba8 => average_bytes,
        TexelFormat::Depth32 => average_depths,
    };
    box_filter(texels.as_chunks().0, size, Arc::get_mut(&mut out)?.as_chunks_mut().0, next, average);
    Some(out)
}

type Texel = [u8; TEXEL_BYTES];

/// Each texel becomes the average of eight, some of which are the same where a side has length 1. What is
/// left over of odd sides is dropped.
fn box_filter(
    texels: &[Texel],
    size: [u32; 3],
    out: &mut [Texel],
    next: [u32; 3],
    average: impl Fn([Texel; 8]) -> Texel,
) {
    let [width, height, depth] = size.map(|n| n as usize);
    let [columns, rows, _] = next.map(|n| n as usize);
    let pair = |i: usize, side: usize| [2 * i, (2 * i + 1).min(side - 1)].map(|i| i.min(side - 1));
    for (i, out) in out.chunks_exact_mut(columns).enumerate() {
        let ([y0, y1], [z0, z1]) = (pair(i % rows, height), pair(i / rows, depth));
        let lines = [(z0, y0), (z0, y1), (z1, y0), (z1, y1)];
        let [a, b, c, d] = lines.map(|(z, y)| &texels[(z * height + y) * width..][..width]);
        for (x, out) in out.iter_mut().enumerate() {
            let [l, r] = pair(x, width);
            *out = average([a[l], a[r], b[l], b[r], c[l], c[r], d[l], d[r]]);
        }
    }
}

fn average_bytes(texels: [Texel; 8]) -> Texel {
    std::array::from_fn(|i| {
        let sum: u16 = texels.iter().map(|texel| u16::from(texel[i])).sum();
        ((sum + 4) / 8) as u8
    })
}

fn average_depths(texels: [Texel; 8]) -> Texel {
    let sum: f32 = texels.iter().map(|texel| f32::from_ne_bytes(*texel)).sum();
    (sum / 8.0).to_ne_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reds(width: u32, height: u32, depth: u32, reds: &[u8]) -> Vec<u8> {
        let texels: Vec<u8> = reds.iter().flat_map(|red| [*red, 0, 0, 255]).collect();
        let out = halve(&texels, [width, height, depth], TexelFormat::Rgba8).unwrap();
        assert!(out.as_chunks::<4>().0.iter().all(|texel| texel[3] == 255));
        out.as_chunks::<4>().0.iter().map(|texel| texel[0]).collect()
    }

    #[test]
    fn averages() {
        assert_eq!(reds(2, 2, 1, &[0, 1, 2, 3]), [2]);
        assert_eq!(reds(4, 1, 1, &[0, 10, 20, 40]), [5, 30]);
        assert_eq!(reds(1, 2, 1, &[100, 200]), [150]);
        assert_eq!(reds(2, 2, 2, &[8, 8, 8, 8, 0, 0, 0, 0]), [4]);
        // Of three, the third is dropped.
        assert_eq!(reds(3, 3, 1, &[0, 4, 99, 8, 12, 99, 99, 99, 99]), [6]);
    }

    #[test]
    fn depths() {
        let texels: Vec<u8> = [0.0f32, 1.0, 0.5, 0.5].iter().flat_map(|depth| depth.to_ne_bytes()).collect();
        let out = halve(&texels, [2, 2, 1], TexelFormat::Depth32).unwrap();
        assert_eq!(*out, 0.5f32.to_ne_bytes());
    }
}
