//! Texture targets, the targets of their images, and how large they may be.

use afterglow_api::constants::*;

use crate::frame::Dimension;
use crate::pixel::GlResult;

/// GL_MAX_TEXTURE_SIZE.
pub const MAX_SIZE: usize = 4096;
/// GL_MAX_3D_TEXTURE_SIZE.
pub const MAX_3D_SIZE: usize = 512;
/// GL_MAX_CUBE_MAP_TEXTURE_SIZE.
pub const MAX_CUBE_SIZE: usize = 4096;

/// What a texture is bound to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TextureTarget {
    /// GL_TEXTURE_1D.
    D1,
    /// GL_TEXTURE_2D.
    D2,
    /// GL_TEXTURE_3D.
    D3,
    /// GL_TEXTURE_CUBE_MAP.
    Cube,
}

impl TextureTarget {
    /// The target of glBindTexture.
    pub fn from_gl(target: u32) -> Option<TextureTarget> {
        Some(match target {
            GL_TEXTURE_1D => TextureTarget::D1,
            GL_TEXTURE_2D => TextureTarget::D2,
            GL_TEXTURE_3D => TextureTarget::D3,
            GL_TEXTURE_CUBE_MAP => TextureTarget::Cube,
            _ => return None,
        })
    }

    /// Its number.
    pub const fn gl(self) -> u32 {
        match self {
            TextureTarget::D1 => GL_TEXTURE_1D,
            TextureTarget::D2 => GL_TEXTURE_2D,
            TextureTarget::D3 => GL_TEXTURE_3D,
            TextureTarget::Cube => GL_TEXTURE_CUBE_MAP,
        }
    }

    /// Dimensions of a level's image.
    pub const fn dimensions(self) -> usize {
        match self {
            TextureTarget::D1 => 1,
            TextureTarget::D2 | TextureTarget::Cube => 2,
            TextureTarget::D3 => 3,
        }
    }

    /// Dimensionality on the device.
    pub const fn dimension(self) -> Dimension {
        match self {
            TextureTarget::D1 | TextureTarget::D2 => Dimension::D2,
            TextureTarget::D3 => Dimension::D3,
            TextureTarget::Cube => Dimension::Cube,
        }
    }

    /// Number of faces.
    pub const fn faces(self) -> usize {
        if matches!(self, TextureTarget::Cube) { 6 } else { 1 }
    }

    /// Most texels of a level in each direction.
    pub const fn max_size(self, level: usize) -> usize {
        let base = match self {
            TextureTarget::D1 | TextureTarget::D2 => MAX_SIZE,
            TextureTarget::D3 => MAX_3D_SIZE,
            TextureTarget::Cube => MAX_CUBE_SIZE,
        };
        base >> level
    }

    /// Number of levels that a texture may have.
    pub const fn levels(self) -> usize {
        self.max_size(0).ilog2() as usize + 1
    }
}

/// What an image is specified for: a face of a texture, or a proxy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageTarget {
    /// Target of the texture.
    pub texture: TextureTarget,
    /// Face of a cube map, else 0.
    pub face: usize,
    /// Nothing is stored; it is only asked whether it could be.
    pub proxy: bool,
}

impl ImageTarget {
    /// The target of glTexImage and glGetTexLevelParameter.
    ///
    /// # Errors
    /// GL_INVALID_ENUM if it is none.
    pub fn from_gl(target: u32) -> GlResult<ImageTarget> {
        let image = |texture, face, proxy| ImageTarget { texture, face, proxy };
        Ok(match target {
            GL_TEXTURE_1D => image(TextureTarget::D1, 0, false),
            GL_TEXTURE_2D => image(TextureTarget::D2, 0, false),
            GL_TEXTURE_3D => image(TextureTarget::D3, 0, false),
            GL_PROXY_TEXTURE_1D => image(TextureTarget::D1, 0, true),
            GL_PROXY_TEXTURE_2D => image(TextureTarget::D2, 0, true),
            GL_PROXY_TEXTURE_3D => image(TextureTarget::D3, 0, true),
            GL_PROXY_TEXTURE_CUBE_MAP => image(TextureTarget::Cube, 0, true),
            GL_TEXTURE_CUBE_MAP_POSITIVE_X..=GL_TEXTURE_CUBE_MAP_NEGATIVE_Z => {
                let face = (target - GL_TEXTURE_CUBE_MAP_POSITIVE_X) as usize;
                image(TextureTarget::Cube, face, false)
            }
            _ => return Err(GL_INVALID_ENUM),
        })
    }

    /// The target of a command for images of so many dimensions.
    ///
    /// # Errors
    /// GL_INVALID_ENUM if it is none.
    pub fn of_dimensions(target: u32, dimensions: usize) -> GlResult<ImageTarget> {
        let image = ImageTarget::from_gl(target)?;
        if image.texture.dimensions() == dimensions { Ok(image) } else { Err(GL_INVALID_ENUM) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets() {
        let face = ImageTarget::of_dimensions(GL_TEXTURE_CUBE_MAP_NEGATIVE_Y, 2).unwrap();
        assert_eq!((face.texture, face.face, face.proxy), (TextureTarget::Cube, 3, false));
        assert_eq!(ImageTarget::of_dimensions(GL_TEXTURE_2D, 3), Err(GL_INVALID_ENUM));
        assert_eq!(ImageTarget::from_gl(GL_TEXTURE_CUBE_MAP), Err(GL_INVALID_ENUM));
        assert!(ImageTarget::from_gl(GL_PROXY_TEXTURE_3D).unwrap().proxy);
        for target in [TextureTarget::D1, TextureTarget::D2, TextureTarget::D3, TextureTarget::Cube] {
            assert_eq!(TextureTarget::from_gl(target.gl()), Some(target));
        }
        assert_eq!((TextureTarget::D2.levels(), TextureTarget::D3.levels()), (13, 10));
    }
}
