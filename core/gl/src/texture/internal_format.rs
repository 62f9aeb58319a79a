//! Internal formats (specification, tables 3.15 and 3.16; EXT_texture_compression_s3tc).

use afterglow_api::constants::*;

use crate::frame::{BaseFormat, TexelFormat};

/// What a program asked a texture's texels to be. Every colour is stored in four bytes, whatever size was
/// asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InternalFormat {
    /// The number that was asked for; for formats of compression that are stored plainly, their base format's.
    pub number: u32,
    /// What the texels mean.
    pub base: BaseFormat,
}

impl InternalFormat {
    /// The format of that number; for compressed formats, how they are stored when the texels come plain.
    pub fn from_gl(format: u32) -> Option<InternalFormat> {
        let base = match format {
            GL_ALPHA | GL_ALPHA4 | GL_ALPHA8 | GL_ALPHA12 | GL_ALPHA16 | GL_COMPRESSED_ALPHA => {
                BaseFormat::Alpha
            }
            1
            | GL_LUMINANCE
            | GL_LUMINANCE4
            | GL_LUMINANCE8
            | GL_LUMINANCE12
            | GL_LUMINANCE16
            | GL_COMPRESSED_LUMINANCE => BaseFormat::Luminance,
            2
            | GL_LUMINANCE_ALPHA
            | GL_LUMINANCE4_ALPHA4
            | GL_LUMINANCE6_ALPHA2
            | GL_LUMINANCE8_ALPHA8
            | GL_LUMINANCE12_ALPHA4
            | GL_LUMINANCE12_ALPHA12
            | GL_LUMINANCE16_ALPHA16
            | GL_COMPRESSED_LUMINANCE_ALPHA => BaseFormat::LuminanceAlpha,
            GL_INTENSITY
            | GL_INTENSITY4
            | GL_INTENSITY8
            | GL_INTENSITY12
            | GL_INTENSITY16
            | GL_COMPRESSED_INTENSITY => BaseFormat::Intensity,
            3
            | GL_RGB
            | GL_R3_G3_B2
            | GL_RGB4
            | GL_RGB5
            | GL_RGB8
            | GL_RGB10
            | GL_RGB12
            | GL_RGB16
            | GL_COMPRESSED_RGB
            | GL_COMPRESSED_RGB_S3TC_DXT1_EXT => BaseFormat::Rgb,
            4 | GL_RGBA | GL_RGBA2 | GL_RGBA4 | GL_RGB5_A1 | GL_RGBA8 | GL_RGB10_A2 | GL_RGBA12
            | GL_RGBA16 | GL_COMPRESSED_RGBA => BaseFormat::Rgba,
            GL_COMPRESSED_RGBA_S3TC_DXT1_EXT
            | GL_COMPRESSED_RGBA_S3TC_DXT3_EXT
            | GL_COMPRESSED_RGBA_S3TC_DXT5_EXT => BaseFormat::Rgba,
            GL_DEPTH_COMPONENT | GL_DEPTH_COMPONENT16 | GL_DEPTH_COMPONENT24 | GL_DEPTH_COMPONENT32 => {
                BaseFormat::Depth
            }
            _ => return None,
        };
        let number = if is_compressed(format) { base_number(base) } else { format };
        Some(InternalFormat { number, base })
    }

    /// Storage of the texels.
    pub fn texel_format(self) -> TexelFormat {
        if self.base == BaseFormat::Depth { TexelFormat::Depth32 } else { TexelFormat::Rgba8 }
    }

    /// Bits of a component as glGetTexLevelParameter names it (GL_TEXTURE_RED_SIZE and so on), as they are
    /// stored; `None` if it names none.
    pub fn component_bits(self, pname: u32) -> Option<i32> {
        use BaseFormat::*;
        let (holders, bits): (&[BaseFormat], i32) = match pname {
            GL_TEXTURE_RED_SIZE | GL_TEXTURE_GREEN_SIZE | GL_TEXTURE_BLUE_SIZE => (&[Rgb, Rgba], 8),
            GL_TEXTURE_ALPHA_SIZE => (&[Alpha, LuminanceAlpha, Rgba], 8),
            GL_TEXTURE_LUMINANCE_SIZE => (&[Luminance, LuminanceAlpha], 8),
            GL_TEXTURE_INTENSITY_SIZE => (&[Intensity], 8),
            GL_TEXTURE_DEPTH_SIZE => (&[Depth], 32),
            _ => return None,
        };
        Some(if holders.contains(&self.base) { bits } else { 0 })
    }
}

fn is_compressed(format: u32) -> bool {
    matches!(
        format,
        GL_COMPRESSED_ALPHA..=GL_COMPRESSED_RGBA
            | GL_COMPRESSED_RGB_S3TC_DXT1_EXT..=GL_COMPRESSED_RGBA_S3TC_DXT5_EXT
    )
}

fn base_number(base: BaseFormat) -> u32 {
    match base {
        BaseFormat::Alpha => GL_ALPHA,
        BaseFormat::Luminance => GL_LUMINANCE,
        BaseFormat::LuminanceAlpha => GL_LUMINANCE_ALPHA,
        BaseFormat::Intensity => GL_INTENSITY,
        BaseFormat::Rgb => GL_RGB,
        BaseFormat::Rgba => GL_RGBA,
        BaseFormat::Depth => GL_DEPTH_COMPONENT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bases_and_bits() {
        let of = |format| InternalFormat::from_gl(format).unwrap();
        assert_eq!(of(3).base, BaseFormat::Rgb);
        assert_eq!((of(GL_RGB5_A1).base, of(GL_RGB5_A1).number), (BaseFormat::Rgba, GL_RGB5_A1));
        assert_eq!(of(GL_COMPRESSED_INTENSITY).number, GL_INTENSITY);
        assert_eq!(of(GL_COMPRESSED_RGBA_S3TC_DXT5_EXT).number, GL_RGBA);
        assert_eq!(of(GL_LUMINANCE).component_bits(GL_TEXTURE_LUMINANCE_SIZE), Some(8));
        assert_eq!(of(GL_LUMINANCE).component_bits(GL_TEXTURE_ALPHA_SIZE), Some(0));
        assert_eq!(of(GL_DEPTH_COMPONENT16).component_bits(GL_TEXTURE_DEPTH_SIZE), Some(32));
        assert_eq!(of(GL_RGB).component_bits(GL_TEXTURE_WIDTH), None);
        for unknown in [0, 5, GL_BGRA, GL_STENCIL_INDEX, GL_RED] {
            assert_eq!(InternalFormat::from_gl(unknown), None);
        }
    }
}
