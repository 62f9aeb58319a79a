//! A pass that shoots rays, as a compute pipeline or as a ray-tracing pipeline.

use afterglow_bvh::layout::WHOLE_UNITS_CONSTANT;
use afterglow_gpu::{
    BindlessTable, Commands, ComputeDesc, ComputePipeline, DeviceKind, Gpu, GpuError, HitGroup, RayPipeline,
    RayPipelineDesc,
};
use afterglow_records::ViewPush;
use afterglow_shaders as shaders;

use super::backend::Backend;
use super::pipelines::{pixel_groups, run};

/// The two forms of one source: see `shaders/include/trace.glsl` for how a pass gets its second.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProgramDesc<'a> {
    pub(crate) name: &'a str,
    /// `PASS.comp`.
    pub(crate) compute: &'static [u32],
    /// `PASS.rgen`.
    pub(crate) generation: &'static [u32],
}

/// A pipeline whose invocations are the picture's pixels.
pub(crate) enum Program {
    Software(ComputePipeline),
    Hardware(RayPipeline),
}

impl Program {
    pub(crate) fn new(
        gpu: &Gpu,
        table: &BindlessTable,
        backend: Backend,
        desc: &ProgramDesc<'_>,
    ) -> Result<Self, GpuError> {
        let set_layouts = &[table.layout()];
        let push_constant_bytes = size_of::<ViewPush>() as u32;
        let whole_units = u32::from(gpu.info().kind != DeviceKind::Cpu);
        match backend {
            Backend::Software => gpu
                .create_compute_pipeline(&ComputeDesc {
                    name: desc.name,
                    spirv: shaders::current(desc.compute),
                    entry: c"main",
                    specialization: &[(WHOLE_UNITS_CONSTANT, whole_units)],
                    set_layouts,
                    push_constant_bytes,
                })
                .map(Self::Software),
            Backend::Hardware => gpu
                .create_ray_pipeline(&RayPipelineDesc {
                    name: desc.name,
                    ray_generation: shaders::current(desc.generation),
                    miss: shaders::current(shaders::TRACE_RMISS),
                    hits: &hit_groups(),
                    specialization: &[],
                    set_layouts,
                    push_constant_bytes,
                })
                .map(Self::Hardware),
        }
    }

    /// Runs it for every pixel.
    pub(crate) fn run(
        &self,
        commands: &Commands<'_>,
        table: &BindlessTable,
        push: &ViewPush,
        size: [u32; 2],
    ) {
        match self {
            Self::Software(pipeline) => run(commands, table, pipeline, push, pixel_groups(size)),
            Self::Hardware(pipeline) => commands.trace_rays(pipeline, &[table.set()], push, size),
        }
    }
}

/// By the kinds of meshes (`driver_input::Kind`): triangles, spheres.
fn hit_groups() -> [HitGroup<'static>; 2] {
    let [closest_hit, any_hit, intersection] =
        [shaders::TRACE_RCHIT, shaders::TRACE_RAHIT, shaders::TRACE_RINT]
            .map(|built| Some(shaders::current(built)));
    [
        HitGroup { closest_hit, any_hit, intersection: None },
        HitGroup { closest_hit, any_hit: None, intersection },
    ]
}
