//! Rays on a device.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

use afterglow_gpu::{Buffer, BufferDesc, BufferKind, ComputeDesc, ComputePipeline, Gpu, GpuOptions, vk};
use bytemuck::{Pod, Zeroable};
use std::path::Path;
use std::process::Command;

/// A ray as `bench/rays.glsl` has it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct RayRecord {
    pub origin: [f32; 3],
    pub t_min: f32,
    pub direction: [f32; 3],
    pub t_max: f32,
}

/// An answer as `bench/rays.glsl` has it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Answer {
    pub t: f32,
    pub barycentrics: [f32; 2],
    pub primitive: u32,
    pub instance: u32,
    pub found_and_front: u32,
}

impl Answer {
    pub fn found(&self) -> bool {
        self.found_and_front & 1 != 0
    }
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Constants {
    structure: u64,
    rays: u64,
    answers: u64,
    count: u32,
    mask: u32,
    any_hit: u32,
    padding: u32,
}

/// What rays look for, beside the structure.
#[derive(Clone, Copy)]
pub struct Search {
    pub mask: u32,
    pub any_hit: bool,
}

/// A device with a shader that traces one ray a thread.
pub struct Tracer {
    pub gpu: Gpu,
    pipeline: ComputePipeline,
}

impl Tracer {
    /// Compiles `shader` (a path from this crate) with `glslc`.
    pub fn new(gpu: &Gpu, shader: &str) -> Self {
        let spirv = compile(shader);
        let desc = ComputeDesc::new("rays", &spirv).push_constants(size_of::<Constants>() as u32);
        Self { gpu: gpu.clone(), pipeline: gpu.create_compute_pipeline(&desc).unwrap() }
    }

    /// Uploads words, aligned as structures must be.
    pub fn upload(&self, words: &[u32]) -> Buffer {
        let bytes = bytemuck::cast_slice(words);
        let usage = vk::BufferUsageFlags::empty();
        let buffer = self.gpu.upload_buffer("structure", usage, bytes).unwrap();
        assert_eq!(buffer.address() % 16, 0);
        buffer
    }

    /// Traces `rays` through the structure at `address`.
    pub fn trace(&self, address: u64, rays: &[RayRecord], search: Search) -> Vec<Answer> {
        let rays_buffer = self.upload(bytemuck::cast_slice(rays));
        let size = size_of_val(rays) as u64 / 32 * size_of::<Answer>() as u64;
        let desc = BufferDesc::new("answers", BufferKind::Device, size);
        let answers = self.gpu.create_buffer(&desc).unwrap();
        let constants = Constants {
            structure: address,
            rays: rays_buffer.address(),
            answers: answers.address(),
            count: rays.len() as u32,
            mask: search.mask,
            any_hit: u32::from(search.any_hit),
            padding: 0,
        };
        let groups = [rays.len().div_ceil(64) as u32, 1, 1];
        self.gpu.run(|commands| commands.compute(&self.pipeline, &[], &constants, groups)).unwrap();
        let bytes = self.gpu.download_buffer(&answers).unwrap();
        bytemuck::pod_collect_to_vec(&bytes)
    }
}

/// The device that the environment names, or lavapipe.
pub fn open() -> Gpu {
    Gpu::new(&GpuOptions::for_tests()).unwrap()
}

fn compile(shader: &str) -> Vec<u32> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var("GLSLC").unwrap_or_else(|_| "glslc".to_owned());
    let output = Command::new(compiler)
        .args(["--target-env=vulkan1.2", "-O", "-Werror", "-o", "-"])
        .arg("-I")
        .arg(root.join("../../shaders/include"))
        .arg(root.join(shader))
        .output()
        .expect("glslc runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    bytemuck::pod_collect_to_vec(&output.stdout)
}
