//! Rays made on the device, and how long structures take for them.

use std::time::{Duration, Instant};

use afterglow_gpu::{
    Access, Buffer, BufferDesc, BufferKind, Commands, ComputeDesc, ComputePipeline, Gpu, GpuError, vk,
};
use afterglow_shaders::{BENCH_CAMERA_COMP, BENCH_SCATTER_COMP};
use bytemuck::{NoUninit, Pod, Zeroable};

use super::rows::{RayRow, StructureRow};
use super::structure::{Batch, Structure};
use super::subject::Subject;
use crate::failure::Failure;

/// Bytes of a ray.
const RAY_BYTES: u64 = 32;
/// Least and most runs of a figure.
const RUNS: (usize, usize) = (3, 1000);

/// An answer, as `shaders/include/bench/rays.glsl` has it.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Answer {
    t: f32,
    barycentrics: [f32; 2],
    primitive: u32,
    instance: u32,
    found_and_front: u32,
}

#[repr(C)]
#[derive(Clone, Copy, NoUninit)]
struct CameraConstants {
    rays: u64,
    size: [u32; 2],
    eye: [f32; 3],
    right: [f32; 3],
    up: [f32; 3],
    forward: [f32; 3],
}

#[repr(C)]
#[derive(Clone, Copy, NoUninit)]
struct ScatterConstants {
    primary: u64,
    answers: u64,
    positions: u64,
    indices: u64,
    scattered: u64,
    count: u32,
    to_lamp: u32,
    lamp: [f32; 3],
    padding: u32,
}

/// Makes rays and times them.
pub struct Caster {
    camera: ComputePipeline,
    scatter: ComputePipeline,
    answers: Buffer,
    size: [u32; 2],
    time: Duration,
}

