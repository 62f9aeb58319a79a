//! A small picture that is laid over what a window shows.

use ash::vk;

use crate::barriers::Access;
use crate::buffer::{Buffer, BufferDesc, BufferKind};
use crate::commands::Commands;
use crate::error::GpuError;
use crate::gpu::Gpu;

/// Grey pixels, which look the same whatever the order of a window's components.
pub struct Overlay {
    buffer: Buffer,
    size: [u32; 2],
}

impl Gpu {
    /// A picture of this width and height; its pixels one byte each, the highest row first.
    pub fn overlay(&self, size: [u32; 2], greys: &[u8]) -> Result<Overlay, GpuError> {
        if greys.is_empty() || greys.len() as u64 != u64::from(size[0]) * u64::from(size[1]) {
            let detail = format!("{} pixels for {} x {}", greys.len(), size[0], size[1]);
            return Err(GpuError::Invalid { what: "overlay", detail });
        }
        let pixels: Vec<u8> = greys.iter().flat_map(|grey| [*grey, *grey, *grey, 255]).collect();
        let mut buffer =
            self.create_buffer(&BufferDesc::new("overlay", BufferKind::Upload, pixels.len() as u64))?;
        buffer.write(0, &pixels)?;
        Ok(Overlay { buffer, size })
    }
}

impl Overlay {
    /// Copies what there is room for to the upper left corner of a picture of `room` pixels, of four bytes each, that
    /// is ready to be written by copies.
    pub(crate) fn record(&self, commands: &Commands<'_>, picture: vk::Image, room: [u32; 2]) {
        let layers = vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        };
        let region = vk::BufferImageCopy::default()
            .buffer_row_length(self.size[0])
            .image_subresource(layers)
            .image_extent(vk::Extent3D {
                width: self.size[0].min(room[0]),
                height: self.size[1].min(room[1]),
                depth: 1,
            });
        // SAFETY: the picture is in this layout and has this room; the buffer holds all rows.
        unsafe {
            commands.device().cmd_copy_buffer_to_image(
                commands.raw(),
                self.buffer.raw(),
                picture,
                Access::TRANSFER_WRITE.layout,
                &[region],
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{GpuOptions, ImageDesc, ImageRegion};

    #[test]
    fn what_there_is_no_room_for_is_left_out() {
        let gpu = Gpu::new(&GpuOptions::for_tests()).unwrap();
        let usage = vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC;
        let desc = ImageDesc::d2("picture", vk::Format::B8G8R8A8_UNORM, [3, 3], usage);
        let picture = gpu.create_image(&desc).unwrap();
        let overlay = gpu.overlay([4, 2], &[10, 20, 30, 40, 50, 60, 70, 80]).unwrap();
        let write = Access::TRANSFER_WRITE;
        gpu.run(|commands| {
            commands.image_barrier(&picture, Access::NONE, write);
            commands.clear_color(&picture, [0.0; 4]);
            commands.image_barrier(&picture, write, write);
            overlay.record(commands, picture.raw(), [3, 3]);
        })
        .unwrap();
        let texels = gpu.download_image(&picture, &ImageRegion::mip(&picture, 0, 0), 4, write).unwrap();
        let greys: Vec<u8> = texels.chunks(4).map(|texel| texel[1]).collect();
        assert_eq!(greys, [10, 20, 30, 50, 60, 70, 0, 0, 0]);
        assert_eq!(texels[..4], [10, 10, 10, 255]);
        assert!(gpu.overlay([2, 2], &[0; 3]).is_err());
        assert_eq!(gpu.validation_count(), 0, "{:?}", gpu.validation_messages());
    }
}
