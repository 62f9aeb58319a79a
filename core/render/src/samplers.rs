//! OpenGL's texture parameters as Vulkan samplers, each made once.

use afterglow_gl::frame::{BaseFormat, FloatBits, Sampler, Wrap};
use afterglow_gpu::{self as base, BindlessTable, Gpu, GpuError, vk};
use hashbrown::HashMap;

use crate::textures::DEPTH_TEXEL_FORMAT;

/// What a sampler of Vulkan's depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Key {
    sampler: Sampler,
    /// Border colours mean different texels to different base formats.
    base_format: BaseFormat,
    lod_bias: FloatBits,
}

/// How a missing texture is sampled.
fn missing() -> Sampler {
    Sampler {
        mag_linear: false,
        min_linear: false,
        mip_linear: None,
        wrap: [Wrap::Repeat; 3],
        min_lod: 0.0.into(),
        max_lod: 0.0.into(),
        border_color: [0.0.into(); 4],
        anisotropy: 1.0.into(),
        compare: None,
    }
}

/// All samplers, by their bindless indices.
pub(crate) struct Samplers {
    gpu: Gpu,
    indices: HashMap<Key, u32>,
    /// Held so that the bindless table can name them.
    samplers: Vec<base::Sampler>,
    is_full: bool,
    filters_depth: bool,
}

impl Samplers {
    /// With one sampler at index 0, for textures that are missing.
    pub(crate) fn new(gpu: &Gpu, table: &BindlessTable) -> Result<Self, GpuError> {
        let linear = vk::FormatFeatureFlags::SAMPLED_IMAGE_FILTER_LINEAR;
        let mut samplers = Self {
            gpu: gpu.clone(),
            indices: HashMap::new(),
            samplers: Vec::new(),
            is_full: false,
            filters_depth: gpu.format_features(DEPTH_TEXEL_FORMAT).contains(linear),
        };
        samplers.index(table, &missing(), BaseFormat::Rgba, 0.0)?;
        Ok(samplers)
    }

    /// The bindless index of a sampler. If the device takes no more of them it is another one.
    pub(crate) fn index(
        &mut self,
        table: &BindlessTable,
        sampler: &Sampler,
        base_format: BaseFormat,
        lod_bias: f32,
    ) -> Result<u32, GpuError> {
        let key = Key { sampler: *sampler, base_format, lod_bias: lod_bias.into() };
        if let Some(index) = self.indices.get(&key) {
            return Ok(*index);
        }
        if self.is_full {
            return Ok(0);
        }
        match self.create(table, &key) {
            Err(GpuError::BindlessFull { capacity, .. }) if !self.samplers.is_empty() => {
                tracing::warn!(capacity, "no more samplers; textures are filtered as the first one is");
                self.is_full = true;
                Ok(0)
            }
            other => other,
        }
    }

    fn create(&mut self, table: &BindlessTable, key: &Key) -> Result<u32, GpuError> {
        let border = border_color(&key.sampler.border_color, key.base_format);
        let standard = standard_border(border);
        let features = self.gpu.features();
        let has_custom = features.custom_border_colors && features.custom_border_color_without_format;
        let mut custom = vk::SamplerCustomBorderColorCreateInfoEXT::default()
            .custom_border_color(vk::ClearColorValue { float32: border });
        let mut info = sampler_info(key, &self.gpu, self.filters_depth);
        let meets_border = [info.address_mode_u, info.address_mode_v, info.address_mode_w]
            .contains(&vk::SamplerAddressMode::CLAMP_TO_BORDER);
        match standard {
            Some(color) => info = info.border_color(color),
            None if meets_border && has_custom => {
                info = info.border_color(vk::BorderColor::FLOAT_CUSTOM_EXT).push_next(&mut custom);
            }
            None => info = info.border_color(nearest_border(border)),
        }
        let sampler = self.gpu.create_sampler(&info)?;
        let index = table.add_sampler(sampler.raw())?;
        self.samplers.push(sampler);
        self.indices.insert(*key, index);
        Ok(index)
    }
}

/// Which coordinates the shader must clamp to [0, 1] so that GL_CLAMP meets half of the border: bit 0 s, 1 t, 2 r.
pub(crate) fn shader_clamps(sampler: &Sampler) -> u32 {
    let bit = |(axis, wrap): (usize, &Wrap)| match wrap {
        Wrap::Clamp if blends_border(sampler) => 1 << axis,
        _ => 0,
    };
    sampler.wrap.iter().enumerate().map(bit).sum()
}

/// Nearest filtering with GL_CLAMP picks the texels at the edge, as GL_CLAMP_TO_EDGE does.
fn blends_border(sampler: &Sampler) -> bool {
    sampler.mag_linear || sampler.min_linear
}

