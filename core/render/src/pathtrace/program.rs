//! A pass that shoots rays, as a compute pipeline or as a ray-tracing pipeline.

use std::sync::OnceLock;

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
pub(crate) struct ProgramDesc {
    pub(crate) name: &'static str,
    /// `PASS.comp`.
    pub(crate) compute: &'static [u32],
    /// `PASS.rgen`.
    pub(crate) generation: &'static [u32],
}

/// A pipeline whose invocations are the picture's pixels.
pub(crate) enum Program {
    Software {
        /// For worlds of triangles alone: rays are faster where nothing can be a sphere.
        pipeline: ComputePipeline,
        /// For all worlds; made for the first one that holds spheres.
        with_spheres: OnceLock<ComputePipeline>,
        name: &'static str,
        spirv: &'static [u32],
    },
    Hardware(RayPipeline),
}

impl Program {
    pub(crate) fn new(
        gpu: &Gpu,
        table: &BindlessTable,
        backend: Backend,
        desc: &ProgramDesc,
    ) -> Result<Self, GpuError> {
        match backend {
            Backend::Software => Ok(Self::Software {
                pipeline: software(gpu, table, desc.name, desc.compute, false)?,
                with_spheres: OnceLock::new(),
                name: desc.name,
                spirv: desc.compute,
            }),
            Backend::Hardware => gpu
                .create_ray_pipeline(&RayPipelineDesc {
                    name: desc.name,
                    ray_generation: shaders::current(desc.generation),
                    miss: shaders::current(shaders::TRACE_RMISS),
                    hits: &hit_groups(),
                    specialization: &[],
                    set_layouts: &[table.layout()],
                    push_constant_bytes: size_of::<ViewPush>() as u32,
                })
                .map(Self::Hardware),
        }
    }

    /// Makes what it needs for a world; to be called before [`Self::run`].
    pub(crate) fn make_ready(
        &self,
        gpu: &Gpu,
        table: &BindlessTable,
        has_spheres: bool,
    ) -> Result<(), GpuError> {
        if let Self::Software { with_spheres, name, spirv, .. } = self
            && has_spheres
            && with_spheres.get().is_none()
        {
            let pipeline = software(gpu, table, name, spirv, true)?;
            with_spheres.get_or_init(|| pipeline);
        }
        Ok(())
    }

    /// Runs it for every pixel.
    pub(crate) fn run(
        &self,
        commands: &Commands<'_>,
        table: &BindlessTable,
        push: &ViewPush,
        size: [u32; 2],
        has_spheres: bool,
    ) {
        match self {
            Self::Software { pipeline, with_spheres, .. } => {
                let special = if has_spheres { with_spheres.get() } else { None };
                run(commands, table, special.unwrap_or(pipeline), push, pixel_groups(size));
            }
            Self::Hardware(pipeline) => commands.trace_rays(pipeline, &[table.set()], push, size),
        }
    }
}

/// `HAS_SPHERES` of `shaders/include/trace.glsl` is constant 0.
fn software(
    gpu: &Gpu,
    table: &BindlessTable,
    name: &str,
    spirv: &'static [u32],
    has_spheres: bool,
) -> Result<ComputePipeline, GpuError> {
    let whole_units = u32::from(gpu.info().kind != DeviceKind::Cpu);
    gpu.create_compute_pipeline(&ComputeDesc {
        name,
        spirv: shaders::current(spirv),
        entry: c"main",
        specialization: &[(0, u32::from(has_spheres)), (WHOLE_UNITS_CONSTANT, whole_units)],
        set_layouts: &[table.layout()],
        push_constant_bytes: size_of::<ViewPush>() as u32,
    })
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
