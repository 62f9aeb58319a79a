//! Compute shaders that reach buffers through addresses, and how long they take.

use afterglow_gpu::{Access, BufferDesc, BufferKind, ComputeDesc};

use crate::support::{CheckedGpu, compile, words};

const FILL: &str = r"
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
layout(local_size_x = 64) in;
layout(constant_id = 3) const uint factor = 1;
layout(buffer_reference, scalar) buffer Words { uint word[]; };
layout(push_constant, scalar) uniform Push { uint64_t target; uint count; uint first; } push;
void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index < push.count) Words(push.target).word[index] = push.first + factor * index;
}";

#[derive(Clone, Copy, bytemuck::NoUninit)]
#[repr(C)]
struct Push {
    target: u64,
    count: u32,
    first: u32,
}

#[test]
fn a_shader_fills_a_buffer_through_its_address() {
    let gpu = CheckedGpu::new();
    let spirv = compile("compute", FILL);
    let desc = ComputeDesc::new("fill", &spirv).push_constants(16).specialization(&[(3, 7)]);
    let pipeline = gpu.create_compute_pipeline(&desc).unwrap();
    let count = 1000;
    let desc = BufferDesc::new("target", BufferKind::Device, count * 4);
    let buffer = gpu.create_buffer(&desc).unwrap();
    let push = Push { target: buffer.address(), count: count as u32, first: 5 };
    let mut timer = gpu.create_timer(1).unwrap();
    gpu.run(|commands| {
        timer.restart(commands);
        commands.fill_buffer(&buffer, 0xffff_ffff);
        commands.memory_barrier(Access::TRANSFER_WRITE, Access::COMPUTE_WRITE);
        let scope = timer.begin(commands, "fill");
        commands.compute(&pipeline, &[], &push, [16, 1, 1]);
        timer.end(commands, scope);
        let beyond = timer.begin(commands, "one scope too many");
        timer.end(commands, beyond);
    })
    .unwrap();
    let result = words(&gpu.download_buffer(&buffer).unwrap());
    let expected: Vec<u32> = (0..count as u32).map(|index| 5 + 7 * index).collect();
    assert_eq!(result, expected);

    let timings = timer.results().unwrap();
    assert_eq!(timings.len(), 1);
    assert_eq!(timings[0].name, "fill");
    assert!((1..10_000_000_000).contains(&timings[0].nanoseconds));
}

#[test]
fn uploads_come_back() {
    let gpu = CheckedGpu::new();
    let bytes: Vec<u8> = (0..=255).collect();
    let buffer = gpu.upload_buffer("upload", Default::default(), &bytes).unwrap();
    assert_eq!(gpu.download_buffer(&buffer).unwrap(), bytes);
    assert!(gpu.upload_buffer("none", Default::default(), &[]).is_err());
}

#[test]
fn ranges_outside_a_buffer_are_refused() {
    let gpu = CheckedGpu::new();
    let desc = BufferDesc::new("small", BufferKind::Upload, 16);
    let mut buffer = gpu.create_buffer(&desc).unwrap();
    buffer.write(8, &[1; 8]).unwrap();
    assert!(buffer.write(9, &[1; 8]).is_err());
    assert!(buffer.write(u64::MAX, &[1; 8]).is_err());
    assert!(buffer.read(16, &mut [0]).is_err());
    assert!(buffer.read(16, &mut []).is_ok());
}

#[test]
fn what_is_no_shader_is_refused() {
    let gpu = CheckedGpu::new();
    assert!(gpu.create_compute_pipeline(&ComputeDesc::new("text", &[0x2222])).is_err());
    let spirv = compile("compute", FILL);
    let desc = ComputeDesc::new("fill", &spirv).push_constants(1 << 20);
    assert!(gpu.create_compute_pipeline(&desc).is_err());
}
