//! Queries of levels (specification, 6.1.3), and what else is asked of a texture.

use afterglow_api::constants::*;
use xxhash_rust::xxh3::Xxh3;

use crate::frame::BaseFormat;
use crate::pixel::GlResult;

use super::level::Texels;
use super::object::TextureObject;
use super::parameters::DEPTH_MODES;
use super::specify::level_number;

impl TextureObject {
    /// glGetTexLevelParameter.
    ///
    /// # Errors
    /// GL_INVALID_VALUE for a level that cannot be, GL_INVALID_ENUM for an unknown name, GL_INVALID_OPERATION
    /// for the compressed size of a level that is not compressed.
    pub fn level_parameter(&self, face: usize, level: i32, pname: u32) -> GlResult<i32> {
        let number = level_number(self.target, level)?;
        let Some(level) = self.level(face, number) else {
            return undefined_level_parameter(pname);
        };
        let extent = level.full_extent(self.target);
        let compressed = level.compressed.as_ref();
        Ok(match pname {
            GL_TEXTURE_WIDTH => extent.width as i32,
            GL_TEXTURE_HEIGHT => extent.height as i32,
            GL_TEXTURE_DEPTH => extent.depth as i32,
            GL_TEXTURE_BORDER => level.border as i32,
            GL_TEXTURE_INTERNAL_FORMAT => {
                compressed.map_or(level.format.number, |(format, _)| *format) as i32
            }
            GL_TEXTURE_COMPRESSED => compressed.is_some().into(),
            GL_TEXTURE_COMPRESSED_IMAGE_SIZE => compressed.ok_or(GL_INVALID_OPERATION)?.1.len() as i32,
            _ => level.format.component_bits(pname).ok_or(GL_INVALID_ENUM)?,
        })
    }

    /// GL_TEXTURE_LOD_BIAS.
    pub fn lod_bias(&self) -> f32 {
        self.parameters.lod_bias
    }

    /// If texels of the base level are depths: how they are compared and what they become, as
    /// [`UnitWords`](crate::frame::UnitWords) has it (`compare`, `depth_mode`).
    pub fn depth_words(&self) -> Option<(u32, u32)> {
        if self.base_format()? != BaseFormat::Depth {
            return None;
        }
        let parameters = &self.parameters;
        let compare = if parameters.compare { 1 + parameters.compare_func - GL_NEVER } else { 0 };
        let mode = DEPTH_MODES.iter().position(|mode| *mode == parameters.depth_mode);
        Some((compare, mode.unwrap_or(0) as u32))
    }

    /// Hash of format, size and texels of the base level, all faces: what tells textures apart over runs of a
    /// program. `None` if there is no base level or its texels are only on the device. Computed once.
    pub fn content_hash(&mut self) -> Option<u64> {
        if self.hash.is_none() {
            self.hash = self.hash_base();
        }
        self.hash
    }

    fn hash_base(&self) -> Option<u64> {
        let mut hasher = Xxh3::new();
        for face in 0..self.faces.len() {
            let level = self.level(face, self.parameters.base_level)?;
            hasher.update(&(level.format.base as u32).to_le_bytes());
            level.size.iter().for_each(|side| hasher.update(&side.to_le_bytes()));
            match &level.texels {
                Texels::Memory(texels) => hasher.update(texels),
                Texels::Undefined => {}
                Texels::Device => return None,
            }
        }
        Some(hasher.digest())
    }
}

/// Of a level that was never specified (specification, 3.8.11 and table 6.17).
fn undefined_level_parameter(pname: u32) -> GlResult<i32> {
    match pname {
        GL_TEXTURE_INTERNAL_FORMAT => Ok(1),
        GL_TEXTURE_COMPRESSED_IMAGE_SIZE => Err(GL_INVALID_OPERATION),
        GL_TEXTURE_WIDTH
        | GL_TEXTURE_HEIGHT
        | GL_TEXTURE_DEPTH
        | GL_TEXTURE_BORDER
        | GL_TEXTURE_COMPRESSED
        | GL_TEXTURE_RED_SIZE
        | GL_TEXTURE_GREEN_SIZE
        | GL_TEXTURE_BLUE_SIZE
        | GL_TEXTURE_ALPHA_SIZE
        | GL_TEXTURE_LUMINANCE_SIZE
        | GL_TEXTURE_INTENSITY_SIZE
        | GL_TEXTURE_DEPTH_SIZE => Ok(0),
        _ => Err(GL_INVALID_ENUM),
    }
}
