//! Decoding of S3TC blocks: DXT1, DXT3, DXT5 (EXT_texture_compression_s3tc).

use afterglow_api::constants::*;

/// The formats that are decoded.
pub const FORMATS: [u32; 4] = [
    GL_COMPRESSED_RGB_S3TC_DXT1_EXT,
    GL_COMPRESSED_RGBA_S3TC_DXT1_EXT,
    GL_COMPRESSED_RGBA_S3TC_DXT3_EXT,
    GL_COMPRESSED_RGBA_S3TC_DXT5_EXT,
];

/// Texels of a block in each direction.
pub const BLOCK: usize = 4;

/// A block's colours, RGBA, rows from t = 0 upward.
type Texels = [[u8; 4]; BLOCK * BLOCK];

/// How blocks are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// Colours only.
    Dxt1,
    /// Colours, one of which may be transparent.
    Dxt1Alpha,
    /// Four bits of alpha a texel.
    Dxt3,
    /// Interpolated alpha.
    Dxt5,
}

impl Scheme {
    /// The scheme of that internal format.
    pub fn from_gl(format: u32) -> Option<Scheme> {
        Some(match format {
            GL_COMPRESSED_RGB_S3TC_DXT1_EXT => Scheme::Dxt1,
            GL_COMPRESSED_RGBA_S3TC_DXT1_EXT => Scheme::Dxt1Alpha,
            GL_COMPRESSED_RGBA_S3TC_DXT3_EXT => Scheme::Dxt3,
            GL_COMPRESSED_RGBA_S3TC_DXT5_EXT => Scheme::Dxt5,
            _ => return None,
        })
    }

    /// Bytes of a block.
    pub const fn block_bytes(self) -> usize {
        match self {
            Scheme::Dxt1 | Scheme::Dxt1Alpha => 8,
            Scheme::Dxt3 | Scheme::Dxt5 => 16,
        }
    }

    /// Bytes of a row of blocks.
    pub const fn row_bytes(self, width: usize) -> usize {
        width.div_ceil(BLOCK) * self.block_bytes()
    }

    /// Bytes of an image.
    pub const fn image_bytes(self, width: usize, height: usize) -> usize {
        self.row_bytes(width) * height.div_ceil(BLOCK)
    }

    /// Decodes an image of [`image_bytes`](Self::image_bytes) to RGBA bytes.
    pub fn decode(self, width: usize, height: usize, blocks: &[u8], out: &mut [u8]) {
        if width == 0 || height == 0 {
            return;
        }
        let rows = blocks.chunks_exact(self.row_bytes(width));
        for (row, out) in rows.zip(out.chunks_mut(4 * BLOCK * width)) {
            for (i, block) in row.chunks_exact(self.block_bytes()).enumerate() {
                place(&self.block(block), i * BLOCK, width, out);
            }
        }
    }

    fn block(self, block: &[u8]) -> Texels {
        let half = |i: usize| std::array::from_fn(|byte| block[8 * i + byte]);
        match self {
            Scheme::Dxt1 => colors(half(0), true).map(|[r, g, b, _]| [r, g, b, 255]),
            Scheme::Dxt1Alpha => colors(half(0), true),
            Scheme::Dxt3 => with_alpha(colors(half(1), false), dxt3_alpha(half(0))),
            Scheme::Dxt5 => with_alpha(colors(half(1), false), dxt5_alpha(half(0))),
        }
    }
}

/// Writes a block's texels to a row of blocks as far as they are inside the image.
fn place(texels: &Texels, x: usize, width: usize, rows: &mut [u8]) {
    let columns = BLOCK.min(width - x);
    for (row, texels) in rows.chunks_exact_mut(4 * width).zip(texels.chunks_exact(BLOCK)) {
        let row = &mut row.as_chunks_mut().0[x..x + columns];
        row.copy_from_slice(&texels[..columns]);
    }
}

fn with_alpha(mut texels: Texels, alpha: [u8; BLOCK * BLOCK]) -> Texels {
    texels.iter_mut().zip(alpha).for_each(|(texel, alpha)| texel[3] = alpha);
    texels
}

fn expand_565(color: u16) -> [u32; 3] {
    let (r, g, b) = (u32::from(color >> 11), u32::from(color >> 5) & 63, u32::from(color) & 31);
    [(r << 3) | (r >> 2), (g << 2) | (g >> 4), (b << 3) | (b >> 2)]
}

