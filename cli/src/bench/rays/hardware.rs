//! The driver's structures: rays through them by a ray-tracing pipeline, and what it costs to build them.

use std::time::Instant;

use afterglow_gpu::{
    AccelerationStructure, Access, Buffer, BuildScratch, Commands, Gpu, GpuError, GpuTimer, HitGroup,
    RayPipeline, RayPipelineDesc, STRUCTURE_INPUT, StructureBuild, StructureGeometry, StructureInput,
    StructureInstance, StructureShape, StructureSizes, StructureUse,
};
use afterglow_shaders::{BENCH_HARDWARE_RGEN, TRACE_RCHIT, TRACE_RMISS};
use serde::Serialize;

use super::build::LEAST;
use super::structure::{Batch, Constants, Structure};
use super::subject::Subject;
use crate::failure::Failure;

/// Least runs of a figure.
const LEAST_RUNS: u32 = 3;

const IDENTITY: [[f32; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// Figures of the driver's bottom level, on the device's own clock.
#[derive(Debug, Serialize)]
pub struct DriverRow {
    /// Millions of triangles a second, of what is built fast and can be updated.
    pub fast_mtriangles: f64,
    /// The same of what is traced fast and can be made smaller.
    pub good_mtriangles: f64,
    /// The same of an update of the former.
    pub update_mtriangles: f64,
    /// Bytes on the device of the former.
    pub fast_bytes_a_triangle: f64,
    /// The same of the latter, once it is compacted: it is what rays go through.
    pub good_bytes_a_triangle: f64,
}

/// What a closed ray pipeline goes through: one instance of a mesh.
pub struct Hardware {
    closest: RayPipeline,
    any: RayPipeline,
    top: AccelerationStructure,
    _bottom: AccelerationStructure,
}

/// The driver's structure of a mesh and its figures.
///
/// # Errors
/// [`GpuError::Unsupported`] on a device without ray-tracing pipelines, [`GpuError::Invalid`] for more triangles than it
/// takes.
pub fn measure(gpu: &Gpu, subject: &Subject) -> Result<(Hardware, DriverRow), Failure> {
    let mut builder = Builder::new(gpu)?;
    let corners = corners(subject);
    let corners = gpu.upload_buffer("corners", STRUCTURE_INPUT, bytemuck::cast_slice(&corners))?;
    let geometry = [StructureGeometry {
        shape: StructureShape::Triangles,
        address: corners.address(),
        count: subject.triangle_count() as u32,
        is_opaque: true,
    }];
    let input = StructureInput::BottomLevel(&geometry);
    let (fast, changing) = builder.build(input, StructureUse::Changing)?;
    let update = builder.update(&changing, input)?;
    let fast_bytes = changing.size();
    drop(changing);
    let (good, lasting) = builder.build(input, StructureUse::Lasting)?;
    let bottom = builder.compacted(&lasting)?;
    let count = subject.triangle_count().max(1) as f64;
    let mtriangles = |seconds: f64| count / seconds * 1e-6;
    let row = DriverRow {
        fast_mtriangles: mtriangles(fast),
        good_mtriangles: mtriangles(good),
        update_mtriangles: mtriangles(update),
        fast_bytes_a_triangle: fast_bytes as f64 / count,
        good_bytes_a_triangle: bottom.size() as f64 / count,
    };
    Ok((Hardware::new(gpu, &mut builder, bottom)?, row))
}

/// Three corners a triangle. Drivers take no numbers that are none: such a triangle becomes a point.
fn corners(subject: &Subject) -> Vec<[[f32; 3]; 3]> {
    let (positions, indices) = &subject.mesh;
    let triangle = |corners: &[u32; 3]| {
        // The mesh's reader has checked that corners are there.
        let placed = corners.map(|corner| positions[corner as usize]);
        let is_finite = placed.as_flattened().iter().all(|along| along.is_finite());
        if is_finite { placed } else { [[0.0; 3]; 3] }
    };
    indices.iter().map(triangle).collect()
}

impl Hardware {
    fn new(gpu: &Gpu, builder: &mut Builder, bottom: AccelerationStructure) -> Result<Self, Failure> {
        let instance = [StructureInstance::new(IDENTITY, bottom.address(), 0, 1, 0)];
        let instance: Buffer =
            gpu.upload_buffer("instance", STRUCTURE_INPUT, bytemuck::cast_slice(&instance))?;
        let input = StructureInput::TopLevel { address: instance.address(), count: 1 };
        let (_, top) = builder.build(input, StructureUse::Lasting)?;
        // The renderer's own shaders: a hit's primitive is the triangle's number, there being one geometry.
        let hits = [HitGroup { closest_hit: Some(TRACE_RCHIT), ..HitGroup::default() }];
        let pipeline = |any_hit: u32| {
            gpu.create_ray_pipeline(&RayPipelineDesc {
                name: "hardware",
                ray_generation: BENCH_HARDWARE_RGEN,
                miss: TRACE_RMISS,
                hits: &hits,
                push_constant_bytes: size_of::<Constants>() as u32,
                set_layouts: &[],
                specialization: &[(0, any_hit)],
            })
        };
        Ok(Self { closest: pipeline(0)?, any: pipeline(1)?, top, _bottom: bottom })
    }
}

impl Structure for Hardware {
    fn name(&self) -> &str {
        "hardware"
    }

    fn trace(&self, commands: &Commands<'_>, batch: Batch, any_hit: bool) {
        let pipeline = if any_hit { &self.any } else { &self.closest };
        let size = [batch.width, batch.count / batch.width.max(1)];
        let constants = Constants { structure: self.top.address(), batch };
        commands.trace_rays(pipeline, &[], &constants, size);
    }
}

/// Builds structures and says how long the device takes.
struct Builder {
    gpu: Gpu,
    timer: GpuTimer,
    scratch: BuildScratch,
}

impl Builder {
    fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        // Each build is alone: the scratch memory is what it needs.
        Ok(Self { gpu: gpu.clone(), timer: gpu.create_timer(1)?, scratch: gpu.create_build_scratch(0)? })
    }

    /// The least seconds of a build, and what is built.
    fn build(
        &mut self,
        input: StructureInput<'_>,
        structure_use: StructureUse,
    ) -> Result<(f64, AccelerationStructure), Failure> {
        let StructureSizes { structure, build, .. } = self.gpu.structure_sizes(input, structure_use)?;
        let is_top_level = matches!(input, StructureInput::TopLevel { .. });
        let target = self.gpu.create_structure("bench", is_top_level, structure)?;
        let seconds = self.least_time(&StructureBuild {
            target: &target,
            input,
            structure_use,
            is_update: false,
            scratch_bytes: build,
        })?;
        Ok((seconds, target))
    }

    /// The least seconds of an update of what was built as [`StructureUse::Changing`].
    fn update(&mut self, target: &AccelerationStructure, input: StructureInput<'_>) -> Result<f64, Failure> {
        let structure_use = StructureUse::Changing;
        let scratch_bytes = self.gpu.structure_sizes(input, structure_use)?.update;
        self.least_time(&StructureBuild { target, input, structure_use, is_update: true, scratch_bytes })
    }

    fn least_time(&mut self, build: &StructureBuild<'_>) -> Result<f64, Failure> {
        self.scratch.reserve(std::iter::once(build.scratch_bytes))?;
        let began = Instant::now();
        let mut least = f64::INFINITY;
        let mut runs = 0;
        while runs < LEAST_RUNS || began.elapsed() < LEAST {
            self.gpu.run(|commands| {
                self.timer.restart(commands);
                let scope = self.timer.begin(commands, "build");
                commands.build_structures(&[*build], &self.scratch);
                commands.memory_barrier(Access::ALL, Access::ALL);
                self.timer.end(commands, scope);
            })?;
            let nanoseconds = self.timer.results()?.first().map_or(0, |timing| timing.nanoseconds);
            if nanoseconds == 0 {
                return Err(Failure::Check("the device tells no time".to_owned()));
            }
            least = least.min(nanoseconds as f64 * 1e-9);
            runs += 1;
        }
        Ok(least)
    }

    /// A structure as small as it can be made.
    fn compacted(&self, lasting: &AccelerationStructure) -> Result<AccelerationStructure, Failure> {
        let sizes = self.gpu.create_compacted_sizes(1)?;
        self.gpu.run(|commands| commands.write_compacted_sizes(&sizes, &[lasting]))?;
        let bytes = sizes.get()?.and_then(|sizes| sizes.first().copied());
        let bytes = bytes.filter(|bytes| (1..=lasting.size()).contains(bytes)).unwrap_or(lasting.size());
        let small = self.gpu.create_structure("bench", false, bytes)?;
        self.gpu.run(|commands| {
            commands.compact_structure(lasting, &small);
            commands.memory_barrier(Access::ALL, Access::ALL);
        })?;
        Ok(small)
    }
}