/// Rays of three kinds.
pub struct Rays {
    kinds: [(&'static str, Buffer, bool); 3],
    /// Rays that meet the mesh's surface or start there.
    alive: u32,
}

impl Caster {
    /// For `size` rays of a kind, `time` milliseconds a figure.
    pub fn new(gpu: &Gpu, size: [u32; 2], time: u32) -> Result<Self, GpuError> {
        let program = |name, spirv, bytes: usize| {
            gpu.create_compute_pipeline(&ComputeDesc::new(name, spirv).push_constants(bytes as u32))
        };
        let answers_bytes = u64::from(size[0] * size[1]) * size_of::<Answer>() as u64;
        Ok(Self {
            camera: program("camera", BENCH_CAMERA_COMP, size_of::<CameraConstants>())?,
            scatter: program("scatter", BENCH_SCATTER_COMP, size_of::<ScatterConstants>())?,
            answers: gpu.create_buffer(&BufferDesc::new("answers", BufferKind::Device, answers_bytes))?,
            size,
            time: Duration::from_millis(time.into()),
        })
    }

    fn count(&self) -> u32 {
        self.size[0] * self.size[1]
    }

    fn batch(&self, rays: &Buffer) -> Batch {
        Batch { rays: rays.address(), answers: self.answers.address(), count: self.count(), padding: 0 }
    }

    /// The camera's rays, and those that go on from where `structure` says that they end.
    pub fn make_rays(
        &self,
        gpu: &Gpu,
        subject: &Subject,
        structure: &dyn Structure,
    ) -> Result<Rays, Failure> {
        let desc = BufferDesc::new("rays", BufferKind::Device, u64::from(self.count()) * RAY_BYTES);
        let (primary, shadow, bounce) =
            (gpu.create_buffer(&desc)?, gpu.create_buffer(&desc)?, gpu.create_buffer(&desc)?);
        let upload = |bytes| gpu.upload_buffer("mesh", vk::BufferUsageFlags::empty(), bytes);
        let positions = upload(bytemuck::cast_slice(&subject.mesh.0))?;
        let indices = upload(bytemuck::cast_slice(&subject.mesh.1))?;
        let groups = [self.count() / 64, 1, 1];
        let scatter = |commands: &Commands<'_>, to: &Buffer, to_lamp: bool| {
            let constants = ScatterConstants {
                primary: primary.address(),
                answers: self.answers.address(),
                positions: positions.address(),
                indices: indices.address(),
                scattered: to.address(),
                count: self.count(),
                to_lamp: u32::from(to_lamp),
                lamp: subject.lamp.to_array(),
                padding: 0,
            };
            commands.compute(&self.scatter, &[], &constants, groups);
        };
        gpu.run(|commands| {
            commands.compute(&self.camera, &[], &self.camera_constants(subject, &primary), groups);
            wait(commands);
            structure.trace(commands, self.batch(&primary), false);
            wait(commands);
            scatter(commands, &shadow, true);
            scatter(commands, &bounce, false);
            wait(commands);
        })?;
        let alive = (self.found_share(gpu)? * f64::from(self.count())).round() as u32;
        Ok(Rays {
            kinds: [("primary", primary, false), ("shadow", shadow, true), ("bounce", bounce, false)],
            alive,
        })
    }

    fn camera_constants(&self, subject: &Subject, rays: &Buffer) -> CameraConstants {
        let right = subject.forward.cross(glam::Vec3::Y).normalize_or(glam::Vec3::X);
        let up = right.cross(subject.forward) * (self.size[1] as f32 / self.size[0] as f32);
        CameraConstants {
            rays: rays.address(),
            size: self.size,
            eye: subject.eye.to_array(),
            right: right.to_array(),
            up: up.to_array(),
            forward: subject.forward.to_array(),
        }
    }

    /// Times one structure with all kinds of rays.
    pub fn measure(
        &self,
        gpu: &Gpu,
        structure: &dyn Structure,
        rays: &Rays,
    ) -> Result<StructureRow, Failure> {
        let mut row = StructureRow { structure: structure.name().to_owned(), rays: Vec::new() };
        for (kind, buffer, any_hit) in &rays.kinds {
            let mut seconds = self.time_runs(gpu, structure, self.batch(buffer), *any_hit)?;
            seconds.sort_by(f64::total_cmp);
            // Rays that start nowhere are no rays.
            let count = if *kind == "primary" { self.count() } else { rays.alive };
            let mrays = |seconds: f64| f64::from(count) / seconds * 1e-6;
            row.rays.push(RayRow {
                kind,
                best_mrays: mrays(seconds[0]),
                median_mrays: mrays(seconds[seconds.len() / 2]),
                hit_share: self.found_share(gpu)? * f64::from(self.count()) / f64::from(count.max(1)),
                runs: seconds.len(),
            });
        }
        Ok(row)
    }

    /// Seconds of each of several runs, after one that is not counted.
    fn time_runs(
        &self,
        gpu: &Gpu,
        structure: &dyn Structure,
        batch: Batch,
        any_hit: bool,
    ) -> Result<Vec<f64>, Failure> {
        let mut timer = gpu.create_timer(1)?;
        let mut seconds = Vec::new();
        let mut began = Instant::now();
        for run in 0..=RUNS.1 {
            gpu.run(|commands| {
                timer.restart(commands);
                let scope = timer.begin(commands, "rays");
                structure.trace(commands, batch, any_hit);
                timer.end(commands, scope);
                wait(commands);
            })?;
            if run == 0 {
                began = Instant::now();
                continue;
            }
            let timing = timer.results()?;
            let Some(timing) = timing.first().filter(|timing| timing.nanoseconds > 0) else {
                return Err(Failure::Check("the device tells no time".to_owned()));
            };
            seconds.push(timing.nanoseconds as f64 * 1e-9);
            if seconds.len() >= RUNS.0 && began.elapsed() >= self.time {
                break;
            }
        }
        Ok(seconds)
    }

    /// The share of the last answers that are hits.
    fn found_share(&self, gpu: &Gpu) -> Result<f64, GpuError> {
        let answers: Vec<Answer> = bytemuck::pod_collect_to_vec(&gpu.download_buffer(&self.answers)?);
        let found = answers.iter().filter(|answer| answer.found_and_front & 1 != 0).count();
        Ok(found as f64 / answers.len().max(1) as f64)
    }
}

fn wait(commands: &Commands<'_>) {
    commands.memory_barrier(Access::ALL, Access::ALL);
}
