//! Texture units: what is bound, environment, coordinate generation (specification 2.11.4, 3.8).

use std::sync::Arc;

use afterglow_api::constants::*;
use glam::{Mat4, Vec4};
use parking_lot::Mutex;

use crate::context::Context;
use crate::frame::{CombineFunction, CombineSource, EnvMode, TEXTURE_UNITS, UnitWords};
use crate::limits;
use crate::params::Values;
use crate::shared::{SharedNames, SharedTexture};
use crate::state::{TARGETS, TextureUnit};
use crate::tables::Dirty;
use crate::texture::TextureObject;

/// What is bound to the units.
pub struct Textures {
    /// By unit and [`TARGETS`]: name and texture.
    pub bound: [[(u32, SharedTexture); 4]; TEXTURE_UNITS],
    /// The textures of name 0.
    pub defaults: [SharedTexture; 4],
    /// The proxies of [`TARGETS`].
    pub proxies: [SharedTexture; 4],
}

impl Textures {
    /// All units have the default textures.
    pub fn new(_: &SharedNames) -> Textures {
        let defaults = TARGETS.map(|target| Arc::new(Mutex::new(TextureObject::new(target))));
        let bound = std::array::from_fn(|_| std::array::from_fn(|t| (0, defaults[t].clone())));
        let proxies = TARGETS.map(|target| Arc::new(Mutex::new(TextureObject::new(target))));
        Textures { bound, defaults, proxies }
    }

    /// The texture of the enabled target that takes precedence.
    pub fn enabled(&self, state: &TextureUnit, unit: usize) -> Option<&SharedTexture> {
        let target = (0..TARGETS.len()).rev().find(|t| state.targets & (1 << t) != 0)?;
        Some(&self.bound[unit][target].1)
    }

    /// Index of a texture target.
    pub fn target_index(target: u32) -> Option<usize> {
        TARGETS.iter().position(|&t| t == target)
    }
}

impl Context {
    /// Leaves the images of textures that are on a device which is lost. They are defined anew when they are drawn;
    /// texels that were only there are zero.
    pub(crate) fn leave_images(&mut self) {
        let (named, own) = {
            let mut names = self.shared.lock();
            let bound = self.textures.bound.iter().flatten();
            let is_own = |(name, _): &&(u32, SharedTexture)| !names.textures.contains_key(name);
            let own: Vec<_> = bound.filter(is_own).map(|(_, texture)| texture.clone()).collect();
            (names.move_to(self.device), own)
        };
        for texture in named.iter().chain(&own).chain(&self.textures.defaults) {
            texture.lock().drop_image(&mut self.frame.operations);
        }
    }

    pub(crate) fn exec_active_texture(&mut self, unit: u32) {
        match unit.wrapping_sub(GL_TEXTURE0) as usize {
            unit if unit < TEXTURE_UNITS => self.state.texture.active = unit,
            _ => self.record_error(GL_INVALID_ENUM),
        }
    }

    pub(crate) fn exec_bind_texture(&mut self, target: u32, name: u32) {
        let Some(index) = Textures::target_index(target) else {
            return self.record_error(GL_INVALID_ENUM);
        };
        let unit = self.state.texture.active;
        if self.textures.bound[unit][index].0 == 0 && name == 0 {
            return;
        }
        let texture = if name == 0 {
            self.textures.defaults[index].clone()
        } else {
            let mut names = self.shared.lock();
            let entry = names.textures.entry(name).or_default();
            entry.get_or_insert_with(|| Arc::new(Mutex::new(TextureObject::new(target)))).clone()
        };
        // The name may be another texture's by now, if another context has deleted it.
        if Arc::ptr_eq(&self.textures.bound[unit][index].1, &texture) {
            return;
        }
        if texture.lock().target() != target {
            return self.record_error(GL_INVALID_OPERATION);
        }
        self.textures.bound[unit][index] = (name, texture);
        if self.state.texture.units[unit].targets & (1 << index) != 0 {
            self.dirty(Dirty::BINDINGS);
        }
    }

    /// glGenTextures.
    pub fn gen_textures(&mut self, n: i32) -> Vec<u32> {
        if !(0..=limits::GENERATED_NAMES).contains(&n) {
            self.record_error(GL_INVALID_VALUE);
            return Vec::new();
        }
        self.shared.lock().generate_textures(n as usize)
    }

    /// glDeleteTextures. What is bound here is replaced by the default texture.
    pub fn delete_textures(&mut self, names: &[u32]) {
        for &name in names.iter().filter(|&&n| n != 0) {
            let Some(texture) = self.shared.lock().textures.remove(&name) else { continue };
            for unit in &mut self.textures.bound {
                for (slot, default) in unit.iter_mut().zip(&self.textures.defaults) {
                    if slot.0 == name {
                        *slot = (0, default.clone());
                    }
                }
            }
            // Another context may still have it bound: the image goes with the last handle.
            if let Some(texture) = texture.and_then(Arc::into_inner) {
                texture.into_inner().drop_image(&mut self.frame.operations);
            }
            self.dirty(Dirty::BINDINGS);
        }
    }

