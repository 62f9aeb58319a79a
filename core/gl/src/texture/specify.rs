//! glTexImage: images from the program's memory (specification, 3.8.1).

use afterglow_api::constants::*;

use crate::frame::BaseFormat;
use crate::pixel::{
    Extent, GlResult, Packing, PixelFormat, PixelLayout, PixelSource, PixelTransfer, unpack_texels,
};

use super::internal_format::InternalFormat;
use super::level::{Level, Texels};
use super::object::TextureObject;
use super::target::TextureTarget;

/// What an image shall be, as the program says it. Dimensions that the target lacks are 1.
#[derive(Debug, Clone, Copy)]
pub struct ImageDefinition {
    /// Level.
    pub level: i32,
    /// Internal format.
    pub internal_format: u32,
    /// Size with the border.
    pub size: [i32; 3],
    /// Width of the border.
    pub border: i32,
}

/// Pixels in the program's memory, as the program describes them.
#[derive(Debug, Clone, Copy)]
pub struct PixelInput<'a> {
    /// Format.
    pub format: u32,
    /// Type.
    pub kind: u32,
    /// The memory; `None` for a null pointer.
    pub data: Option<&'a [u8]>,
    /// How it is packed.
    pub packing: &'a Packing,
    /// What happens to pixels on the way.
    pub transfer: &'a PixelTransfer,
}

impl<'a> PixelInput<'a> {
    /// Format and type, which must be such as textures of that base format take.
    pub(super) fn layout(&self, base: BaseFormat) -> GlResult<PixelLayout> {
        let layout = PixelLayout::from_gl(self.format, self.kind)?;
        match layout.format {
            PixelFormat::StencilIndex => Err(GL_INVALID_ENUM),
            format if (format == PixelFormat::Depth) != (base == BaseFormat::Depth) => {
                Err(GL_INVALID_OPERATION)
            }
            _ => Ok(layout),
        }
    }

    /// The image of that extent, if there is memory.
    pub(super) fn source(&self, layout: PixelLayout, extent: Extent) -> GlResult<Option<PixelSource<'a>>> {
        self.data.map(|data| PixelSource::new(data, layout, self.packing, extent)).transpose()
    }
}

/// An extent of the target's kind.
pub(super) fn extent_of(target: TextureTarget, size: [u32; 3]) -> Extent {
    let [width, height, depth] = size.map(|n| n as usize);
    match target {
        TextureTarget::D3 => Extent::volume(width, height, depth),
        _ => Extent::plane(width, height),
    }
}

impl ImageDefinition {
    /// Checks everything but the size. Gives level and border.
    ///
    /// # Errors
    /// GL_INVALID_VALUE for a bad level or border, GL_INVALID_OPERATION for depths in a target that takes none.
    pub(super) fn check(&self, target: TextureTarget, format: InternalFormat) -> GlResult<(usize, u32)> {
        let level = level_number(target, self.level)?;
        let border = u32::try_from(self.border).ok().filter(|border| *border <= 1);
        let border = border.ok_or(GL_INVALID_VALUE)?;
        if !TextureObject::target_takes(target, format.base) {
            return Err(GL_INVALID_OPERATION);
        }
        Ok((level, border))
    }

    /// Size without the border.
    ///
    /// # Errors
    /// GL_INVALID_VALUE if it is none that the target has at that level.
    pub(super) fn interior(&self, target: TextureTarget, level: usize, border: u32) -> GlResult<[u32; 3]> {
        let mut size = [1; 3];
        for (i, side) in size.iter_mut().enumerate().take(target.dimensions()) {
            let whole = u32::try_from(self.size[i]).map_err(|_| GL_INVALID_VALUE)?;
            *side = whole.checked_sub(2 * border).ok_or(GL_INVALID_VALUE)?;
        }
        let too_large = size.iter().any(|side| *side as usize > target.max_size(level));
        let no_cube = target == TextureTarget::Cube && size[0] != size[1];
        if too_large || no_cube { Err(GL_INVALID_VALUE) } else { Ok(size) }
    }
}

/// A level's number.
///
/// # Errors
/// GL_INVALID_VALUE if the target has no such level.
pub(super) fn level_number(target: TextureTarget, level: i32) -> GlResult<usize> {
    usize::try_from(level).ok().filter(|level| *level < target.levels()).ok_or(GL_INVALID_VALUE)
}

/// Whether an image could be specified: what a proxy answers.
pub fn proxy_fits(target: TextureTarget, definition: &ImageDefinition) -> bool {
    InternalFormat::from_gl(definition.internal_format)
        .ok_or(GL_INVALID_VALUE)
        .and_then(|format| definition.check(target, format))
        .and_then(|(level, border)| definition.interior(target, level, border))
        .is_ok()
}

impl TextureObject {
    /// glTexImage.
    ///
    /// # Errors
    /// GL_INVALID_VALUE for a bad level, border, size or internal format; GL_INVALID_ENUM for a bad format or
    /// type; GL_INVALID_OPERATION where these do not go together or the memory is too short;
    /// GL_OUT_OF_MEMORY.
    pub fn tex_image(
        &mut self,
        face: usize,
        definition: &ImageDefinition,
        input: &PixelInput,
    ) -> GlResult<()> {
        let format = InternalFormat::from_gl(definition.internal_format).ok_or(GL_INVALID_VALUE)?;
        let layout = input.layout(format.base)?;
        let (number, border) = definition.check(self.target, format)?;
        let size = definition.interior(self.target, number, border)?;
        let mut level = Level::new(size, border, format);
        if let Some(source) = input.source(layout, level.full_extent(self.target))? {
            let first = std::array::from_fn(|i| level.border_in(self.target, i) as usize);
            let source = source.crop(first, extent_of(self.target, size))?;
            level.texels = Texels::Memory(unpack_texels(&source, input.transfer, format.base)?);
        }
        self.set_level(face, number, Some(level));
        Ok(())
    }

    /// glTexImage of a proxy, which is a texture object too: its level is what was asked for, or nothing if the
    /// size is too much.
    ///
    /// # Errors
    /// As [`tex_image`](Self::tex_image), but for sizes.
    pub fn proxy_image(&mut self, definition: &ImageDefinition, format: u32, kind: u32) -> GlResult<()> {
        let internal = InternalFormat::from_gl(definition.internal_format).ok_or(GL_INVALID_VALUE)?;
        let (packing, transfer) = (Packing::default(), PixelTransfer::default());
        let input = PixelInput { format, kind, data: None, packing: &packing, transfer: &transfer };
        input.layout(internal.base)?;
        let (number, border) = definition.check(self.target, internal)?;
        let size = definition.interior(self.target, number, border).ok();
        self.set_level(0, number, size.map(|size| Level::new(size, border, internal)));
        Ok(())
    }
}
