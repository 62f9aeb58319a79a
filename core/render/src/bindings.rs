//! A frame's texture bindings as push constants name them.

use afterglow_gl::frame::{BaseFormat, Frame, Sampler, TEXTURE_UNITS, TextureBinding};
use afterglow_gpu::{BindlessTable, GpuError};
use afterglow_images::Role;
use afterglow_records::DrawPush;

use crate::replacements::Replacements;
use crate::samplers::{Samplers, shader_clamps};
use crate::textures::Textures;

/// Bits of a unit's word that name the image; the rest name the sampler.
const IMAGE_BITS: u32 = 20;

/// Bindings that were looked up.
#[derive(Debug, Clone, Copy)]
struct Resolved {
    /// As [`DrawPush::textures`], for samplers without a bias of the level.
    textures: [u32; TEXTURE_UNITS],
    base_formats: [BaseFormat; TEXTURE_UNITS],
    /// Coordinates that the shader clamps, three bits a unit.
    clamps: u32,
}

/// Bindings of one frame, looked up when they are first drawn with.
#[derive(Default)]
pub(crate) struct ResolvedBindings {
    entries: Vec<Option<Resolved>>,
}

/// Where bindings are looked up.
pub(crate) struct Lookup<'a> {
    pub(crate) frame: &'a Frame,
    pub(crate) textures: &'a Textures,
    /// What takes the place of textures.
    pub(crate) replacements: Option<&'a Replacements>,
    pub(crate) samplers: &'a mut Samplers,
    pub(crate) table: &'a BindlessTable,
}

impl ResolvedBindings {
    /// Forgets the last frame's.
    pub(crate) fn reset(&mut self, frame: &Frame) {
        self.entries.clear();
        self.entries.resize(frame.bindings.len(), None);
    }

    /// Coordinates that the shader clamps, three bits a unit.
    pub(crate) fn clamps(&mut self, lookup: &mut Lookup<'_>, index: u32) -> Result<u32, GpuError> {
        Ok(self.resolved(lookup, index)?.clamps)
    }

    /// The push constants of draws with these bindings and this environment.
    pub(crate) fn push(
        &mut self,
        lookup: &mut Lookup<'_>,
        frame_address: u64,
        bindings: u32,
        environment: u32,
    ) -> Result<DrawPush, GpuError> {
        let resolved = self.resolved(lookup, bindings)?;
        let zeroed = bytemuck::Zeroable::zeroed();
        let last = (lookup.frame.environments.len() as u32).saturating_sub(1);
        let environment = environment.min(last);
        let block = lookup.frame.environments.get(environment as usize);
        let block = block.unwrap_or(&zeroed);
        let mut textures = resolved.textures;
        if block.lod_bias != [0.0; TEXTURE_UNITS] {
            for (unit, bias) in block.lod_bias.into_iter().enumerate() {
                textures[unit] = biased(lookup, &resolved, bindings, unit, bias)?;
            }
        }
        let range = block.fog_end - block.fog_start;
        Ok(DrawPush {
            frame: frame_address,
            environment,
            pixels: 0,
            textures,
            fog_color: block.fog_color,
            fog_density: block.fog_density,
            fog_end: block.fog_end,
            fog_scale: if range == 0.0 { 1.0 } else { 1.0 / range },
            alpha_reference: block.alpha_reference,
        })
    }

    fn resolved(&mut self, lookup: &mut Lookup<'_>, index: u32) -> Result<Resolved, GpuError> {
        if let Some(Some(resolved)) = self.entries.get(index as usize) {
            return Ok(*resolved);
        }
        let resolved = resolve(lookup, index)?;
        if let Some(entry) = self.entries.get_mut(index as usize) {
            *entry = Some(resolved);
        }
        Ok(resolved)
    }
}

impl Lookup<'_> {
    /// The image and the sampler that a binding comes to, and the base format of the program's texture.
    fn find(&self, binding: &TextureBinding, role: Role) -> (u32, Sampler, BaseFormat) {
        let texture = self.textures.get(binding.image);
        let base_format = texture.map_or(BaseFormat::Rgba, |texture| texture.shape.base_format);
        match self.replacement(binding, role) {
            Some(index) => (index, mipmapped(&binding.sampler), base_format),
            None => (texture.map_or(0, |texture| texture.index), binding.sampler, base_format),
        }
    }

    /// The image that replaces a texture in this role.
    fn replacement(&self, binding: &TextureBinding, role: Role) -> Option<u32> {
        let found = self.replacements?.get(binding.image, role)?;
        Some(self.textures.get(found.key)?.index)
    }
}

/// As a texture is sampled, but with all mipmaps: pictures have more texels than what they replace.
fn mipmapped(sampler: &Sampler) -> Sampler {
    Sampler { mip_linear: Some(true), min_lod: (-1000.0).into(), max_lod: 1000.0.into(), ..*sampler }
}

/// The word of an image that no unit samples.
pub(crate) fn image_word(lookup: &mut Lookup<'_>, binding: &TextureBinding) -> Result<u32, GpuError> {
    let (index, sampler, base_format) = lookup.find(binding, Role::Color);
    let sampler = lookup.samplers.index(lookup.table, &sampler, base_format, 0.0)?;
    Ok(packed(index, sampler))
}

/// The word of the image that replaces a texture in a role; none if nothing does.
pub(crate) fn replacement_word(
    lookup: &mut Lookup<'_>,
    binding: &TextureBinding,
    role: Role,
) -> Result<Option<u32>, GpuError> {
    let Some(index) = lookup.replacement(binding, role) else { return Ok(None) };
    let sampler = mipmapped(&binding.sampler);
    let sampler = lookup.samplers.index(lookup.table, &sampler, BaseFormat::Rgba, 0.0)?;
    Ok(Some(packed(index, sampler)))
}

fn resolve(lookup: &mut Lookup<'_>, index: u32) -> Result<Resolved, GpuError> {
    let mut resolved =
        Resolved { textures: [0; TEXTURE_UNITS], base_formats: [BaseFormat::Rgba; TEXTURE_UNITS], clamps: 0 };
    let bindings = lookup.frame.bindings.get(index as usize);
    for (unit, binding) in bindings.into_iter().flatten().enumerate() {
        let Some(binding) = binding else { continue };
        let (index, sampler, base_format) = lookup.find(binding, Role::Color);
        resolved.clamps |= shader_clamps(&sampler) << (3 * unit);
        let sampler = lookup.samplers.index(lookup.table, &sampler, base_format, 0.0)?;
        resolved.textures[unit] = packed(index, sampler);
        resolved.base_formats[unit] = base_format;
    }
    Ok(resolved)
}

/// A unit's word with a sampler that adds `bias` to the level.
fn biased(
    lookup: &mut Lookup<'_>,
    resolved: &Resolved,
    bindings: u32,
    unit: usize,
    bias: f32,
) -> Result<u32, GpuError> {
    let word = resolved.textures[unit];
    let bindings = lookup.frame.bindings.get(bindings as usize);
    let Some(binding) = bindings.and_then(|bindings| bindings[unit]) else {
        return Ok(word);
    };
    let format = resolved.base_formats[unit];
    let (_, sampler, _) = lookup.find(&binding, Role::Color);
    let sampler = lookup.samplers.index(lookup.table, &sampler, format, bias)?;
    Ok(packed(word & ((1 << IMAGE_BITS) - 1), sampler))
}

fn packed(image: u32, sampler: u32) -> u32 {
    image | sampler << IMAGE_BITS
}
