//! Whether blending a draw can show what is behind it: fragments' alpha followed through the fixed function.

use afterglow_gl::frame::{
    BaseFormat, Blend, BlendEquation, BlendFactor, CombineFunction, CombineSource, Compare, Draw, EnvMode,
    Frame, TEXTURE_UNITS, UnitWords,
};

use crate::geometry::{ContentCache, is_one};
use crate::images::{ImageFacts, Images};

/// What a draw's blending amounts to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mixing {
    /// The fragment replaces what is there.
    Opaque,
    /// Alpha cuts a shape out with blended edges.
    CutOut,
    /// What is there is multiplied by the fragment (lightmaps, stains).
    Multiply,
    /// The fragment is added (glow, reflections).
    Add,
    /// Anything else.
    Blend,
}

/// What blending makes of a draw, the alpha of its vertices and texels considered.
/// `content` is the hash of what it holds, where that is known.
pub fn mixing(
    frame: &Frame,
    draw: &Draw,
    content: Option<u64>,
    images: &Images,
    cache: &mut ContentCache,
) -> Mixing {
    use BlendFactor as F;
    let raster = &frame.fixed[draw.fixed as usize].raster;
    let Some(Blend { rgb, equation_rgb, .. }) = raster.blend else { return Mixing::Opaque };
    if raster.logic_op.is_some() || equation_rgb != BlendEquation::Add {
        return Mixing::Blend;
    }
    match rgb {
        (F::One, F::Zero) => Mixing::Opaque,
        (F::SourceAlpha | F::One, F::OneMinusSourceAlpha) => {
            Fragment { frame, draw, content, images, cache }.by_alpha()
        }
        (F::DestinationColor, F::Zero | F::SourceColor)
        | (F::Zero, F::SourceColor | F::OneMinusSourceColor)
        | (F::DestinationColor, F::OneMinusSourceAlpha) => Mixing::Multiply,
        (_, F::One) => Mixing::Add,
        _ => Mixing::Blend,
    }
}

struct Fragment<'a> {
    frame: &'a Frame,
    draw: &'a Draw,
    content: Option<u64>,
    images: &'a Images,
    cache: &'a mut ContentCache,
}

