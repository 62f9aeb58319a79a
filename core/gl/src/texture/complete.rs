//! Completeness (specification, 3.8.10): which levels a texture can be sampled with.

use crate::frame::{BaseFormat, ImageShape};

use super::images::mip_size;
use super::level::Level;
use super::object::TextureObject;
use super::target::TextureTarget;

/// Levels that sampling uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LevelRange {
    /// The base level.
    pub base: usize,
    /// How many, the base among them; at least 1.
    pub count: usize,
}

impl TextureObject {
    /// The levels that sampling uses, or `None` if the texture is not complete.
    pub(super) fn complete(&self) -> Option<LevelRange> {
        let base = self.parameters.base_level;
        let first = self.level(0, base).filter(|level| !level.is_empty())?;
        let steps = if self.uses_mipmaps() { self.steps_above(first)? } else { 0 };
        let range = LevelRange { base, count: steps + 1 };
        let fits = |face: usize| (0..range.count).all(|step| self.level_fits(face, base, step, first));
        (0..self.target.faces()).all(fits).then_some(range)
    }

    /// Sampling is to use other levels than the base.
    pub(super) fn uses_mipmaps(&self) -> bool {
        self.parameters.mipmaps() && self.underivable == 0
    }

    /// Number of levels above the base that there must be; `None` if base and greatest level contradict.
    fn steps_above(&self, base: &Level) -> Option<usize> {
        let room = self.parameters.max_level.checked_sub(self.parameters.base_level)?;
        let largest = base.size.iter().copied().max()?;
        Some((largest.checked_ilog2()? as usize).min(room))
    }

    /// The level is what the base `first` requires of it. Formats agree if their base formats do.
    fn level_fits(&self, face: usize, base: usize, step: usize, first: &Level) -> bool {
        self.level(face, base + step).is_some_and(|level| {
            level.size == mip_size(first.size, step)
                && level.border == first.border
                && level.format.base == first.format.base
        })
    }

    /// Shape of an image for so many levels like `base`.
    pub(super) fn shape(&self, base: &Level, levels: usize) -> ImageShape {
        ImageShape {
            dimension: self.target.dimension(),
            width: base.size[0],
            height: base.size[1],
            depth: base.size[2],
            levels: levels as u32,
            format: base.format.texel_format(),
            base_format: base.format.base,
        }
    }

    /// What the texels of the base level mean.
    pub(super) fn base_format(&self) -> Option<BaseFormat> {
        Some(self.level(0, self.parameters.base_level)?.format.base)
    }

    /// Whether texels of that base format may be in a texture of that target.
    pub(super) fn target_takes(target: TextureTarget, base: BaseFormat) -> bool {
        base != BaseFormat::Depth || matches!(target, TextureTarget::D1 | TextureTarget::D2)
    }
}