fn sampler_info(key: &Key, gpu: &Gpu, filters_depth: bool) -> vk::SamplerCreateInfo<'static> {
    let sampler = &key.sampler;
    let may_filter = match key.base_format {
        BaseFormat::Depth => filters_depth && sampler.compare.is_none(),
        _ => true,
    };
    let filter = |linear: bool| match linear && may_filter {
        true => vk::Filter::LINEAR,
        false => vk::Filter::NEAREST,
    };
    let [s, t, r] = sampler.wrap.map(|wrap| address_mode(wrap, sampler));
    let most = gpu.limits().max_sampler_anisotropy;
    let anisotropy = sampler.anisotropy.get().clamp(1.0, most.max(1.0));
    // Without levels, Vulkan still needs a range of them to tell magnification from minification.
    let (mip_linear, least, greatest) = match sampler.mip_linear {
        Some(linear) => (linear, sampler.min_lod.get(), sampler.max_lod.get()),
        None => (false, 0.0, 0.25),
    };
    let bias = key.lod_bias.get();
    let most_bias = gpu.limits().max_sampler_lod_bias;
    vk::SamplerCreateInfo::default()
        .mag_filter(filter(sampler.mag_linear))
        .min_filter(filter(sampler.min_linear))
        .mipmap_mode(match mip_linear {
            true => vk::SamplerMipmapMode::LINEAR,
            false => vk::SamplerMipmapMode::NEAREST,
        })
        .address_mode_u(s)
        .address_mode_v(t)
        .address_mode_w(r)
        .mip_lod_bias(if bias.is_nan() { 0.0 } else { bias.clamp(-most_bias, most_bias) })
        .anisotropy_enable(gpu.features().sampler_anisotropy && anisotropy > 1.0)
        .max_anisotropy(anisotropy)
        .min_lod(least.max(0.0))
        .max_lod(greatest.max(least.max(0.0)))
}

fn address_mode(wrap: Wrap, sampler: &Sampler) -> vk::SamplerAddressMode {
    match wrap {
        Wrap::Repeat => vk::SamplerAddressMode::REPEAT,
        Wrap::MirroredRepeat => vk::SamplerAddressMode::MIRRORED_REPEAT,
        Wrap::ClampToEdge => vk::SamplerAddressMode::CLAMP_TO_EDGE,
        Wrap::ClampToBorder => vk::SamplerAddressMode::CLAMP_TO_BORDER,
        Wrap::Clamp if blends_border(sampler) => vk::SamplerAddressMode::CLAMP_TO_BORDER,
        Wrap::Clamp => vk::SamplerAddressMode::CLAMP_TO_EDGE,
    }
}

/// The border as a texel of the base format, expanded as texels are.
fn border_color(color: &[FloatBits; 4], base_format: BaseFormat) -> [f32; 4] {
    let [r, g, b, a] = color.map(|component| component.get().clamp(0.0, 1.0));
    match base_format {
        BaseFormat::Alpha => [0.0, 0.0, 0.0, a],
        BaseFormat::Luminance => [r, r, r, 1.0],
        BaseFormat::LuminanceAlpha => [r, r, r, a],
        BaseFormat::Intensity => [r; 4],
        BaseFormat::Rgb => [r, g, b, 1.0],
        BaseFormat::Rgba => [r, g, b, a],
        BaseFormat::Depth => [r, 0.0, 0.0, 1.0],
    }
}

/// The border colour that every device has, if it is one of those.
fn standard_border(color: [f32; 4]) -> Option<vk::BorderColor> {
    match color {
        [0.0, 0.0, 0.0, 0.0] => Some(vk::BorderColor::FLOAT_TRANSPARENT_BLACK),
        [0.0, 0.0, 0.0, 1.0] => Some(vk::BorderColor::FLOAT_OPAQUE_BLACK),
        [1.0, 1.0, 1.0, 1.0] => Some(vk::BorderColor::FLOAT_OPAQUE_WHITE),
        _ => None,
    }
}

/// The standard colour that is most like this one.
fn nearest_border([r, g, b, a]: [f32; 4]) -> vk::BorderColor {
    if a < 0.5 {
        vk::BorderColor::FLOAT_TRANSPARENT_BLACK
    } else if r + g + b < 1.5 {
        vk::BorderColor::FLOAT_OPAQUE_BLACK
    } else {
        vk::BorderColor::FLOAT_OPAQUE_WHITE
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{self, gpu};
    use afterglow_gpu::BindlessSizes;

    #[test]
    fn equal_samplers_are_one() {
        let gpu = gpu();
        let table = gpu.create_bindless_table(BindlessSizes::default()).unwrap();
        let mut samplers = Samplers::new(&gpu, &table).unwrap();
        let nearest = testing::nearest();
        let mut index =
            |sampler: &Sampler, bias: f32| samplers.index(&table, sampler, BaseFormat::Rgba, bias).unwrap();
        let first = index(&nearest, 0.0);
        assert_eq!(index(&nearest, 0.0), first);
        assert_ne!(index(&nearest, -1.0), first);
        let linear = Sampler { mag_linear: true, ..nearest };
        assert_ne!(index(&linear, 0.0), first);
    }

    #[test]
    fn the_shader_clamps_where_linear_filtering_meets_the_border() {
        let wrap = [Wrap::Clamp, Wrap::Repeat, Wrap::Clamp];
        let nearest = Sampler { wrap, ..testing::nearest() };
        assert_eq!(shader_clamps(&nearest), 0);
        assert_eq!(shader_clamps(&Sampler { min_linear: true, ..nearest }), 0b101);
    }

    #[test]
    fn borders_are_expanded_like_texels() {
        let color = [0.5, 1.0, 0.0, 0.25].map(FloatBits::from);
        assert_eq!(border_color(&color, BaseFormat::Luminance), [0.5, 0.5, 0.5, 1.0]);
        assert_eq!(border_color(&color, BaseFormat::Alpha), [0.0, 0.0, 0.0, 0.25]);
        assert_eq!(standard_border([0.0, 0.0, 0.0, 1.0]), Some(vk::BorderColor::FLOAT_OPAQUE_BLACK));
    }
}
