//! Textures that a shader picks by index.

use afterglow_gpu::{
    Access, BindlessKind, BindlessSizes, BufferDesc, BufferKind, ComputeDesc, GpuError, ImageDesc,
    ImageRegion, vk,
};

use crate::support::{CheckedGpu, compile, words};

const SAMPLE: &str = r"
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) uniform texture2D textures_2d[];
layout(set = 0, binding = 3) uniform sampler samplers[];
layout(set = 0, binding = 4, r32ui) uniform uimage2D storage_images[];
layout(buffer_reference, scalar) buffer Words { uint word[]; };
layout(push_constant, scalar) uniform Push { uint64_t target; uint first; uint samp; uint storage; uint pad; } push;
void main() {
    uint index = gl_LocalInvocationIndex;
    vec4 texel = textureLod(
        sampler2D(textures_2d[nonuniformEXT(push.first + index)], samplers[push.samp]), vec2(0.5), 0);
    Words(push.target).word[index] = uint(texel.r * 255.0 + 0.5);
    imageStore(storage_images[push.storage], ivec2(index, 0), uvec4(index * 3));
}";

#[derive(Clone, Copy, bytemuck::NoUninit)]
#[repr(C)]
struct Push {
    target: u64,
    first: u32,
    sampler: u32,
    storage: u32,
    padding: u32,
}

#[test]
fn a_shader_picks_textures_by_index() {
    let gpu = CheckedGpu::new();
    let table = gpu.create_bindless_table(BindlessSizes::default()).unwrap();
    let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
    let textures: Vec<_> = (0..8_u8)
        .map(|value| {
            let desc = ImageDesc::d2("texture", vk::Format::R8_UNORM, [1, 1], usage);
            let image = gpu.create_image(&desc).unwrap();
            let region = ImageRegion::mip(&image, 0, 0);
            gpu.upload_image(&image, &region, &[value * 11], Access::NONE, Access::SAMPLE).unwrap();
            image
        })
        .collect();
    let slots: Vec<u32> = textures
        .iter()
        .map(|image| {
            let layout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
            table.add_image(BindlessKind::Texture2d, image.view(), layout).unwrap()
        })
        .collect();
    assert_eq!(slots, [0, 1, 2, 3, 4, 5, 6, 7]);
    let sampler = gpu.create_sampler(&vk::SamplerCreateInfo::default()).unwrap();
    let usage = vk::ImageUsageFlags::STORAGE | vk::ImageUsageFlags::TRANSFER_SRC;
    let desc = ImageDesc::d2("storage", vk::Format::R32_UINT, [8, 1], usage);
    let storage = gpu.create_image(&desc).unwrap();
    let spirv = compile("compute", SAMPLE);
    let layouts = [table.layout()];
    let desc = ComputeDesc::new("sample", &spirv).push_constants(24).set_layouts(&layouts);
    let pipeline = gpu.create_compute_pipeline(&desc).unwrap();
    let desc = BufferDesc::new("result", BufferKind::Device, 32);
    let result = gpu.create_buffer(&desc).unwrap();
    let push = Push {
        target: result.address(),
        first: 0,
        sampler: table.add_sampler(sampler.raw()).unwrap(),
        storage: table
            .add_image(BindlessKind::StorageImage, storage.view(), vk::ImageLayout::GENERAL)
            .unwrap(),
        padding: 0,
    };
    gpu.run(|commands| {
        commands.image_barrier(&storage, Access::NONE, Access::COMPUTE_WRITE);
        commands.compute(&pipeline, &[table.set()], &push, [1, 1, 1]);
    })
    .unwrap();
    let sampled = words(&gpu.download_buffer(&result).unwrap());
    assert_eq!(sampled, [0, 11, 22, 33, 44, 55, 66, 77]);
    let region = ImageRegion::mip(&storage, 0, 0);
    let stored = gpu.download_image(&storage, &region, 4, Access::COMPUTE_WRITE);
    assert_eq!(words(&stored.unwrap()), [0, 3, 6, 9, 12, 15, 18, 21]);
}

#[test]
fn a_full_table_says_so_and_slots_come_back() {
    let gpu = CheckedGpu::new();
    let sizes = BindlessSizes { samplers: 1, ..BindlessSizes::default() };
    let table = gpu.create_bindless_table(sizes).unwrap();
    let sampler = gpu.create_sampler(&vk::SamplerCreateInfo::default()).unwrap();
    let slot = table.add_sampler(sampler.raw()).unwrap();
    let full = table.add_sampler(sampler.raw());
    assert!(matches!(full, Err(GpuError::BindlessFull { capacity: 1, .. })));
    table.remove(BindlessKind::Sampler, slot);
    gpu.collect().unwrap();
    assert_eq!(table.add_sampler(sampler.raw()).unwrap(), slot);
}
