//! Copies between images and buffers, and waiting forms of them for tests and screenshots.

use ash::vk;

use crate::barriers::Access;
use crate::buffer::{Buffer, BufferDesc, BufferKind};
use crate::commands::Commands;
use crate::error::GpuError;
use crate::gpu::Gpu;
use crate::image::{Image, aspects};

/// A part of an image that is copied from or to tightly packed texels of a buffer.
#[derive(Debug, Clone, Copy)]
pub struct ImageRegion {
    pub aspect: vk::ImageAspectFlags,
    pub mip: u32,
    pub first_layer: u32,
    pub layers: u32,
    /// Of the first texel.
    pub origin: [i32; 3],
    /// Width, height, depth in texels.
    pub extent: [u32; 3],
    /// Where the first texel lies in the buffer, in bytes.
    pub buffer_offset: u64,
}

impl ImageRegion {
    /// All of one level of one layer.
    pub fn mip(image: &Image, mip: u32, layer: u32) -> Self {
        Self {
            aspect: aspects(image.format()),
            mip,
            first_layer: layer,
            layers: 1,
            origin: [0; 3],
            extent: image.mip_extent(mip),
            buffer_offset: 0,
        }
    }

    fn raw(&self) -> vk::BufferImageCopy {
        let [x, y, z] = self.origin;
        let [width, height, depth] = self.extent;
        vk::BufferImageCopy {
            buffer_offset: self.buffer_offset,
            buffer_row_length: 0,
            buffer_image_height: 0,
            image_subresource: vk::ImageSubresourceLayers {
                aspect_mask: self.aspect,
                mip_level: self.mip,
                base_array_layer: self.first_layer,
                layer_count: self.layers,
            },
            image_offset: vk::Offset3D { x, y, z },
            image_extent: vk::Extent3D { width, height, depth },
        }
    }
}

impl Commands<'_> {
    /// Copies texels to an image that is in the layout of [`Access::TRANSFER_WRITE`].
    pub fn copy_buffer_to_image(&self, from: &Buffer, to: &Image, regions: &[ImageRegion]) {
        let regions: Vec<_> = regions.iter().map(ImageRegion::raw).collect();
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        // SAFETY: both are this device's; the validation layer checks ranges.
        unsafe {
            self.device().cmd_copy_buffer_to_image(self.raw(), from.raw(), to.raw(), layout, &regions);
        }
    }

    /// Copies texels from an image that is in the layout of [`Access::TRANSFER_READ`].
    pub fn copy_image_to_buffer(&self, from: &Image, to: &Buffer, regions: &[ImageRegion]) {
        let regions: Vec<_> = regions.iter().map(ImageRegion::raw).collect();
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        // SAFETY: both are this device's; the validation layer checks ranges.
        unsafe {
            self.device().cmd_copy_image_to_buffer(self.raw(), from.raw(), layout, to.raw(), &regions);
        }
    }

    /// Fills an image that is in the layout of [`Access::TRANSFER_WRITE`] with one colour.
    pub fn clear_color(&self, image: &Image, color: [f32; 4]) {
        let color = vk::ClearColorValue { float32: color };
        // SAFETY: the image is this device's.
        unsafe {
            self.device().cmd_clear_color_image(
                self.raw(),
                image.raw(),
                vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                &color,
                &[image.whole_range()],
            );
        }
    }
}

impl Gpu {
    /// Copies one region of an image to memory, tightly packed with `texel_bytes` a texel, and waits for it.
    /// `last` is how the image was used last; it is left ready for that use again.
    pub fn download_image(
        &self,
        image: &Image,
        region: &ImageRegion,
        texel_bytes: u32,
        last: Access,
    ) -> Result<Vec<u8>, GpuError> {
        let texels = region.extent.iter().map(|&side| u64::from(side)).product::<u64>();
        let size = texels * u64::from(region.layers) * u64::from(texel_bytes);
        let staging = self.create_buffer(&BufferDesc::new("download", BufferKind::Readback, size))?;
        let region = ImageRegion { buffer_offset: 0, ..*region };
        self.run(|commands| {
            commands.image_barrier(image, last, Access::TRANSFER_READ);
            commands.copy_image_to_buffer(image, &staging, &[region]);
            commands.barriers(
                &[crate::memory_barrier(Access::TRANSFER_WRITE, Access::HOST_READ)],
                &[crate::image_barrier(image, Access::TRANSFER_READ, last)],
            );
        })?;
        let mut bytes = vec![0; size as usize];
        staging.read(0, &mut bytes)?;
        Ok(bytes)
    }

    /// Copies tightly packed texels to one region of an image, leaves it ready for `next`, and waits. If
    /// `last` is [`Access::NONE`], what the image held elsewhere is lost.
    pub fn upload_image(
        &self,
        image: &Image,
        region: &ImageRegion,
        bytes: &[u8],
        last: Access,
        next: Access,
    ) -> Result<(), GpuError> {
        let desc = BufferDesc::new("upload", BufferKind::Upload, bytes.len() as u64);
        let mut staging = self.create_buffer(&desc)?;
        staging.write(0, bytes)?;
        let region = ImageRegion { buffer_offset: 0, ..*region };
        self.run(|commands| {
            commands.image_barrier(image, last, Access::TRANSFER_WRITE);
            commands.copy_buffer_to_image(&staging, image, &[region]);
            commands.image_barrier(image, Access::TRANSFER_WRITE, next);
        })
    }
}
