//! The pipelines of a view's passes.

use afterglow_gpu::{BindlessTable, Commands, ComputeDesc, ComputePipeline, Gpu, GpuError};
use afterglow_records::{SkyPush, ViewPush};
use afterglow_shaders as shaders;

use super::backend::Backend;
use super::program::{Program, ProgramDesc};

/// Pixels along a side of a workgroup.
const GROUP_EDGE: u32 = 8;

/// One pipeline a pass.
pub(crate) struct TracePipelines {
    /// A level of the map of the sky.
    pub(crate) sky: ComputePipeline,
    pub(crate) surface: ComputePipeline,
    pub(crate) reservoir: ComputePipeline,
    pub(crate) light: Program,
    pub(crate) reference: Program,
    pub(crate) sum: ComputePipeline,
    pub(crate) exposure: ComputePipeline,
    pub(crate) composite: ComputePipeline,
    pub(crate) edges: ComputePipeline,
}

impl TracePipelines {
    /// # Errors
    /// If the device lacks the backend.
    pub(crate) fn new(gpu: &Gpu, table: &BindlessTable, backend: Backend) -> Result<Self, GpuError> {
        backend.require(gpu)?;
        let sets = [table.layout()];
        let with_push = |name, spirv, push_constant_bytes| {
            gpu.create_compute_pipeline(&ComputeDesc {
                name,
                spirv: shaders::current(spirv),
                entry: c"main",
                specialization: &[],
                set_layouts: &sets,
                push_constant_bytes,
            })
        };
        let pipeline = |name, spirv| with_push(name, spirv, size_of::<ViewPush>() as u32);
        let program = |name, compute, generation| {
            Program::new(gpu, table, backend, &ProgramDesc { name, compute, generation })
        };
        Ok(Self {
            sky: with_push("sky map", shaders::SKY_COMP, size_of::<SkyPush>() as u32)?,
            surface: pipeline("surface", shaders::SURFACE_COMP)?,
            reservoir: pipeline("reservoir", shaders::RESERVOIR_COMP)?,
            light: program("light", shaders::LIGHT_COMP, shaders::LIGHT_RGEN)?,
            reference: program("reference", shaders::REFERENCE_COMP, shaders::REFERENCE_RGEN)?,
            sum: pipeline("exposure sums", shaders::EXPOSURE_SUM_COMP)?,
            exposure: pipeline("exposure", shaders::EXPOSURE_COMP)?,
            composite: pipeline("composite", shaders::COMPOSITE_COMP)?,
            edges: pipeline("edges", shaders::EDGES_COMP)?,
        })
    }
}

/// Runs a pipeline with so many workgroups.
pub(crate) fn run(
    commands: &Commands<'_>,
    table: &BindlessTable,
    pipeline: &ComputePipeline,
    push: &ViewPush,
    [across, down]: [u32; 2],
) {
    commands.compute(pipeline, &[table.set()], push, [across, down, 1]);
}

/// Workgroups of a thread a pixel.
pub(crate) fn pixel_groups(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(GROUP_EDGE))
}
