//! How a texture is sampled, from its parameters (specification, 3.8.7 to 3.8.9).

use afterglow_api::constants::*;

use crate::frame::{Compare, Sampler, Wrap};

use super::parameters::{MAX_ANISOTROPY, Parameters};
use super::target::TextureTarget;

/// Levels of detail beyond this are the same to every texture.
const LOD_LIMIT: f32 = 1000.0;

impl Parameters {
    /// The sampler of a texture with so many levels, counted from the base; `mipmaps` tells whether they may
    /// be used, `depth` whether texels are depths.
    ///
    /// Levels of detail are between 0 (which magnifies) and the last level's. Directions that the target
    /// lacks clamp to the edge.
    pub(super) fn sampler(
        &self,
        target: TextureTarget,
        levels: usize,
        mipmaps: bool,
        depth: bool,
    ) -> Sampler {
        let mip_linear = match self.min_filter {
            _ if !mipmaps => None,
            GL_NEAREST_MIPMAP_NEAREST | GL_LINEAR_MIPMAP_NEAREST => Some(false),
            GL_NEAREST_MIPMAP_LINEAR | GL_LINEAR_MIPMAP_LINEAR => Some(true),
            _ => None,
        };
        let last = if mip_linear.is_some() { levels.saturating_sub(1) as f32 } else { LOD_LIMIT };
        let min_lod = self.min_lod.max(0.0).min(last);
        let max_lod = self.max_lod.min(last).max(min_lod);
        let wrap = |i: usize| if i < target.dimensions() { wrap(self.wrap[i]) } else { Wrap::ClampToEdge };
        Sampler {
            mag_linear: self.mag_filter == GL_LINEAR,
            min_linear: matches!(
                self.min_filter,
                GL_LINEAR | GL_LINEAR_MIPMAP_NEAREST | GL_LINEAR_MIPMAP_LINEAR
            ),
            mip_linear,
            wrap: std::array::from_fn(wrap),
            min_lod: min_lod.into(),
            max_lod: max_lod.into(),
            border_color: self.border_color.map(Into::into),
            anisotropy: self.anisotropy.min(MAX_ANISOTROPY).into(),
            compare: (depth && self.compare).then(|| compare(self.compare_func)),
        }
    }
}

fn wrap(mode: u32) -> Wrap {
    match mode {
        GL_CLAMP => Wrap::Clamp,
        GL_CLAMP_TO_EDGE => Wrap::ClampToEdge,
        GL_CLAMP_TO_BORDER => Wrap::ClampToBorder,
        GL_MIRRORED_REPEAT => Wrap::MirroredRepeat,
        _ => Wrap::Repeat,
    }
}

fn compare(function: u32) -> Compare {
    match function {
        GL_NEVER => Compare::Never,
        GL_LESS => Compare::Less,
        GL_EQUAL => Compare::Equal,
        GL_GREATER => Compare::Greater,
        GL_NOTEQUAL => Compare::NotEqual,
        GL_GEQUAL => Compare::GreaterEqual,
        GL_ALWAYS => Compare::Always,
        _ => Compare::LessEqual,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_of_detail_is_clamped_to_the_levels() {
        let mut parameters = Parameters::default();
        let sampler = parameters.sampler(TextureTarget::D2, 5, true, false);
        assert_eq!((sampler.min_lod.get(), sampler.max_lod.get()), (0.0, 4.0));
        assert_eq!(sampler.mip_linear, Some(true));
        (parameters.min_lod, parameters.max_lod) = (2.0, 1.0);
        let sampler = parameters.sampler(TextureTarget::D2, 5, true, false);
        assert_eq!((sampler.min_lod.get(), sampler.max_lod.get()), (2.0, 2.0));
        let sampler = parameters.sampler(TextureTarget::D2, 1, false, false);
        assert_eq!(sampler.mip_linear, None);
    }

    #[test]
    fn directions_and_comparison() {
        let parameters = Parameters { compare: true, ..Parameters::default() };
        let sampler = parameters.sampler(TextureTarget::D1, 1, false, true);
        assert_eq!(sampler.wrap, [Wrap::Repeat, Wrap::ClampToEdge, Wrap::ClampToEdge]);
        assert_eq!(sampler.compare, Some(Compare::LessEqual));
        assert_eq!(parameters.sampler(TextureTarget::D1, 1, false, false).compare, None);
    }
}
