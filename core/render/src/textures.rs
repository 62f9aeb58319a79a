//! Texture images on the device, all of them always in layout `GENERAL`.
//!
//! Their views expand base formats: the alpha of an RGB texture reads as 1 whatever is stored, so that texels can be
//! copied from the frame buffer as they are.

use afterglow_gl::frame::{BaseFormat, Dimension, ImageKey, ImageShape, Region, TexelFormat};
use afterglow_gpu::{
    Access, BindlessKind, BindlessTable, Gpu, GpuError, Image, ImageDesc, image_barrier, vk,
};
use afterglow_images::{Format, Picture};
use hashbrown::HashMap;

/// Bytes of a texel, whatever its format.
pub(crate) const TEXEL_BYTES: usize = 4;

/// Depth textures are compared by the shader, so they are images of one float.
pub(crate) const DEPTH_TEXEL_FORMAT: vk::Format = vk::Format::R32_SFLOAT;

/// A texture image and where shaders find it.
pub(crate) struct Texture {
    pub(crate) image: Image,
    pub(crate) shape: ImageShape,
    /// Index into the bindless array of its dimensionality.
    pub(crate) index: u32,
}

/// All images that the program has defined.
pub(crate) struct Textures {
    gpu: Gpu,
    images: HashMap<ImageKey, Texture>,
    /// White, one of each dimensionality, at index 0 of its array: for what cannot be made.
    _missing: [Texture; 3],
}

impl Textures {
    pub(crate) fn new(gpu: &Gpu, table: &BindlessTable) -> Result<Self, GpuError> {
        let missing = |dimension| create(gpu, table, &missing_shape(dimension));
        let missing = [missing(Dimension::D2)?, missing(Dimension::D3)?, missing(Dimension::Cube)?];
        gpu.submit(|commands| {
            for texture in &missing {
                commands.image_barrier(&texture.image, Access::NONE, Access::TRANSFER_WRITE);
                commands.clear_color(&texture.image, [1.0; 4]);
                let general = Access::SAMPLE.in_layout(vk::ImageLayout::GENERAL);
                commands.image_barrier(&texture.image, Access::TRANSFER_WRITE, general);
            }
        })?;
        Ok(Self { gpu: gpu.clone(), images: HashMap::new(), _missing: missing })
    }

    /// Makes an image, its contents and layout undefined. Says whether the device could; what needs an image that
    /// it could not make uses a white one or is left out.
    pub(crate) fn define(
        &mut self,
        table: &BindlessTable,
        key: ImageKey,
        shape: &ImageShape,
    ) -> Result<bool, GpuError> {
        match create(&self.gpu, table, shape) {
            Ok(texture) => {
                self.images.insert(key, texture);
                Ok(true)
            }
            Err(error) if error.is_device_lost() => Err(error),
            Err(error) => {
                tracing::warn!(?shape, "a texture could not be made: {error}");
                Ok(false)
            }
        }
    }

    /// Makes the image of a picture that replaces a texture of this base format, its contents and layout undefined. Says
    /// whether the device could.
    pub(crate) fn define_picture(
        &mut self,
        table: &BindlessTable,
        key: ImageKey,
        picture: &Picture,
        swizzle: [vk::ComponentSwizzle; 4],
    ) -> Result<bool, GpuError> {
        let shape = ImageShape {
            width: picture.width,
            height: picture.height,
            levels: picture.levels.len() as u32,
            ..missing_shape(Dimension::D2)
        };
        let desc = ImageDesc { format: picture_format(picture.format), ..image_desc(&shape) };
        match create_of(&self.gpu, table, &shape, &desc, swizzle) {
            Ok(texture) => {
                self.images.insert(key, texture);
                Ok(true)
            }
            Err(error) if error.is_device_lost() => Err(error),
            Err(error) => {
                tracing::warn!(?shape, "an image could not be made: {error}");
                Ok(false)
            }
        }
    }

    pub(crate) fn get(&self, key: ImageKey) -> Option<&Texture> {
        self.images.get(&key)
    }

    /// Forgets an image. Commands that name it may be in flight, but must have been recorded.
    pub(crate) fn remove(&mut self, table: &BindlessTable, key: ImageKey) {
        if let Some(texture) = self.images.remove(&key) {
            table.remove(bindless_kind(texture.shape.dimension), texture.index);
        }
    }

    /// Images that are there.
    pub(crate) fn len(&self) -> usize {
        self.images.len()
    }
}

