//! What rays are traced through. A backend is measured by implementing [`Structure`].

use afterglow_bvh::layout::WHOLE_UNITS_CONSTANT;
use afterglow_bvh::{Blas, IDENTITY, Instance, build_tlas};
use afterglow_gpu::{Buffer, Commands, ComputeDesc, ComputePipeline, DeviceKind, Gpu, GpuError, vk};
use afterglow_shaders::{BENCH_BINARY_COMP, BENCH_WIDE_COMP};
use bytemuck::{NoUninit, Pod, Zeroable};

use super::binary;
use super::subject::Subject;
use crate::failure::Failure;

/// Rays to trace: addresses of `RayRecord`s and `Answer`s, as `shaders/include/bench/rays.glsl` has them.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Batch {
    /// Where the rays are.
    pub rays: u64,
    /// Where their answers go.
    pub answers: u64,
    /// How many.
    pub count: u32,
    /// Of the picture that they are pixels of, in pixels.
    pub width: u32,
}

/// Something built that rays go through.
pub trait Structure {
    /// How it is called in the report.
    fn name(&self) -> &str;

    /// Records the tracing of a batch: the closest hits, or any.
    fn trace(&self, commands: &Commands<'_>, batch: Batch, any_hit: bool);
}

/// The two-level hierarchy that the renderer uses, one instance in it.
pub struct Wide {
    top: Buffer,
    _bottom: Buffer,
    programs: Programs,
}

impl Wide {
    /// Uploads a bottom level and one instance of it.
    pub fn new(gpu: &Gpu, blas: &Blas) -> Result<Self, Failure> {
        let bottom = upload(gpu, &blas.words)?;
        let instance = Instance {
            object_to_world: IDENTITY,
            blas: bottom.address(),
            bounds: blas.bounds,
            id: 0,
            mask: 1,
            flags: 0,
        };
        let tlas = build_tlas(&[instance]).map_err(|error| Failure::Check(error.to_string()))?;
        let top = upload(gpu, &tlas.words)?;
        Ok(Self { top, _bottom: bottom, programs: Programs::new(gpu, "wide", BENCH_WIDE_COMP)? })
    }
}

impl Structure for Wide {
    fn name(&self) -> &str {
        "software"
    }

    fn trace(&self, commands: &Commands<'_>, batch: Batch, any_hit: bool) {
        self.programs.run(commands, self.top.address(), batch, any_hit);
    }
}

/// A plain binary hierarchy.
pub struct Plain {
    nodes: Buffer,
    programs: Programs,
}

impl Plain {
    /// Builds and uploads it.
    pub fn new(gpu: &Gpu, subject: &Subject) -> Result<Self, Failure> {
        let (positions, indices) = &subject.mesh;
        let nodes = upload(gpu, &binary::build(positions, indices))?;
        Ok(Self { nodes, programs: Programs::new(gpu, "binary", BENCH_BINARY_COMP)? })
    }
}

impl Structure for Plain {
    fn name(&self) -> &str {
        "binary"
    }

    fn trace(&self, commands: &Commands<'_>, batch: Batch, any_hit: bool) {
        self.programs.run(commands, self.nodes.address(), batch, any_hit);
    }
}

/// A shader for the closest hit, and for any.
struct Programs {
    closest: ComputePipeline,
    any: ComputePipeline,
}

/// Push constants of all kernels: what is gone through, and what for.
#[repr(C)]
#[derive(Clone, Copy, NoUninit)]
pub struct Constants {
    /// Its address.
    pub structure: u64,
    /// The rays.
    pub batch: Batch,
}

impl Programs {
    fn new(gpu: &Gpu, name: &str, spirv: &[u32]) -> Result<Self, GpuError> {
        let program = |any_hit: u32| {
            let desc = ComputeDesc::new(name, spirv).push_constants(size_of::<Constants>() as u32);
            let whole_units = u32::from(gpu.info().kind != DeviceKind::Cpu);
            let constants = [(0, any_hit), (WHOLE_UNITS_CONSTANT, whole_units)];
            gpu.create_compute_pipeline(&desc.specialization(&constants))
        };
        Ok(Self { closest: program(0)?, any: program(1)? })
    }

    fn run(&self, commands: &Commands<'_>, structure: u64, batch: Batch, any_hit: bool) {
        let program = if any_hit { &self.any } else { &self.closest };
        let groups = [batch.count.div_ceil(64), 1, 1];
        commands.compute(program, &[], &Constants { structure, batch }, groups);
    }
}

fn upload(gpu: &Gpu, words: &[u32]) -> Result<Buffer, GpuError> {
    gpu.upload_buffer("structure", vk::BufferUsageFlags::empty(), bytemuck::cast_slice(words))
}
