//! glTexSubImage: parts of images from the program's memory (specification, 3.8.2).

use std::sync::Arc;

use afterglow_api::constants::*;

use crate::frame::{ImageUpload, Operation};
use crate::pixel::{GlResult, unpack_texels};

use super::level::Texels;
use super::object::TextureObject;
use super::specify::{PixelInput, extent_of, level_number};

/// A part of a level, as the program says it. Directions that the target lacks have offset 0 and size 1.
#[derive(Debug, Clone, Copy)]
pub struct SubImage {
    /// Level.
    pub level: i32,
    /// First texel; the border has negative ones.
    pub offset: [i32; 3],
    /// Texels.
    pub size: [i32; 3],
}

/// A part of a level without what is in the border.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// Level.
    pub level: usize,
    /// Texels of the given image that come before the first.
    pub skip: [u32; 3],
    /// First texel.
    pub offset: [u32; 3],
    /// Texels.
    pub extent: [u32; 3],
}

impl Part {
    pub fn is_empty(&self) -> bool {
        self.extent.contains(&0)
    }
}

impl TextureObject {
    /// Finds a part of a level.
    ///
    /// # Errors
    /// GL_INVALID_VALUE if the level has no such part, GL_INVALID_OPERATION if there is no such level.
    pub(super) fn part(&self, face: usize, sub: &SubImage) -> GlResult<Part> {
        let number = level_number(self.target, sub.level)?;
        let level = self.level(face, number).ok_or(GL_INVALID_OPERATION)?;
        let mut part = Part { level: number, skip: [0; 3], offset: [0; 3], extent: [0; 3] };
        for i in 0..3 {
            let (size, border) = (i64::from(level.size[i]), i64::from(level.border_in(self.target, i)));
            let (first, count) = (i64::from(sub.offset[i]), i64::from(sub.size[i]));
            if count < 0 || first < -border || first + count > size + border {
                return Err(GL_INVALID_VALUE);
            }
            // Between 0 and the level's size from here on.
            let begin = first.clamp(0, size);
            let end = (first + count).clamp(begin, size);
            part.skip[i] = (begin - first) as u32;
            part.offset[i] = begin as u32;
            part.extent[i] = (end - begin) as u32;
        }
        Ok(part)
    }

    /// glTexSubImage. If the level is on the device already, its image is changed there too, after all
    /// operations so far.
    ///
    /// # Errors
    /// GL_INVALID_VALUE and GL_INVALID_OPERATION for a part that the texture lacks; GL_INVALID_ENUM and
    /// GL_INVALID_OPERATION for formats as in glTexImage; GL_OUT_OF_MEMORY.
    pub fn tex_sub_image(
        &mut self,
        face: usize,
        sub: &SubImage,
        input: &PixelInput,
        out: &mut Vec<Operation>,
    ) -> GlResult<()> {
        let part = self.part(face, sub)?;
        let base = self.level(face, part.level).ok_or(GL_INVALID_OPERATION)?.format.base;
        let layout = input.layout(base)?;
        let whole = extent_of(self.target, sub.size.map(i32::unsigned_abs));
        let Some(source) = input.source(layout, whole)?.filter(|_| !part.is_empty()) else {
            return Ok(());
        };
        let source = source.crop(part.skip.map(|n| n as usize), extent_of(self.target, part.extent))?;
        let texels = unpack_texels(&source, input.transfer, base)?;
        self.write_part(face, part, texels, out)
    }

    /// Replaces the texels of a part, in memory and on the device, wherever they are.
    pub(super) fn write_part(
        &mut self,
        face: usize,
        part: Part,
        texels: Arc<[u8]>,
        out: &mut Vec<Operation>,
    ) -> GlResult<()> {
        self.before_change(part.level);
        let level = self.faces[face][part.level].as_mut().ok_or(GL_INVALID_OPERATION)?;
        let replaced = level.is_covered_by(part.offset, part.extent);
        if replaced && matches!(level.texels, Texels::Device) {
            level.texels = Texels::Undefined;
        }
        level.write(part.offset, part.extent, &texels)?;
        if let Some(image) = level.held_by.and_then(|key| self.images.get(key)) {
            let region = image.region(part.level, face, part.offset, part.extent);
            out.push(Operation::Upload(ImageUpload { image: image.key, region, texels }));
        }
        self.after_change(face, part.level);
        Ok(())
    }
}