    /// glIsTexture.
    pub fn is_texture(&mut self, name: u32) -> bool {
        matches!(self.shared.lock().textures.get(&name), Some(Some(_)))
    }

    /// glAreTexturesResident: they all are.
    pub fn are_textures_resident(&mut self, names: &[u32]) -> (bool, Vec<bool>) {
        if !names.iter().all(|&name| self.is_texture(name)) {
            self.record_error(GL_INVALID_VALUE);
            return (false, Vec::new());
        }
        (true, vec![true; names.len()])
    }

    /// glPrioritizeTextures.
    pub fn prioritize_textures(&mut self, names: &[u32], priorities: &[f32]) {
        self.prioritize_textures_owned(names.into(), priorities.into());
    }

    pub(crate) fn exec_prioritize_textures(&mut self, names: Arc<[u32]>, priorities: Arc<[f32]>) {
        for (name, priority) in names.iter().zip(priorities.iter()) {
            let texture = self.shared.lock().textures.get(name).cloned().flatten();
            if let Some(texture) = texture {
                let result = texture.lock().set_parameter(
                    GL_TEXTURE_PRIORITY,
                    &Values::new(crate::context::Params::Floats(&[*priority])),
                );
                self.check(result);
            }
        }
    }

    pub(crate) fn exec_tex_parameter(&mut self, target: u32, pname: u32, values: Values) {
        let Some(index) = Textures::target_index(target) else {
            return self.record_error(GL_INVALID_ENUM);
        };
        let texture = self.textures.bound[self.state.texture.active][index].1.clone();
        let result = texture.lock().set_parameter(pname, &values);
        if self.check(result) {
            self.dirty(Dirty::BINDINGS);
        }
    }

    pub(crate) fn exec_tex_env(&mut self, target: u32, pname: u32, values: Values) {
        let unit = &mut self.state.texture.units[self.state.texture.active];
        let before = unit.words;
        let result = match (target, pname) {
            (GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR) => {
                unit.env_color = values.color().map(|v| v.clamp(0.0, 1.0));
                self.dirty(Dirty::ENVIRONMENT);
                Ok(())
            }
            (GL_TEXTURE_ENV, _) => set_environment(&mut unit.words, pname, &values),
            (GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS) => {
                unit.lod_bias = values.float();
                self.dirty(Dirty::ENVIRONMENT);
                Ok(())
            }
            (GL_POINT_SPRITE_ARB, GL_COORD_REPLACE_ARB) => {
                unit.words.set_coord_replace((values.float() != 0.0).into());
                Ok(())
            }
            _ => Err(GL_INVALID_ENUM),
        };
        self.check(result);
        if self.state.texture.units[self.state.texture.active].words != before {
            self.dirty(Dirty::WORDS);
        }
    }

    pub(crate) fn exec_tex_gen(&mut self, coord: u32, pname: u32, values: Values) {
        let c = coord.wrapping_sub(GL_S) as usize;
        if c > 3 {
            return self.record_error(GL_INVALID_ENUM);
        }
        let inverse: Mat4 = self.matrices.modelview.top().inverse();
        let unit = &mut self.state.texture.units[self.state.texture.active];
        match pname {
            GL_TEXTURE_GEN_MODE => match values.enumerant() {
                mode @ (GL_OBJECT_LINEAR | GL_EYE_LINEAR) => unit.gen_mode[c] = mode,
                mode @ GL_SPHERE_MAP if c < 2 => unit.gen_mode[c] = mode,
                mode @ (GL_REFLECTION_MAP | GL_NORMAL_MAP) if c < 3 => unit.gen_mode[c] = mode,
                _ => return self.record_error(GL_INVALID_ENUM),
            },
            GL_OBJECT_PLANE => unit.gen_planes.object[c] = values.floats(),
            GL_EYE_PLANE => {
                // Specification 2.11.4: the plane times the inverse of the modelview matrix of now.
                let plane = Vec4::from_array(values.floats());
                let eye = if inverse.is_finite() { inverse.transpose() * plane } else { plane };
                unit.gen_planes.eye[c] = eye.to_array();
            }
            _ => return self.record_error(GL_INVALID_ENUM),
        }
        self.dirty(Dirty::TEXGEN | Dirty::WORDS);
    }
}

