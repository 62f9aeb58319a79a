//! The fixed-function state that decides *what is computed*, packed in words.
//!
//! Rasterization specialises its shaders by these words, ray hits read them as data: a state
//! means the same to both.

use afterglow_layout::packed_words;

/// Texture units that a program may use.
pub const TEXTURE_UNITS: usize = 4;
/// Light sources that a program may use.
pub const LIGHTS: usize = 8;
/// Clip planes that a program may use.
pub const CLIP_PLANES: usize = 6;

packed_words! {
    /// State outside the texture units.
    pub struct GlobalWords: "state", 2 {
        word 0 {
            /// GL_LIGHTING.
            lighting: 1,
            /// Normals: 0 as they are, 1 rescaled (the factor is in the normal matrix), 2 normalised.
            normalize: 2,
            /// GL_COLOR_MATERIAL.
            color_material: 1,
            /// Which faces follow the colour: bit 0 front, bit 1 back.
            color_material_faces: 2,
            /// What follows: 0 ambient and diffuse, 1 ambient, 2 diffuse, 3 specular, 4 emission.
            color_material_mode: 3,
            /// GL_LIGHT_MODEL_TWO_SIDE.
            two_side: 1,
            /// GL_LIGHT_MODEL_LOCAL_VIEWER.
            local_viewer: 1,
            /// GL_SEPARATE_SPECULAR_COLOR.
            separate_specular: 1,
            /// GL_COLOR_SUM without lighting.
            color_sum: 1,
            /// GL_FLAT.
            flat_shade: 1,
            /// 0 none, 1 linear, 2 exp, 3 exp2.
            fog_mode: 2,
            /// 0 fragment depth, 1 fog coordinate.
            fog_coordinate: 1,
            /// Alpha test: GL_NEVER + value, 7 (always) when disabled.
            alpha_func: 3,
            /// GL_POINT_SPRITE.
            point_sprite: 1,
            /// GL_POINT_SMOOTH for points, GL_LINE_SMOOTH for lines.
            smooth: 1,
            /// GL_POLYGON_STIPPLE for polygons.
            polygon_stipple: 1,
            /// Which clip planes are enabled.
            clip_planes: 6,
        }
        word 1 {
            /// Which lights are enabled.
            lights: 8,
            /// Which lights have a place (w != 0).
            positional: 8,
            /// Which lights are spots (cutoff != 180).
            spots: 8,
            /// Point size is attenuated by distance.
            point_attenuation: 1,
        }
    }
}

packed_words! {
    /// State of one texture unit.
    pub struct UnitWords: "unit", 3 {
        word 0 {
            /// 0 off, 1 two-dimensional (one-dimensional textures too), 2 three-dimensional, 3 cube.
            target: 2,
            /// [`BaseFormat`] of the bound texture.
            base_format: 3,
            /// [`EnvMode`].
            env_mode: 3,
            /// Texture generation for s: 0 off, 1 object linear, 2 eye linear, 3 sphere, 4 reflection, 5 normal.
            gen_s: 3,
            /// As `gen_s`, for t.
            gen_t: 3,
            /// As `gen_s`, for r.
            gen_r: 3,
            /// As `gen_s`, for q.
            gen_q: 3,
            /// The texture matrix is not the identity.
            matrix: 1,
            /// GL_COORD_REPLACE of point sprites.
            coord_replace: 1,
            /// Depth compare: 0 off, else 1 + (function - GL_NEVER).
            compare: 4,
            /// GL_DEPTH_TEXTURE_MODE: 0 luminance, 1 intensity, 2 alpha.
            depth_mode: 2,
        }
        word 1 {
            /// [`CombineFunction`] of colour.
            combine_rgb: 3,
            /// [`CombineFunction`] of alpha.
            combine_alpha: 3,
            /// Colour scale as a power of two.
            scale_rgb: 2,
            /// Alpha scale as a power of two.
            scale_alpha: 2,
            /// Colour operand 0: 0 colour, 1 one minus colour, 2 alpha, 3 one minus alpha.
            operand_rgb0: 2,
            /// Colour operand 1.
            operand_rgb1: 2,
            /// Colour operand 2.
            operand_rgb2: 2,
            /// Alpha operand 0: 0 alpha, 1 one minus alpha.
            operand_alpha0: 1,
            /// Alpha operand 1.
            operand_alpha1: 1,
            /// Alpha operand 2.
            operand_alpha2: 1,
        }
        word 2 {
            /// [`CombineSource`] 0 of colour.
            source_rgb0: 4,
            /// Source 1 of colour.
            source_rgb1: 4,
            /// Source 2 of colour.
            source_rgb2: 4,
            /// Source 0 of alpha.
            source_alpha0: 4,
            /// Source 1 of alpha.
            source_alpha1: 4,
            /// Source 2 of alpha.
            source_alpha2: 4,
        }
    }
}

/// What a texture's texels mean to the environment (base internal format).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum BaseFormat {
    /// Alpha only.
    Alpha = 0,
    /// Luminance.
    Luminance = 1,
    /// Luminance and alpha.
    LuminanceAlpha = 2,
    /// Intensity.
    Intensity = 3,
    /// Red, green, blue.
    Rgb = 4,
    /// Red, green, blue, alpha.
    Rgba = 5,
    /// Depth.
    Depth = 6,
}

