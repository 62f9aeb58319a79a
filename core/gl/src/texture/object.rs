//! The texture object: its state, and what changes it.

use crate::frame::Operation;
use crate::get::Value;
use crate::params::Values;
use crate::pixel::GlResult;

use super::images::{Images, mip_size};
use super::level::{Level, Texels};
use super::parameters::Parameters;
use super::realize::Realized;
use super::target::TextureTarget;

/// A texture object, or a default texture.
#[derive(Debug)]
pub struct TextureObject {
    pub(super) target: TextureTarget,
    pub(super) parameters: Parameters,
    /// Levels by face and number.
    pub(super) faces: Vec<Vec<Option<Level>>>,
    pub(super) images: Images,
    /// What a draw gets, unless `dirty`.
    pub(super) realized: Option<Realized>,
    pub(super) dirty: bool,
    /// Faces whose levels above the base are to be derived from it (bits).
    pub(super) stale: u8,
    /// Faces whose levels could not be derived, since the base is only on the device (bits).
    pub(super) underivable: u8,
    /// Hash of the content, once it was asked for.
    pub(super) hash: Option<u64>,
    version: u64,
}

impl TextureObject {
    /// A texture without images, for a target of glBindTexture. What is no target is taken for GL_TEXTURE_2D.
    pub fn new(target: u32) -> TextureObject {
        let target = TextureTarget::from_gl(target).unwrap_or(TextureTarget::D2);
        TextureObject {
            target,
            parameters: Parameters::default(),
            faces: (0..target.faces()).map(|_| Vec::new()).collect(),
            images: Images::default(),
            realized: None,
            dirty: true,
            stale: 0,
            underivable: 0,
            hash: None,
            version: 0,
        }
    }

    /// The target of glBindTexture that the texture is for.
    pub fn target(&self) -> u32 {
        self.target.gl()
    }

    /// Another number whenever a draw might get something else than before: compare to spare the rest.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// glTexParameter's state.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Replaces glTexParameter's state (glPopAttrib).
    pub fn set_parameters(&mut self, parameters: Parameters) {
        if self.parameters.levels_key() != parameters.levels_key() {
            self.settle_mipmaps();
            self.dirty = true;
            self.hash = None;
        }
        if self.parameters != parameters {
            self.version += 1;
            self.parameters = parameters;
        }
    }

    /// glTexParameter.
    ///
    /// # Errors
    /// As [`Parameters::set`].
    pub fn set_parameter(&mut self, pname: u32, values: &Values) -> GlResult<()> {
        let mut parameters = self.parameters.clone();
        parameters.set(pname, values)?;
        self.set_parameters(parameters);
        Ok(())
    }

    /// glGetTexParameter; `None` for an unknown name.
    pub fn get_parameter(&self, pname: u32) -> Option<Value> {
        self.parameters.get(pname)
    }

    /// Drops the images; to be called before the texture is forgotten. Levels that were only on the device
    /// are lost.
    pub fn drop_image(&mut self, out: &mut Vec<Operation>) {
        self.images.drop_all(out);
        for level in self.faces.iter_mut().flatten().flatten() {
            level.held_by = None;
            if matches!(level.texels, Texels::Device) {
                level.texels = Texels::Undefined;
            }
        }
        self.realized = None;
        self.dirty = true;
        self.version += 1;
    }

    pub(super) fn level(&self, face: usize, level: usize) -> Option<&Level> {
        self.faces.get(face)?.get(level)?.as_ref()
    }

    pub(super) fn level_mut(&mut self, face: usize, level: usize) -> Option<&mut Level> {
        self.faces.get_mut(face)?.get_mut(level)?.as_mut()
    }

    /// Replaces a level.
    pub(super) fn set_level(&mut self, face: usize, number: usize, level: Option<Level>) {
        self.before_change(number);
        if number != self.parameters.base_level {
            // The program gives the levels itself.
            self.underivable &= !(1 << face);
        }
        let Some(levels) = self.faces.get_mut(face) else { return };
        if levels.len() <= number {
            levels.resize_with(number + 1, || None);
        }
        levels[number] = level;
        self.after_change(face, number);
    }

    /// To be called before a level changes: what is still to be derived must not overwrite it later.
    pub(super) fn before_change(&mut self, number: usize) {
        if number != self.parameters.base_level {
            self.settle_mipmaps();
        }
    }

    /// To be called when a level has changed.
    pub(super) fn after_change(&mut self, face: usize, number: usize) {
        self.dirty = true;
        self.hash = None;
        self.version += 1;
        if number == self.parameters.base_level && self.parameters.generate_mipmap {
            self.derive_levels(face);
        }
    }

    /// Defines the levels above the base; their texels follow in [`settle_mipmaps`](Self::settle_mipmaps).
    fn derive_levels(&mut self, face: usize) {
        let base_level = self.parameters.base_level;
        let Some(base) = self.level(face, base_level).filter(|base| !base.is_empty()) else { return };
        let (size, border, format) = (base.size, base.border, base.format);
        let largest = size[0].max(size[1]).max(size[2]);
        let last = (base_level + largest.ilog2() as usize).min(self.parameters.max_level);
        let levels = &mut self.faces[face];
        if levels.len() <= last {
            levels.resize_with(last + 1, || None);
        }
        for (step, level) in levels[base_level..=last.max(base_level)].iter_mut().enumerate().skip(1) {
            *level = Some(Level::new(mip_size(size, step), border, format));
        }
        self.stale |= 1 << face;
    }
}
