//! glCompressedTexImage: S3TC images, which are decoded and kept (specification, 3.8.3).

use std::sync::Arc;

use afterglow_api::constants::*;

use crate::frame::Operation;
use crate::pixel::{GlResult, allocate};

use super::internal_format::InternalFormat;
use super::level::{Level, TEXEL_BYTES, Texels};
use super::object::TextureObject;
use super::s3tc::{BLOCK, Scheme};
use super::specify::{ImageDefinition, level_number};
use super::sub_image::SubImage;
use super::target::TextureTarget;

fn decode(scheme: Scheme, width: usize, height: usize, blocks: &[u8]) -> GlResult<Arc<[u8]>> {
    let mut texels = allocate(width * height * TEXEL_BYTES)?;
    if let Some(texels) = Arc::get_mut(&mut texels) {
        scheme.decode(width, height, blocks, texels);
    }
    Ok(texels)
}

impl TextureObject {
    /// The scheme of a compressed format, which only two-dimensional images have.
    fn scheme(&self, format: u32) -> GlResult<Scheme> {
        let planar = matches!(self.target, TextureTarget::D2 | TextureTarget::Cube);
        Scheme::from_gl(format).filter(|_| planar).ok_or(GL_INVALID_ENUM)
    }

    /// glCompressedTexImage.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for a format that is none of S3TC; GL_INVALID_VALUE for a bad level or size, or if
    /// there are not exactly as many bytes as the image has; GL_INVALID_OPERATION for a border;
    /// GL_OUT_OF_MEMORY.
    pub fn compressed_image(
        &mut self,
        face: usize,
        definition: &ImageDefinition,
        data: &[u8],
    ) -> GlResult<()> {
        let scheme = self.scheme(definition.internal_format)?;
        let format = InternalFormat::from_gl(definition.internal_format).ok_or(GL_INVALID_ENUM)?;
        let (number, border) = definition.check(self.target, format)?;
        if border != 0 {
            return Err(GL_INVALID_OPERATION);
        }
        let size = definition.interior(self.target, number, border)?;
        let (width, height) = (size[0] as usize, size[1] as usize);
        if data.len() != scheme.image_bytes(width, height) {
            return Err(GL_INVALID_VALUE);
        }
        let mut level = Level::new(size, border, format);
        level.texels = Texels::Memory(decode(scheme, width, height, data)?);
        level.compressed = Some((definition.internal_format, data.into()));
        self.set_level(face, number, Some(level));
        Ok(())
    }

    /// glCompressedTexSubImage.
    ///
    /// # Errors
    /// As [`compressed_image`](Self::compressed_image); GL_INVALID_OPERATION also for another format than the
    /// level's or a part that is not of whole blocks.
    pub fn compressed_sub_image(
        &mut self,
        face: usize,
        sub: &SubImage,
        format: u32,
        data: &[u8],
        out: &mut Vec<Operation>,
    ) -> GlResult<()> {
        let scheme = self.scheme(format)?;
        let part = self.part(face, sub)?;
        let level = self.level_mut(face, part.level).ok_or(GL_INVALID_OPERATION)?;
        let whole_blocks = (0..2).all(|i| {
            let (begin, end) = (part.offset[i] as usize, (part.offset[i] + part.extent[i]) as usize);
            begin.is_multiple_of(BLOCK) && (end.is_multiple_of(BLOCK) || end == level.size[i] as usize)
        });
        if !whole_blocks || level.compressed.as_ref().is_none_or(|(of, _)| *of != format) {
            return Err(GL_INVALID_OPERATION);
        }
        let (width, height) = (part.extent[0] as usize, part.extent[1] as usize);
        if data.len() != scheme.image_bytes(width, height) {
            return Err(GL_INVALID_VALUE);
        }
        if part.is_empty() {
            return Ok(());
        }
        let texels = decode(scheme, width, height, data)?;
        let level_row = scheme.row_bytes(level.size[0] as usize);
        let mut compressed = level.compressed.take();
        if let Some((_, blocks)) = &mut compressed {
            let first =
                part.offset[1] as usize / BLOCK * level_row + scheme.row_bytes(part.offset[0] as usize);
            let blocks = &mut Arc::make_mut(blocks)[first..];
            let row_bytes = scheme.row_bytes(width);
            for (row, new) in blocks.chunks_mut(level_row).zip(data.chunks_exact(row_bytes)) {
                row[..row_bytes].copy_from_slice(new);
            }
        }
        self.write_part(face, part, texels, out)?;
        if let Some(level) = self.level_mut(face, part.level) {
            level.compressed = compressed;
        }
        Ok(())
    }

    /// The compressed image of a level (glGetCompressedTexImage).
    ///
    /// # Errors
    /// GL_INVALID_VALUE for a level that cannot be, GL_INVALID_OPERATION for one that is not compressed.
    pub fn compressed_data(&self, face: usize, level: i32) -> GlResult<&[u8]> {
        let level = self.level(face, level_number(self.target, level)?);
        let compressed = level.and_then(|level| level.compressed.as_ref());
        compressed.map(|(_, blocks)| &**blocks).ok_or(GL_INVALID_OPERATION)
    }
}