/// GL_TEXTURE_ENV_MODE.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum EnvMode {
    /// GL_MODULATE.
    Modulate = 0,
    /// GL_DECAL.
    Decal = 1,
    /// GL_BLEND.
    Blend = 2,
    /// GL_REPLACE.
    Replace = 3,
    /// GL_ADD.
    Add = 4,
    /// GL_COMBINE.
    Combine = 5,
}

/// GL_COMBINE_RGB and GL_COMBINE_ALPHA.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum CombineFunction {
    /// GL_REPLACE.
    Replace = 0,
    /// GL_MODULATE.
    Modulate = 1,
    /// GL_ADD.
    Add = 2,
    /// GL_ADD_SIGNED.
    AddSigned = 3,
    /// GL_INTERPOLATE.
    Interpolate = 4,
    /// GL_SUBTRACT.
    Subtract = 5,
    /// GL_DOT3_RGB.
    Dot3Rgb = 6,
    /// GL_DOT3_RGBA.
    Dot3Rgba = 7,
}

/// A source of a combiner. `Texture0 + i` is unit i's texel (crossbar).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum CombineSource {
    /// The previous unit's result.
    Previous = 0,
    /// This unit's texel.
    Texture = 1,
    /// GL_TEXTURE_ENV_COLOR.
    Constant = 2,
    /// The colour before texturing.
    Primary = 3,
    /// Zero.
    Zero = 4,
    /// One.
    One = 5,
    /// Unit 0's texel; the next three are the other units'.
    Texture0 = 8,
}

/// Everything a shader is specialised by.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StateWords {
    /// State outside the texture units.
    pub global: GlobalWords,
    /// The texture units.
    pub units: [UnitWords; TEXTURE_UNITS],
}

// SAFETY: arrays of u32 only, in C layout.
unsafe impl bytemuck::Zeroable for StateWords {}
// SAFETY: as above.
unsafe impl bytemuck::Pod for StateWords {}

/// Number of words in [`StateWords`].
pub const STATE_WORDS: usize = 2 + 3 * TEXTURE_UNITS;

/// All words at once.
impl std::hash::Hash for StateWords {
    fn hash<H: std::hash::Hasher>(&self, hasher: &mut H) {
        hasher.write(bytemuck::bytes_of(self));
    }
}

impl StateWords {
    /// Whether lighting shows: an environment such as GL_REPLACE may leave nothing of its result.
    pub fn is_lit(&self) -> bool {
        self.global.lighting() != 0 && self.shows_primary()
    }

    /// Whether a fragment's red, green and blue depend on its colour before texturing.
    fn shows_primary(&self) -> bool {
        let enabled = self.units.iter().filter(|unit| unit.target() != 0);
        enabled.fold(true, |shows, unit| unit.passes_primary(shows))
    }
}

impl UnitWords {
    /// Whether this unit's colour depends on the primary one; `previous` says so of the unit before.
    fn passes_primary(&self, previous: bool) -> bool {
        let (mode, base) = (self.env_mode(), self.base_format());
        if mode == EnvMode::Combine as u32 {
            return self.combined_sources().any(|source| {
                source == CombineSource::Primary as u32
                    || (source == CombineSource::Previous as u32 && previous)
            });
        }
        let replaces = mode == EnvMode::Replace as u32 && base != BaseFormat::Alpha as u32;
        let covers = mode == EnvMode::Decal as u32 && base == BaseFormat::Rgb as u32;
        previous && !replaces && !covers
    }

    /// Sources of the colour that its combine function reads.
    fn combined_sources(&self) -> impl Iterator<Item = u32> {
        let count = match self.combine_rgb() {
            f if f == CombineFunction::Replace as u32 => 1,
            f if f == CombineFunction::Interpolate as u32 => 3,
            _ => 2,
        };
        [self.source_rgb0(), self.source_rgb1(), self.source_rgb2()].into_iter().take(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lit, with these modes in the first units, all of which have RGB textures.
    fn lit(modes: &[EnvMode]) -> StateWords {
        let mut words = StateWords::default();
        words.global.set_lighting(1);
        for (unit, mode) in words.units.iter_mut().zip(modes) {
            unit.set_target(1);
            unit.set_base_format(BaseFormat::Rgb as u32);
            unit.set_env_mode(*mode as u32);
        }
        words
    }

    #[test]
    fn light_shows_unless_a_texture_takes_its_place() {
        assert!(!StateWords::default().is_lit());
        assert!(lit(&[]).is_lit());
        assert!(lit(&[EnvMode::Modulate, EnvMode::Add]).is_lit());
        assert!(!lit(&[EnvMode::Replace]).is_lit());
        assert!(!lit(&[EnvMode::Decal, EnvMode::Modulate]).is_lit());
        assert!(!lit(&[EnvMode::Modulate, EnvMode::Replace]).is_lit());
        let mut alpha = lit(&[EnvMode::Replace]);
        alpha.units[0].set_base_format(BaseFormat::Alpha as u32);
        assert!(alpha.is_lit());
    }

    #[test]
    fn combiners_show_light_that_they_read() {
        let mut words = lit(&[EnvMode::Replace, EnvMode::Combine]);
        let unit = &mut words.units[1];
        unit.set_combine_rgb(CombineFunction::Modulate as u32);
        unit.set_source_rgb0(CombineSource::Texture as u32);
        unit.set_source_rgb1(CombineSource::Previous as u32);
        unit.set_source_rgb2(CombineSource::Primary as u32);
        assert!(!words.is_lit());
        words.units[1].set_source_rgb1(CombineSource::Primary as u32);
        assert!(words.is_lit());
    }
}