impl Fragment<'_> {
    /// What blending by alpha amounts to.
    fn by_alpha(&mut self) -> Mixing {
        let primary = self.primary_alpha_is_one();
        if self.alpha_is_one(primary, ImageFacts::is_opaque) {
            Mixing::Opaque
        } else if self.alpha_is_one(primary, |i| i.is_opaque() || i.is_cut_out())
            || (primary && self.fails_half_alpha())
        {
            Mixing::CutOut
        } else {
            Mixing::Blend
        }
    }

    /// Whether the alpha test lets only fragments pass that are nearer to opaque than to clear.
    fn fails_half_alpha(&self) -> bool {
        let function = self.frame.fixed[self.draw.fixed as usize].words.global.alpha_func();
        let passes_above = [Compare::Greater, Compare::GreaterEqual].iter().any(|&c| c as u32 == function);
        let environment = self.frame.environments.get(self.draw.environment as usize);
        passes_above && environment.is_some_and(|e| e.alpha_reference >= 0.5)
    }

    /// Whether the draw hides what comes after it: then it is not meant to be seen through.
    fn fills_depth(&self) -> bool {
        let depth = self.frame.fixed[self.draw.fixed as usize].raster.depth;
        depth.is_some_and(|depth| depth.write)
    }

    /// Alpha before texturing: the colour's, or the diffuse material's when lit.
    fn primary_alpha_is_one(&mut self) -> bool {
        let global = self.frame.fixed[self.draw.fixed as usize].words.global;
        if global.lighting() == 0 {
            return self.has_opaque_colors();
        }
        let tracks_diffuse = global.color_material() != 0 && matches!(global.color_material_mode(), 0 | 2);
        let material = self.frame.materials.get(self.draw.material as usize);
        let sides = 1 + global.two_side() as usize;
        (0..sides).all(|side| {
            if tracks_diffuse && global.color_material_faces() >> side & 1 != 0 {
                self.has_opaque_colors()
            } else {
                material.is_none_or(|m| is_one(m.faces[side].diffuse[3]))
            }
        })
    }

    fn has_opaque_colors(&mut self) -> bool {
        self.cache.has_opaque_colors(self.frame, self.draw, self.content)
    }

    /// Whether the last unit's alpha is one, if a texture's is where `texel_is_one` says so.
    fn alpha_is_one(&mut self, primary: bool, texel_is_one: fn(&ImageFacts) -> bool) -> bool {
        let frame = self.frame;
        let units = &frame.fixed[self.draw.fixed as usize].words.units;
        let mut previous = primary;
        for (index, unit) in units.iter().enumerate().filter(|(_, unit)| unit.target() != 0) {
            let texel = self.texel_alpha_is_one(index, unit, texel_is_one);
            previous = match unit.env_mode() {
                mode if mode == EnvMode::Combine as u32 => {
                    self.combined(index, unit, primary, previous, texel_is_one)
                }
                mode if mode == EnvMode::Decal as u32 => previous,
                mode if !has_alpha(unit) => {
                    debug_assert!(mode <= EnvMode::Add as u32);
                    previous
                }
                mode if mode == EnvMode::Replace as u32 => texel,
                _ => previous && texel,
            };
        }
        previous
    }

    fn texel_alpha_is_one(
        &mut self,
        index: usize,
        unit: &UnitWords,
        texel_is_one: fn(&ImageFacts) -> bool,
    ) -> bool {
        if !has_alpha(unit) {
            return true;
        }
        let bindings = self.frame.bindings.get(self.draw.bindings as usize);
        let image = bindings.and_then(|b| b[index]).and_then(|b| self.images.get(b.image));
        image.is_some_and(|image| {
            texel_is_one(image) || (self.fills_depth() && self.shows_opaque(image, index, unit))
        })
    }

    /// Whether what is shown of an image is opaque, but for little.
    fn shows_opaque(&mut self, image: &ImageFacts, index: usize, unit: &UnitWords) -> bool {
        let has_plain_coordinates = unit.gen_s() == 0 && unit.gen_t() == 0 && unit.matrix() == 0;
        let Some(alpha) = image.alpha().filter(|_| has_plain_coordinates) else { return false };
        let (frame, draw) = (self.frame, self.draw);
        self.cache.has_opaque_texels(self.content, image.content(), index, || {
            alpha.is_opaque_in(frame, draw, index)
        })
    }

    fn combined(
        &mut self,
        index: usize,
        unit: &UnitWords,
        primary: bool,
        previous: bool,
        texel_is_one: fn(&ImageFacts) -> bool,
    ) -> bool {
        let frame = self.frame;
        let units = &frame.fixed[self.draw.fixed as usize].words.units;
        let mut source = |which: u32, inverted: u32| {
            let value = match which {
                w if w == CombineSource::Previous as u32 => previous,
                w if w == CombineSource::Primary as u32 => primary,
                w if w == CombineSource::One as u32 => true,
                w if w == CombineSource::Texture as u32 => self.texel_alpha_is_one(index, unit, texel_is_one),
                w if w == CombineSource::Constant as u32 => {
                    let environment = self.frame.environments.get(self.draw.environment as usize);
                    environment.is_some_and(|e| e.env_color[index][3] >= 1.0)
                }
                w if w >= CombineSource::Texture0 as u32 => {
                    let other = (w - CombineSource::Texture0 as u32) as usize % TEXTURE_UNITS;
                    self.texel_alpha_is_one(other, &units[other], texel_is_one)
                }
                _ => false,
            };
            value && inverted == 0
        };
        let first = source(unit.source_alpha0(), unit.operand_alpha0());
        let second = source(unit.source_alpha1(), unit.operand_alpha1());
        match unit.combine_alpha() {
            f if f == CombineFunction::Replace as u32 => first,
            f if f == CombineFunction::Modulate as u32 => first && second,
            f if f == CombineFunction::Add as u32 => first || second,
            f if f == CombineFunction::Interpolate as u32 => first && second,
            _ => false,
        }
    }
}

fn has_alpha(unit: &UnitWords) -> bool {
    let format = unit.base_format();
    [BaseFormat::Alpha, BaseFormat::LuminanceAlpha, BaseFormat::Intensity, BaseFormat::Rgba]
        .iter()
        .any(|&f| f as u32 == format)
}
