//! Where a world's draws keep their baked light: what has to be left out of a colour so that only paint is left.

use std::sync::Arc;

use afterglow_gl::frame::{
    BlendFactor, CombineFunction, Draw, EnvMode, Format, Frame, ImageKey, Slot, UnitWords,
};
use glam::Vec3;
use hashbrown::HashSet;

/// Where a draw's baked light comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BakedInto {
    /// The texture of a unit that multiplies.
    Unit(u8),
    /// The colours of its vertices.
    Colors,
    /// All of a draw that multiplies the surface below by its colour; by twice that, if so.
    Layer {
        /// Twice its colour.
        is_doubled: bool,
    },
}

/// Which of a world's colours are baked light.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bakes {
    /// The textures that are lightmaps.
    pub(super) lightmaps: Arc<HashSet<ImageKey>>,
    /// There are none: colours of vertices are light.
    pub(super) in_colors: bool,
}

/// A world in which traced light takes the place of the baked.
#[derive(Debug, Clone, PartialEq)]
pub struct Relit {
    /// What is baked.
    pub bakes: Bakes,
    /// What the bake is multiplied by, so that it is light as the scene's lights have it: a ray that meets a surface finds
    /// albedo times this times the bake there.
    pub scale: f32,
    /// How much of that reaches other surfaces, as the bake has it: 0 where nothing was reflected when it was baked.
    pub bounce: Vec3,
}

impl Bakes {
    /// Where a static draw, or a layer over one where `is_layer`, keeps its light. None where it has none.
    pub fn of(&self, frame: &Frame, draw: &Draw, is_layer: bool) -> Option<BakedInto> {
        let fixed = frame.fixed.get(draw.fixed as usize)?;
        if fixed.words.is_lit() {
            return None;
        }
        let units = frame.bindings.get(draw.bindings as usize)?;
        let is_light = |unit: usize| {
            units[unit].is_some_and(|binding| self.lightmaps.contains(&binding.image))
                && fixed.words.units[unit].target() != 0
        };
        if is_layer {
            let scale = multiplier(frame, draw)?;
            return is_light(0).then_some(BakedInto::Layer { is_doubled: scale > 1.0 });
        }
        let mut enabled = (0..units.len()).filter(|&unit| fixed.words.units[unit].target() != 0).peekable();
        let first = enabled.peek().copied();
        let multiplies = |unit: &usize| {
            let words = &fixed.words.units[*unit];
            let scale = if Some(*unit) == first { first_factor(words) } else { factor(words) };
            is_light(*unit) && scale.is_some()
        };
        let by_unit = enabled.find(multiplies).map(|unit| BakedInto::Unit(unit as u8));
        let has_colors = || draw.layout.format(Slot::Color as usize) != Format::Absent;
        by_unit.or_else(|| (self.in_colors && has_colors()).then_some(BakedInto::Colors))
    }
}

/// What a draw multiplies the surface below by, beside its colour.
pub(super) fn multiplier(frame: &Frame, draw: &Draw) -> Option<f32> {
    use BlendFactor as F;
    match frame.fixed.get(draw.fixed as usize)?.raster.blend?.rgb {
        (F::DestinationColor, F::Zero) | (F::Zero, F::SourceColor) => Some(1.0),
        (F::DestinationColor, F::SourceColor) => Some(2.0),
        _ => None,
    }
}

/// What the first unit multiplies its texel by, if it multiplies at all.
pub(super) fn first_factor(words: &UnitWords) -> Option<f32> {
    factor(words).or((words.env_mode() == EnvMode::Replace as u32).then_some(1.0)).or_else(|| {
        let replaces = words.env_mode() == EnvMode::Combine as u32
            && words.combine_rgb() == CombineFunction::Replace as u32;
        replaces.then(|| f32::from(1u8 << words.scale_rgb()))
    })
}

/// What a unit multiplies its texel by, if it multiplies what comes before.
pub(super) fn factor(words: &UnitWords) -> Option<f32> {
    if words.env_mode() == EnvMode::Modulate as u32 {
        return Some(1.0);
    }
    let multiplies = words.env_mode() == EnvMode::Combine as u32
        && words.combine_rgb() == CombineFunction::Modulate as u32;
    multiplies.then(|| f32::from(1u8 << words.scale_rgb()))
}
