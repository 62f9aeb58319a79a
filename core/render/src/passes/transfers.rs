//! Texels into images, and retained ranges into their buffers.

use afterglow_gpu::{Access, Commands, memory_barrier, vk};

use crate::plan::{Plan, Transfer};
use crate::retained::{RangeCopy, record_copies};
use crate::textures::{Texture, Textures};

/// Makes a frame's new images ready, and clears those that it does not fill.
pub(crate) fn record_first(commands: &Commands<'_>, plan: &Plan, textures: &Textures, ranges: &[RangeCopy]) {
    record_copies(commands, ranges);
    let new = |(image, clear): &(_, bool)| Some((textures.get(*image)?, *clear));
    let new: Vec<(&Texture, bool)> = plan.defined.iter().filter_map(new).collect();
    let barriers: Vec<_> = new.iter().map(|(texture, _)| texture.first_barrier()).collect();
    commands.barriers(&[], &barriers);
    for (texture, _) in new.iter().filter(|(_, clear)| *clear) {
        clear(commands, texture);
    }
    if new.iter().any(|(_, clear)| *clear) {
        wait(commands);
    }
}

/// Records copies to images, in order.
pub(crate) fn record(commands: &Commands<'_>, transfers: &[Transfer], textures: &Textures) {
    for transfer in transfers {
        match transfer {
            Transfer::Wait => wait(commands),
            Transfer::Upload { image, region, from } => {
                if let Some(texture) = textures.get(*image) {
                    let region = texture.buffer_copy(region, from.offset);
                    write_image(commands, from.buffer, texture, &[region]);
                }
            }
            Transfer::Copy { from, region, to, to_level } => {
                if let (Some(from), Some(to)) = (textures.get(*from), textures.get(*to)) {
                    let source = from.subresource(region.level, region.layer);
                    let target = to.subresource(*to_level, region.layer);
                    let region = image_copy(source, target, region.offset, region.extent);
                    copy_image(commands, from, to, &region);
                }
            }
        }
    }
}

/// Copies texels of a buffer to a texture.
pub(crate) fn write_image(
    commands: &Commands<'_>,
    buffer: vk::Buffer,
    texture: &Texture,
    regions: &[vk::BufferImageCopy],
) {
    // SAFETY: the image is in this layout; the plan has checked that the regions lie in it and in the buffer.
    unsafe {
        commands.device().cmd_copy_buffer_to_image(
            commands.raw(),
            buffer,
            texture.image.raw(),
            vk::ImageLayout::GENERAL,
            regions,
        );
    }
}

fn image_copy(
    source: vk::ImageSubresourceLayers,
    target: vk::ImageSubresourceLayers,
    offset: [u32; 3],
    [width, height, depth]: [u32; 3],
) -> vk::ImageCopy {
    let [x, y, z] = offset.map(|offset| offset as i32);
    vk::ImageCopy {
        src_subresource: source,
        src_offset: vk::Offset3D { x, y, z },
        dst_subresource: target,
        dst_offset: vk::Offset3D { x, y, z },
        extent: vk::Extent3D { width, height, depth },
    }
}

fn copy_image(commands: &Commands<'_>, from: &Texture, to: &Texture, region: &vk::ImageCopy) {
    if from.shape.format != to.shape.format {
        return;
    }
    // SAFETY: both images are in this layout and have the same format; the plan has checked the region.
    unsafe {
        commands.device().cmd_copy_image(
            commands.raw(),
            from.image.raw(),
            vk::ImageLayout::GENERAL,
            to.image.raw(),
            vk::ImageLayout::GENERAL,
            &[*region],
        );
    }
}

fn clear(commands: &Commands<'_>, texture: &Texture) {
    // SAFETY: the image is in this layout and may be copied to.
    unsafe {
        commands.device().cmd_clear_color_image(
            commands.raw(),
            texture.image.raw(),
            vk::ImageLayout::GENERAL,
            &vk::ClearColorValue::default(),
            &[texture.image.whole_range()],
        );
    }
}

/// What follows waits for the copies before.
fn wait(commands: &Commands<'_>) {
    let either = Access::TRANSFER_READ.or(Access::TRANSFER_WRITE);
    commands.barriers(&[memory_barrier(Access::TRANSFER_WRITE, either)], &[]);
}