impl Texture {
    /// Whether `region` lies in the image.
    pub(crate) fn holds(&self, region: &Region) -> bool {
        holds(&self.shape, region)
    }

    /// Whether `region` is all of its level and layer.
    pub(crate) fn is_whole(&self, region: &Region) -> bool {
        region.offset == [0; 3] && region.extent == level_extent(&self.shape, region.level)
    }

    /// One level of one layer.
    pub(crate) fn subresource(&self, level: u32, layer: u32) -> vk::ImageSubresourceLayers {
        vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: level,
            base_array_layer: layer,
            layer_count: 1,
        }
    }

    /// A region's texels, tightly packed in a buffer from `offset` bytes on.
    pub(crate) fn buffer_copy(&self, region: &Region, offset: u64) -> vk::BufferImageCopy {
        let [x, y, z] = region.offset.map(|offset| offset as i32);
        let [width, height, depth] = region.extent;
        vk::BufferImageCopy {
            buffer_offset: offset,
            buffer_row_length: 0,
            buffer_image_height: 0,
            image_subresource: self.subresource(region.level, region.layer),
            image_offset: vk::Offset3D { x, y, z },
            image_extent: vk::Extent3D { width, height, depth },
        }
    }

    /// The barrier that makes a new image ready to be written by copies.
    pub(crate) fn first_barrier(&self) -> vk::ImageMemoryBarrier2<'static> {
        let general = Access::TRANSFER_WRITE.in_layout(vk::ImageLayout::GENERAL);
        image_barrier(&self.image, Access::NONE, general)
    }
}

/// Width, height and depth of a level.
fn level_extent(shape: &ImageShape, level: u32) -> [u32; 3] {
    let halved = |side: u32| side.checked_shr(level).unwrap_or(0).max(1);
    [
        halved(shape.width),
        halved(shape.height),
        match shape.dimension {
            Dimension::D3 => halved(shape.depth),
            Dimension::D2 | Dimension::Cube => 1,
        },
    ]
}

/// Whether `region` lies in an image of this shape.
pub(crate) fn holds(shape: &ImageShape, region: &Region) -> bool {
    let layers = if shape.dimension == Dimension::Cube { 6 } else { 1 };
    region.level < shape.levels
        && region.layer < layers
        && region.extent.iter().all(|&length| length > 0)
        && std::iter::zip(region.offset, region.extent)
            .zip(level_extent(shape, region.level))
            .all(|((offset, length), limit)| offset.checked_add(length).is_some_and(|end| end <= limit))
}

/// Texels of a region.
pub(crate) fn texel_count(region: &Region) -> usize {
    region.extent.iter().map(|&length| length as usize).product()
}

fn missing_shape(dimension: Dimension) -> ImageShape {
    ImageShape {
        dimension,
        width: 1,
        height: 1,
        depth: 1,
        levels: 1,
        format: TexelFormat::Rgba8,
        base_format: BaseFormat::Rgba,
    }
}

fn create(gpu: &Gpu, table: &BindlessTable, shape: &ImageShape) -> Result<Texture, GpuError> {
    create_of(gpu, table, shape, &image_desc(shape), expansion(shape.base_format))
}

fn create_of(
    gpu: &Gpu,
    table: &BindlessTable,
    shape: &ImageShape,
    desc: &ImageDesc<'_>,
    swizzle: [vk::ComponentSwizzle; 4],
) -> Result<Texture, GpuError> {
    let image = gpu.create_image(desc)?;
    let view = afterglow_gpu::ViewDesc { swizzle, ..image.whole_view() };
    let view = image.view_of(&view)?;
    let kind = bindless_kind(shape.dimension);
    let index = table.add_image(kind, view, vk::ImageLayout::GENERAL)?;
    Ok(Texture { image, shape: *shape, index })
}

fn image_desc(shape: &ImageShape) -> ImageDesc<'static> {
    let usage =
        vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
    let format = match shape.format {
        TexelFormat::Rgba8 => vk::Format::R8G8B8A8_UNORM,
        TexelFormat::Depth32 => DEPTH_TEXEL_FORMAT,
    };
    let name = "texture";
    let desc = match shape.dimension {
        Dimension::D2 => ImageDesc::d2(name, format, [shape.width, shape.height], usage),
        Dimension::D3 => {
            let extent = [shape.width, shape.height, shape.depth];
            ImageDesc::d3(name, format, extent, usage)
        }
        Dimension::Cube => ImageDesc::cube(name, format, shape.width, usage),
    };
    desc.mips(shape.levels)
}

