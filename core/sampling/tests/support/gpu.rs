//! The shader `evaluate.comp` on a device.

use super::twins::Input;
use afterglow_gpu::{BufferDesc, BufferKind, ComputeDesc, Gpu, GpuOptions, vk};
use bytemuck::{Pod, Zeroable};
use std::path::Path;
use std::process::Command;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Constants {
    inputs: u64,
    answers: u64,
    count: u32,
    width: u32,
}

/// The device's answers, `width` words an input.
pub fn evaluate(inputs: &[Input], width: usize) -> Vec<u32> {
    let gpu = Gpu::new(&GpuOptions::for_tests()).unwrap();
    let spirv = compile();
    let desc = ComputeDesc::new("evaluate", &spirv).push_constants(size_of::<Constants>() as u32);
    let pipeline = gpu.create_compute_pipeline(&desc).unwrap();
    let bytes = bytemuck::cast_slice(inputs);
    let inputs_buffer = gpu.upload_buffer("inputs", vk::BufferUsageFlags::empty(), bytes).unwrap();
    let size = (inputs.len() * width * 4) as u64;
    let answers = gpu.create_buffer(&BufferDesc::new("answers", BufferKind::Device, size)).unwrap();
    let constants = Constants {
        inputs: inputs_buffer.address(),
        answers: answers.address(),
        count: inputs.len() as u32,
        width: width as u32,
    };
    let groups = [inputs.len().div_ceil(64) as u32, 1, 1];
    gpu.run(|commands| commands.compute(&pipeline, &[], &constants, groups)).unwrap();
    let words = bytemuck::pod_collect_to_vec(&gpu.download_buffer(&answers).unwrap());
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
    words
}

fn compile() -> Vec<u32> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var("GLSLC").unwrap_or_else(|_| "glslc".to_owned());
    let output = Command::new(compiler)
        .args(["--target-env=vulkan1.2", "-O", "-Werror", "-o", "-"])
        .arg("-I")
        .arg(root.join("../../shaders/include"))
        .arg(root.join("tests/shaders/evaluate.comp"))
        .output()
        .expect("glslc runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    bytemuck::pod_collect_to_vec(&output.stdout)
}
