//! Images: cleared, written, copied, placed, refused.

use afterglow_gpu::{Access, ImageDesc, ImageRegion, vk};

use crate::support::CheckedGpu;

const USAGE: vk::ImageUsageFlags = vk::ImageUsageFlags::from_raw(
    vk::ImageUsageFlags::TRANSFER_SRC.as_raw()
        | vk::ImageUsageFlags::TRANSFER_DST.as_raw()
        | vk::ImageUsageFlags::SAMPLED.as_raw(),
);

#[test]
fn a_cleared_image_reads_back() {
    let gpu = CheckedGpu::new();
    let desc = ImageDesc::d2("clear", vk::Format::R8G8B8A8_UNORM, [17, 5], USAGE);
    let image = gpu.create_image(&desc).unwrap();
    gpu.run(|commands| {
        commands.image_barrier(&image, Access::NONE, Access::TRANSFER_WRITE);
        commands.clear_color(&image, [1.0, 0.0, 0.2, 1.0]);
        commands.image_barrier(&image, Access::TRANSFER_WRITE, Access::SAMPLE);
    })
    .unwrap();
    let region = ImageRegion::mip(&image, 0, 0);
    let texels = gpu.download_image(&image, &region, 4, Access::SAMPLE).unwrap();
    assert_eq!(texels, [255, 0, 51, 255].repeat(17 * 5));
}

#[test]
fn levels_layers_and_parts_are_written_apart() {
    let gpu = CheckedGpu::new();
    let desc = ImageDesc::cube("cube", vk::Format::R8_UNORM, 8, USAGE).mips(3);
    let cube = gpu.create_image(&desc).unwrap();
    assert_eq!(cube.mip_extent(2), [2, 2, 1]);
    let region = ImageRegion::mip(&cube, 2, 4);
    gpu.upload_image(&cube, &region, &[1, 2, 3, 4], Access::NONE, Access::SAMPLE).unwrap();
    let corner = ImageRegion { origin: [1, 1, 0], extent: [1, 1, 1], ..region };
    gpu.upload_image(&cube, &corner, &[9], Access::SAMPLE, Access::SAMPLE).unwrap();
    let texels = gpu.download_image(&cube, &region, 1, Access::SAMPLE);
    assert_eq!(texels.unwrap(), [1, 2, 3, 9]);

    let view = cube.view_of_mip(2, 4).unwrap();
    assert_ne!(view, cube.view());
    assert_eq!(view, cube.view_of_mip(2, 4).unwrap(), "views are kept");
}

#[test]
fn images_share_a_heap() {
    let gpu = CheckedGpu::new();
    let desc = ImageDesc::d2("placed", vk::Format::R32_SFLOAT, [64, 64], USAGE);
    let needs = gpu.image_requirements(&desc).unwrap();
    let heap = gpu.allocate_heap("heap", needs.size * 2, needs.alignment, needs.memory_type_bits).unwrap();
    let first = gpu.place_image(&desc, &heap, 0).unwrap();
    let second = gpu.place_image(&desc, &heap, needs.size).unwrap();
    assert!(gpu.place_image(&desc, &heap, needs.size + 1).is_err());
    assert!(gpu.place_image(&desc, &heap, needs.size * 2).is_err());
    assert!(gpu.place_image(&desc, &heap, u64::MAX).is_err());
    drop(heap);
    for (image, value) in [(&first, 1.0_f32), (&second, 2.0)] {
        gpu.run(|commands| {
            commands.image_barrier(image, Access::NONE, Access::TRANSFER_WRITE);
            commands.clear_color(image, [value; 4]);
            commands.image_barrier(image, Access::TRANSFER_WRITE, Access::SAMPLE);
        })
        .unwrap();
    }
    for (image, value) in [(&first, 1.0_f32), (&second, 2.0)] {
        let region = ImageRegion::mip(image, 0, 0);
        let texels = gpu.download_image(image, &region, 4, Access::SAMPLE);
        assert_eq!(texels.unwrap(), value.to_le_bytes().repeat(64 * 64));
    }
}

#[test]
fn images_that_no_device_makes_are_refused() {
    let gpu = CheckedGpu::new();
    let format = vk::Format::R8G8B8A8_UNORM;
    for extent in [[0, 1], [1 << 30, 1], [u32::MAX, u32::MAX]] {
        let desc = ImageDesc::d2("impossible", format, extent, USAGE);
        assert!(gpu.create_image(&desc).is_err(), "{extent:?}");
    }
    let desc = ImageDesc::d2("levels", format, [4, 4], USAGE);
    assert!(gpu.create_image(&desc.mips(99)).is_err());
    assert!(gpu.create_image(&desc.layers(0)).is_err());
    let depth = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
    let desc = ImageDesc::d2("no depth format", format, [4, 4], depth);
    assert!(gpu.create_image(&desc).is_err());
}

#[test]
fn a_rendering_clears_its_attachments() {
    let gpu = CheckedGpu::new();
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
    let desc = ImageDesc::d2("target", vk::Format::R8G8B8A8_UNORM, [4, 4], usage);
    let image = gpu.create_image(&desc).unwrap();
    let mut clear = vk::ClearValue::default();
    clear.color.float32 = [0.0, 1.0, 0.0, 1.0];
    let attachments = [vk::RenderingAttachmentInfo::default()
        .image_view(image.view())
        .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)
        .clear_value(clear)];
    let area = vk::Rect2D::default().extent(vk::Extent2D { width: 4, height: 4 });
    let info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&attachments);
    gpu.run(|commands| {
        commands.labelled(c"clearing", || {
            commands.image_barrier(&image, Access::NONE, Access::COLOR_ATTACHMENT);
            commands.rendering(&info, || {});
        });
    })
    .unwrap();
    let region = ImageRegion::mip(&image, 0, 0);
    let texels = gpu.download_image(&image, &region, 4, Access::COLOR_ATTACHMENT);
    assert_eq!(texels.unwrap(), [0, 255, 0, 255].repeat(16));
}