/// Colours stay encoded: shaders decode them.
fn picture_format(format: Format) -> vk::Format {
    match format {
        Format::Rgba8 => vk::Format::R8G8B8A8_UNORM,
        Format::Rgba16F => vk::Format::R16G16B16A16_SFLOAT,
        Format::Bc1 => vk::Format::BC1_RGB_UNORM_BLOCK,
        Format::Bc1Alpha => vk::Format::BC1_RGBA_UNORM_BLOCK,
        Format::Bc2 => vk::Format::BC2_UNORM_BLOCK,
        Format::Bc3 => vk::Format::BC3_UNORM_BLOCK,
        Format::Bc4 => vk::Format::BC4_UNORM_BLOCK,
        Format::Bc5 => vk::Format::BC5_UNORM_BLOCK,
        Format::Bc7 => vk::Format::BC7_UNORM_BLOCK,
    }
}

fn bindless_kind(dimension: Dimension) -> BindlessKind {
    match dimension {
        Dimension::D2 => BindlessKind::Texture2d,
        Dimension::D3 => BindlessKind::Texture3d,
        Dimension::Cube => BindlessKind::TextureCube,
    }
}

/// How stored components become a texel of the base format (OpenGL 1.5, table 3.15).
fn expansion(base_format: BaseFormat) -> [vk::ComponentSwizzle; 4] {
    use vk::ComponentSwizzle as Swizzle;
    const ZERO: Swizzle = Swizzle::ZERO;
    const ONE: Swizzle = Swizzle::ONE;
    const R: Swizzle = Swizzle::R;
    const A: Swizzle = Swizzle::A;
    match base_format {
        BaseFormat::Alpha => [ZERO, ZERO, ZERO, A],
        BaseFormat::Luminance => [R, R, R, ONE],
        BaseFormat::LuminanceAlpha => [R, R, R, A],
        BaseFormat::Intensity => [R; 4],
        BaseFormat::Rgb => [R, Swizzle::G, Swizzle::B, ONE],
        BaseFormat::Rgba | BaseFormat::Depth => [Swizzle::IDENTITY; 4],
    }
}

/// Texels as stored, expanded in place as the image's views do it.
pub(crate) fn expand(base_format: BaseFormat, texels: &mut [u8]) {
    for texel in texels.as_chunks_mut::<TEXEL_BYTES>().0 {
        let [r, g, b, a] = *texel;
        *texel = match base_format {
            BaseFormat::Alpha => [0, 0, 0, a],
            BaseFormat::Luminance => [r, r, r, 255],
            BaseFormat::LuminanceAlpha => [r, r, r, a],
            BaseFormat::Intensity => [r; 4],
            BaseFormat::Rgb => [r, g, b, 255],
            BaseFormat::Rgba | BaseFormat::Depth => [r, g, b, a],
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::gpu;
    use afterglow_gpu::BindlessSizes;

    #[test]
    fn an_impossible_image_is_left_out() {
        let gpu = gpu();
        let table = gpu.create_bindless_table(BindlessSizes::default()).unwrap();
        let mut textures = Textures::new(&gpu, &table).unwrap();
        let shape = ImageShape { width: 1 << 30, ..missing_shape(Dimension::D2) };
        let key = ImageKey::unique();
        assert!(!textures.define(&table, key, &shape).unwrap());
        assert!(textures.get(key).is_none());
    }

    #[test]
    fn regions_are_checked_against_their_level() {
        let gpu = gpu();
        let table = gpu.create_bindless_table(BindlessSizes::default()).unwrap();
        let mut textures = Textures::new(&gpu, &table).unwrap();
        let shape = ImageShape { width: 8, height: 4, levels: 3, ..missing_shape(Dimension::D2) };
        let key = ImageKey::unique();
        assert!(textures.define(&table, key, &shape).unwrap());
        let texture = textures.get(key).unwrap();
        let region = |level, offset, extent| Region { level, layer: 0, offset, extent };
        assert!(texture.is_whole(&region(1, [0; 3], [4, 2, 1])));
        assert!(texture.holds(&region(0, [7, 3, 0], [1, 1, 1])));
        assert!(!texture.holds(&region(1, [4, 0, 0], [1, 1, 1])));
        assert!(!texture.holds(&region(3, [0; 3], [1, 1, 1])));
        assert!(!texture.holds(&region(0, [u32::MAX, 0, 0], [2, 1, 1])));
        textures.remove(&table, key);
        assert_eq!(textures.len(), 0);
    }
}
