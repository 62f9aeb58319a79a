//! The validation layer is really there: it catches what is planted.

use afterglow_gpu::{Access, BufferDesc, BufferKind, Gpu, GpuOptions, ImageDesc, vk};

fn checked() -> Option<Gpu> {
    let options = GpuOptions::for_tests();
    options.validation.then(|| Gpu::new(&options).unwrap())
}

#[test]
fn a_planted_error_is_caught() {
    let Some(gpu) = checked() else { return };
    let usage = vk::ImageUsageFlags::TRANSFER_DST;
    let desc = ImageDesc::d2("wrong", vk::Format::R8_UNORM, [4, 4], usage);
    let image = gpu.create_image(&desc).unwrap();
    assert_eq!(gpu.validation_count(), 0);
    // The image is cleared in a layout that it is not in.
    gpu.run(|commands| commands.clear_color(&image, [0.0; 4])).unwrap();
    assert!(gpu.validation_count() > 0);
    let messages = gpu.validation_messages().join("\n");
    assert!(messages.contains("layout"), "{messages}");
}

#[test]
fn a_planted_hazard_is_caught() {
    let Some(gpu) = checked() else { return };
    let buffers = ["first", "second"]
        .map(|name| gpu.create_buffer(&BufferDesc::new(name, BufferKind::Device, 64)).unwrap());
    let copy = |barrier: bool| {
        gpu.run(|commands| {
            commands.fill_buffer(&buffers[0], 1);
            if barrier {
                let both = Access::TRANSFER_READ.or(Access::TRANSFER_WRITE);
                commands.memory_barrier(Access::TRANSFER_WRITE, both);
            }
            commands.copy_buffer(&buffers[0], 0, &buffers[1], 0, 64);
        })
        .unwrap();
        gpu.validation_count()
    };
    assert_eq!(copy(true), 0);
    assert!(copy(false) > 0);
    let messages = gpu.validation_messages().join("\n");
    assert!(messages.to_lowercase().contains("hazard"), "{messages}");
}
