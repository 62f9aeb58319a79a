//! Copies from the window to textures (glCopyTexImage): read into a buffer, turn upside down, write to images. Where
//! the texels are more or fewer than the window's pixels, they are resampled as they are turned.

use afterglow_gpu::{Commands, ComputeDesc, ComputePipeline, Gpu, GpuError, vk};
use afterglow_records::{FlipPush, FlipRecord};

use crate::passes::transfers::write_image;
use crate::plan::CopyBatch;
use crate::store::Store;
use crate::target::Target;
use crate::textures::{TEXEL_BYTES, Textures};
use crate::uploads::UploadArena;

/// Texels that a workgroup turns at most, unless a single row is longer.
const WORKGROUP_TEXELS: u32 = 4096;
/// Every device allows so many workgroups.
const MOST_WORKGROUPS: u32 = 65_535;

/// The shader that reverses rows.
pub(crate) struct Flip {
    pipeline: ComputePipeline,
}

/// The records of one batch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlipRecords {
    address: u64,
    count: u32,
}

impl Flip {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let desc = ComputeDesc::new("flip.comp", afterglow_shaders::current(afterglow_shaders::FLIP_COMP))
            .push_constants(size_of::<FlipPush>() as u32);
        Ok(Self { pipeline: gpu.create_compute_pipeline(&desc)? })
    }

    /// Records the second step: the store's pixels to its texels.
    pub(crate) fn record(
        &self,
        commands: &Commands<'_>,
        target: &Target,
        batch: &CopyBatch,
        records: FlipRecords,
    ) {
        let maximum = target.depth_format.maximum();
        for first in (0..records.count).step_by(MOST_WORKGROUPS as usize) {
            let push = FlipPush {
                records: records.address,
                depth_maximum: if batch.from_depth { maximum } else { 0 },
                first,
            };
            let groups = (records.count - first).min(MOST_WORKGROUPS);
            commands.compute(&self.pipeline, &[], &push, [groups, 1, 1]);
        }
    }
}

/// Bytes that a batch needs in the store.
pub(crate) fn store_bytes(batch: &CopyBatch) -> u64 {
    ((batch.pixels + batch.texels) * TEXEL_BYTES) as u64
}

/// Uploads what the shader reads for a batch.
pub(crate) fn prepare(
    batch: &CopyBatch,
    store: &Store,
    arena: &mut UploadArena,
) -> Result<FlipRecords, GpuError> {
    let mut records = Vec::with_capacity(batch.items.len());
    for item in &batch.items {
        let [width, height, _] = item.region.extent;
        let rows_each = (WORKGROUP_TEXELS / width).clamp(1, height);
        let pixels = item.source.extent;
        let source = store.address() + (item.first_pixel * TEXEL_BYTES) as u64;
        let target = store.address() + ((batch.pixels + item.first_texel) * TEXEL_BYTES) as u64;
        for first_row in (0..height).step_by(rows_each as usize) {
            records.push(FlipRecord {
                source,
                target,
                source_width: pixels.width,
                source_height: pixels.height,
                width,
                height,
                first_row,
                rows: rows_each.min(height - first_row),
            });
        }
    }
    Ok(FlipRecords { address: arena.push_table(&records)?.address, count: records.len() as u32 })
}

/// Records the first step: the window to the store's pixels.
pub(crate) fn record_read(commands: &Commands<'_>, target: &Target, batch: &CopyBatch, store: &Store) {
    let Some(buffer) = store.buffer() else { return };
    let (image, aspect) = if batch.from_depth {
        (&target.depth, vk::ImageAspectFlags::DEPTH)
    } else {
        (&target.color, vk::ImageAspectFlags::COLOR)
    };
    let regions: Vec<_> = batch
        .items
        .iter()
        .map(|item| window_region(aspect, item.source, (item.first_pixel * TEXEL_BYTES) as u64))
        .collect();
    read_image(commands, image.raw(), buffer.raw(), &regions);
}

/// Records the last step: the store's texels to the textures.
pub(crate) fn record_write(commands: &Commands<'_>, batch: &CopyBatch, store: &Store, textures: &Textures) {
    let Some(buffer) = store.buffer() else { return };
    for item in &batch.items {
        if let Some(texture) = textures.get(item.image) {
            let offset = ((batch.pixels + item.first_texel) * TEXEL_BYTES) as u64;
            let region = texture.buffer_copy(&item.region, offset);
            write_image(commands, buffer.raw(), texture, &[region]);
        }
    }
}

/// A rectangle of the window, tightly packed in a buffer from `offset` bytes on, the highest row first.
pub(crate) fn window_region(
    aspect: vk::ImageAspectFlags,
    rect: vk::Rect2D,
    offset: u64,
) -> vk::BufferImageCopy {
    vk::BufferImageCopy {
        buffer_offset: offset,
        buffer_row_length: 0,
        buffer_image_height: 0,
        image_subresource: vk::ImageSubresourceLayers {
            aspect_mask: aspect,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        },
        image_offset: vk::Offset3D { x: rect.offset.x, y: rect.offset.y, z: 0 },
        image_extent: vk::Extent3D { width: rect.extent.width, height: rect.extent.height, depth: 1 },
    }
}

/// Copies parts of one of the window's images to a buffer.
pub(crate) fn read_image(
    commands: &Commands<'_>,
    image: vk::Image,
    buffer: vk::Buffer,
    regions: &[vk::BufferImageCopy],
) {
    // SAFETY: the image is in this layout; the regions were clipped to it, and the buffer has room for them.
    unsafe {
        commands.device().cmd_copy_image_to_buffer(
            commands.raw(),
            image,
            vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            buffer,
            regions,
        );
    }
}
