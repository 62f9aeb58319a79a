//! The compute pipelines of a view's passes.

use afterglow_gpu::{BindlessTable, Commands, ComputeDesc, ComputePipeline, Gpu, GpuError};
use afterglow_records::ViewPush;
use afterglow_shaders as shaders;

/// Pixels along a side of a workgroup.
const GROUP_EDGE: u32 = 8;

/// One pipeline a pass.
pub(crate) struct TracePipelines {
    pub(crate) surface: ComputePipeline,
    pub(crate) light: ComputePipeline,
    pub(crate) reference: ComputePipeline,
    pub(crate) filter: ComputePipeline,
    pub(crate) sum: ComputePipeline,
    pub(crate) exposure: ComputePipeline,
    pub(crate) composite: ComputePipeline,
}

impl TracePipelines {
    pub(crate) fn new(gpu: &Gpu, table: &BindlessTable) -> Result<Self, GpuError> {
        let sets = [table.layout()];
        let pipeline = |name, spirv| {
            gpu.create_compute_pipeline(&ComputeDesc {
                name,
                spirv: shaders::current(spirv),
                entry: c"main",
                specialization: &[],
                set_layouts: &sets,
                push_constant_bytes: size_of::<ViewPush>() as u32,
            })
        };
        Ok(Self {
            surface: pipeline("surface", shaders::SURFACE_COMP)?,
            light: pipeline("light", shaders::LIGHT_COMP)?,
            reference: pipeline("reference", shaders::REFERENCE_COMP)?,
            filter: pipeline("filter", shaders::FILTER_COMP)?,
            sum: pipeline("exposure sums", shaders::EXPOSURE_SUM_COMP)?,
            exposure: pipeline("exposure", shaders::EXPOSURE_COMP)?,
            composite: pipeline("composite", shaders::COMPOSITE_COMP)?,
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