fn set_environment(words: &mut UnitWords, pname: u32, values: &Values) -> Result<(), u32> {
    let value = values.enumerant();
    let source = || combine_source(value).ok_or(GL_INVALID_ENUM);
    let operand = || combine_operand(value).ok_or(GL_INVALID_ENUM);
    let alpha_operand = || match combine_operand(value) {
        Some(operand @ 2..=3) => Ok(operand - 2),
        _ => Err(GL_INVALID_ENUM),
    };
    match pname {
        GL_TEXTURE_ENV_MODE => words.set_env_mode(env_mode(value).ok_or(GL_INVALID_ENUM)? as u32),
        GL_COMBINE_RGB => words.set_combine_rgb(combine_function(value).ok_or(GL_INVALID_ENUM)? as u32),
        GL_COMBINE_ALPHA => match combine_function(value) {
            Some(CombineFunction::Dot3Rgb | CombineFunction::Dot3Rgba) | None => return Err(GL_INVALID_ENUM),
            Some(function) => words.set_combine_alpha(function as u32),
        },
        GL_RGB_SCALE => words.set_scale_rgb(scale(values.float())?),
        GL_ALPHA_SCALE => words.set_scale_alpha(scale(values.float())?),
        GL_SOURCE0_RGB => words.set_source_rgb0(source()?),
        GL_SOURCE1_RGB => words.set_source_rgb1(source()?),
        GL_SOURCE2_RGB => words.set_source_rgb2(source()?),
        GL_SOURCE0_ALPHA => words.set_source_alpha0(source()?),
        GL_SOURCE1_ALPHA => words.set_source_alpha1(source()?),
        GL_SOURCE2_ALPHA => words.set_source_alpha2(source()?),
        GL_OPERAND0_RGB => words.set_operand_rgb0(operand()?),
        GL_OPERAND1_RGB => words.set_operand_rgb1(operand()?),
        GL_OPERAND2_RGB => words.set_operand_rgb2(operand()?),
        GL_OPERAND0_ALPHA => words.set_operand_alpha0(alpha_operand()?),
        GL_OPERAND1_ALPHA => words.set_operand_alpha1(alpha_operand()?),
        GL_OPERAND2_ALPHA => words.set_operand_alpha2(alpha_operand()?),
        _ => return Err(GL_INVALID_ENUM),
    }
    Ok(())
}

fn scale(value: f32) -> Result<u32, u32> {
    match value {
        1.0 => Ok(0),
        2.0 => Ok(1),
        4.0 => Ok(2),
        _ => Err(GL_INVALID_VALUE),
    }
}

/// Environment modes and their words.
pub const ENV_MODES: [(u32, EnvMode); 6] = [
    (GL_MODULATE, EnvMode::Modulate),
    (GL_DECAL, EnvMode::Decal),
    (GL_BLEND, EnvMode::Blend),
    (GL_REPLACE, EnvMode::Replace),
    (GL_ADD, EnvMode::Add),
    (GL_COMBINE, EnvMode::Combine),
];

/// Combiner functions and their words.
pub const COMBINE_FUNCTIONS: [(u32, CombineFunction); 8] = [
    (GL_REPLACE, CombineFunction::Replace),
    (GL_MODULATE, CombineFunction::Modulate),
    (GL_ADD, CombineFunction::Add),
    (GL_ADD_SIGNED, CombineFunction::AddSigned),
    (GL_INTERPOLATE, CombineFunction::Interpolate),
    (GL_SUBTRACT, CombineFunction::Subtract),
    (GL_DOT3_RGB, CombineFunction::Dot3Rgb),
    (GL_DOT3_RGBA, CombineFunction::Dot3Rgba),
];

/// Combiner sources and their words.
pub const COMBINE_SOURCES: [(u32, CombineSource); 4] = [
    (GL_PREVIOUS, CombineSource::Previous),
    (GL_TEXTURE, CombineSource::Texture),
    (GL_CONSTANT, CombineSource::Constant),
    (GL_PRIMARY_COLOR, CombineSource::Primary),
];

/// Combiner operands in the order of their words.
pub const COMBINE_OPERANDS: [u32; 4] =
    [GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA];

fn env_mode(mode: u32) -> Option<EnvMode> {
    ENV_MODES.iter().find(|(gl, _)| *gl == mode).map(|(_, mode)| *mode)
}

fn combine_function(function: u32) -> Option<CombineFunction> {
    COMBINE_FUNCTIONS.iter().find(|(gl, _)| *gl == function).map(|(_, function)| *function)
}

fn combine_source(source: u32) -> Option<u32> {
    const END: u32 = GL_TEXTURE0 + TEXTURE_UNITS as u32;
    match source {
        // Crossbar: another unit's texel.
        GL_TEXTURE0..END => Some(CombineSource::Texture0 as u32 + source - GL_TEXTURE0),
        GL_ZERO => Some(CombineSource::Zero as u32),
        GL_ONE => Some(CombineSource::One as u32),
        _ => COMBINE_SOURCES.iter().find(|(gl, _)| *gl == source).map(|(_, source)| *source as u32),
    }
}

fn combine_operand(operand: u32) -> Option<u32> {
    COMBINE_OPERANDS.iter().position(|&gl| gl == operand).map(|i| i as u32)
}
