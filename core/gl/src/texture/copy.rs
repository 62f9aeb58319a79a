//! glCopyTexImage and glCopyTexSubImage: texels from the frame buffer (specification, 3.8.2). Pixel transfer is
//! not applied to them.

use afterglow_api::constants::*;

use crate::frame::{ImageCopy, Operation, Rect};
use crate::pixel::GlResult;

use super::internal_format::InternalFormat;
use super::level::{Level, Texels};
use super::object::TextureObject;
use super::specify::ImageDefinition;
use super::sub_image::{Part, SubImage};

/// Lower left corner of what is copied, in pixels of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CopySource {
    /// From the left.
    pub x: i32,
    /// From below.
    pub y: i32,
}

impl TextureObject {
    /// glCopyTexImage.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for an internal format that may not be given here, else as glTexImage.
    pub fn copy_image(
        &mut self,
        face: usize,
        definition: &ImageDefinition,
        source: CopySource,
        out: &mut Vec<Operation>,
    ) -> GlResult<()> {
        let named = definition.internal_format > 4;
        let format = InternalFormat::from_gl(definition.internal_format).filter(|_| named);
        let format = format.ok_or(GL_INVALID_ENUM)?;
        let (number, border) = definition.check(self.target, format)?;
        let size = definition.interior(self.target, number, border)?;
        let mut level = Level::new(size, border, format);
        // The same image again (a frame's reflection, say) keeps its place on the device.
        let same = |old: &&Level| old.size == size && old.format.base == format.base;
        level.held_by = self.level(face, number).filter(same).and_then(|old| old.held_by);
        let empty = level.is_empty();
        self.set_level(face, number, Some(level));
        if empty {
            return Ok(());
        }
        let skip = std::array::from_fn(|i| if i < self.target.dimensions() { border } else { 0 });
        let part = Part { level: number, skip, offset: [0; 3], extent: size };
        self.copy_part(face, part, source, out)
    }

    /// glCopyTexSubImage; the depth of `sub` is 1.
    ///
    /// # Errors
    /// As glTexSubImage for the part.
    pub fn copy_sub_image(
        &mut self,
        face: usize,
        sub: &SubImage,
        source: CopySource,
        out: &mut Vec<Operation>,
    ) -> GlResult<()> {
        let part = self.part(face, sub)?;
        if part.is_empty() {
            return Ok(());
        }
        self.before_change(part.level);
        self.copy_part(face, part, source, out)
    }

    fn copy_part(
        &mut self,
        face: usize,
        part: Part,
        source: CopySource,
        out: &mut Vec<Operation>,
    ) -> GlResult<()> {
        let level = self.level(face, part.level).ok_or(GL_INVALID_OPERATION)?;
        let overwritten = level.is_covered_by(part.offset, part.extent);
        let image = self.place_on_device(face, part.level, overwritten, out).ok_or(GL_OUT_OF_MEMORY)?;
        let level = self.level_mut(face, part.level).ok_or(GL_INVALID_OPERATION)?;
        level.texels = Texels::Device;
        level.compressed = None;
        let base_format = level.format.base;
        out.push(Operation::CopyToImage(ImageCopy {
            image: image.key,
            region: image.region(part.level, face, part.offset, part.extent),
            source: Rect {
                x: source.x.saturating_add_unsigned(part.skip[0]),
                y: source.y.saturating_add_unsigned(part.skip[1]),
                width: part.extent[0] as i32,
                height: part.extent[1] as i32,
            },
            base_format,
        }));
        self.after_change(face, part.level);
        self.collect_images(out);
        Ok(())
    }
}
