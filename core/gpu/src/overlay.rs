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