/// Two colours and two between them, or with `punch_through` and a first colour not greater than the second,
/// one between them and transparent black.
fn colors(block: [u8; 8], punch_through: bool) -> Texels {
    let [a, b, c, d, i0, i1, i2, i3] = block;
    let (first, second) = (u16::from_le_bytes([a, b]), u16::from_le_bytes([c, d]));
    let (p, q) = (expand_565(first), expand_565(second));
    let mix = |wp: u32, wq: u32| {
        let [r, g, b] = std::array::from_fn(|i| ((p[i] * wp + q[i] * wq) / (wp + wq)) as u8);
        [r, g, b, 255]
    };
    let palette = if !punch_through || first > second {
        [mix(1, 0), mix(0, 1), mix(2, 1), mix(1, 2)]
    } else {
        [mix(1, 0), mix(0, 1), mix(1, 1), [0; 4]]
    };
    let indices = u32::from_le_bytes([i0, i1, i2, i3]);
    std::array::from_fn(|i| palette[(indices >> (2 * i) & 3) as usize])
}

fn dxt3_alpha(block: [u8; 8]) -> [u8; BLOCK * BLOCK] {
    let bits = u64::from_le_bytes(block);
    std::array::from_fn(|i| ((bits >> (4 * i) & 15) * 17) as u8)
}

/// Two alphas and six between them; or, if the first is not greater, four between them, 0 and 255.
fn dxt5_alpha(block: [u8; 8]) -> [u8; BLOCK * BLOCK] {
    let (first, second) = (u32::from(block[0]), u32::from(block[1]));
    let steps = if first > second { 7 } else { 5 };
    let alpha = |code: u32| match code {
        0 => first,
        1 => second,
        6 if steps == 5 => 0,
        7 if steps == 5 => 255,
        code => ((steps + 1 - code) * first + (code - 1) * second) / steps,
    };
    let bits = u64::from_le_bytes(block) >> 16;
    std::array::from_fn(|i| alpha((bits >> (3 * i) & 7) as u32) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decode(scheme: Scheme, size: (usize, usize), blocks: &[u8]) -> Vec<[u8; 4]> {
        let mut out = vec![7; 4 * size.0 * size.1];
        scheme.decode(size.0, size.1, blocks, &mut out);
        out.as_chunks().0.to_vec()
    }

    /// Red and blue; first row codes 0, 1, 2, 3, the rest 0.
    const RED_BLUE: [u8; 8] = [0x00, 0xf8, 0x1f, 0x00, 0b1110_0100, 0, 0, 0];

    #[test]
    fn dxt1() {
        let texels = decode(Scheme::Dxt1, (4, 4), &RED_BLUE);
        assert_eq!(texels[..4], [[255, 0, 0, 255], [0, 0, 255, 255], [170, 0, 85, 255], [85, 0, 170, 255]]);
        assert_eq!(texels[4..], [[255, 0, 0, 255]; 12]);
        // Exchanged, the fourth code is black, transparent where there is alpha.
        let exchanged = [0x1f, 0x00, 0x00, 0xf8, 0b1110_0100, 0, 0, 0];
        let texels = decode(Scheme::Dxt1Alpha, (4, 4), &exchanged);
        assert_eq!(texels[..4], [[0, 0, 255, 255], [255, 0, 0, 255], [127, 0, 127, 255], [0, 0, 0, 0]]);
        assert_eq!(decode(Scheme::Dxt1, (4, 4), &exchanged)[3], [0, 0, 0, 255]);
    }

    #[test]
    fn dxt3_and_5() {
        let mut block = [0x10, 0xf2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        block[8..].copy_from_slice(&RED_BLUE);
        let texels = decode(Scheme::Dxt3, (4, 4), &block);
        assert_eq!(texels[..4], [[255, 0, 0, 0], [0, 0, 255, 17], [170, 0, 85, 34], [85, 0, 170, 255]]);
        // Alphas 255 and 3, codes 0, 1, 2, 7 in three bits each.
        let codes: u64 = (1 << 3) | (2 << 6) | (7 << 9);
        block[..8].copy_from_slice(&(codes << 16 | 3 << 8 | 255).to_le_bytes());
        let alphas: Vec<u8> = decode(Scheme::Dxt5, (4, 4), &block).iter().map(|texel| texel[3]).collect();
        assert_eq!(alphas[..4], [255, 3, (6 * 255 + 3) / 7, (255 + 6 * 3) / 7].map(|a: i32| a as u8));
        block[..8].copy_from_slice(&(codes << 16 | 255 << 8 | 3).to_le_bytes());
        let alphas: Vec<u8> = decode(Scheme::Dxt5, (4, 4), &block).iter().map(|texel| texel[3]).collect();
        assert_eq!(alphas[..4], [3, 255, ((4 * 3 + 255) / 5) as u8, 255]);
    }

    #[test]
    fn parts_of_blocks() {
        let mut blocks = [RED_BLUE; 4].concat();
        blocks[8..10].copy_from_slice(&[0xe0, 0xff]);
        let texels = decode(Scheme::Dxt1, (5, 6), &blocks);
        assert_eq!(texels.len(), 30);
        assert_eq!((texels[4], texels[5]), ([255, 255, 0, 255], [255, 0, 0, 255]));
        assert_eq!(Scheme::Dxt5.image_bytes(5, 6), 64);
        assert_eq!(Scheme::Dxt1.image_bytes(0, 6), 0);
    }
}
