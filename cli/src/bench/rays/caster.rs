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
const RUNS: (u32, u32) = (3, 1000);

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
        Batch {
            rays: rays.address(),
            answers: self.answers.address(),
            count: self.count(),
            width: self.size[0],
        }
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
        let groups = [self.count().div_ceil(64), 1, 1];
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
        let answers: Vec<Answer> = bytemuck::pod_collect_to_vec(&gpu.download_buffer(&self.answers)?);
        let alive = answers.iter().filter(|answer| answer.found()).count() as u32;
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

    /// Times structures with all kinds of rays; they take turns, so that a device whose clock changes is fair to all.
    /// The first one is who the others are compared with.
    pub fn measure(
        &self,
        gpu: &Gpu,
        structures: &[&dyn Structure],
        rays: &Rays,
    ) -> Result<Vec<StructureRow>, Failure> {
        let row = |structure: &&dyn Structure| StructureRow {
            structure: structure.name().to_owned(),
            rays: Vec::new(),
        };
        let mut rows: Vec<StructureRow> = structures.iter().map(row).collect();
        for (kind, buffer, any_hit) in &rays.kinds {
            let batch = self.batch(buffer);
            let mut seconds = self.time_rounds(gpu, structures, batch, *any_hit)?;
            // Rays that start nowhere are no rays.
            let count = f64::from(if *kind == "primary" { self.count() } else { rays.alive });
            let mut expected = Vec::new();
            for (number, row) in rows.iter_mut().enumerate() {
                seconds[number].sort_by(f64::total_cmp);
                let seconds = &seconds[number];
                let mrays = |seconds: f64| count / seconds * 1e-6;
                let answers = self.answers_of(gpu, structures[number], batch, *any_hit)?;
                if number == 0 {
                    expected = answers.clone();
                }
                let found = answers.iter().filter(|answer| answer.found()).count();
                let differing = answers.iter().zip(&expected).filter(|(a, b)| a.differs(b, *any_hit)).count();
                row.rays.push(RayRow {
                    kind,
                    best_mrays: mrays(seconds[0]),
                    median_mrays: mrays(seconds[seconds.len() / 2]),
                    hit_share: found as f64 / count.max(1.0),
                    differing,
                    runs: seconds.len(),
                });
            }
        }
        Ok(rows)
    }

    /// Seconds of each structure's runs, after one of each that is not counted.
    fn time_rounds(
        &self,
        gpu: &Gpu,
        structures: &[&dyn Structure],
        batch: Batch,
        any_hit: bool,
    ) -> Result<Vec<Vec<f64>>, Failure> {
        let mut timer = gpu.create_timer(structures.len() as u32)?;
        let mut seconds = vec![Vec::new(); structures.len()];
        let mut began = Instant::now();
        for round in 0..=RUNS.1 {
            gpu.run(|commands| {
                timer.restart(commands);
                for structure in structures {
                    let scope = timer.begin(commands, structure.name());
                    structure.trace(commands, batch, any_hit);
                    wait(commands);
                    timer.end(commands, scope);
                }
            })?;
            if round == 0 {
                began = Instant::now();
                continue;
            }
            let timings = timer.results()?;
            if timings.len() < structures.len() || timings.iter().any(|timing| timing.nanoseconds == 0) {
                return Err(Failure::Check("the device tells no time".to_owned()));
            }
            for (seconds, timing) in seconds.iter_mut().zip(&timings) {
                seconds.push(timing.nanoseconds as f64 * 1e-9);
            }
            if round >= RUNS.0 && began.elapsed() >= self.time * structures.len() as u32 {
                break;
            }
        }
        Ok(seconds)
    }

    /// What a structure answers.
    fn answers_of(
        &self,
        gpu: &Gpu,
        structure: &dyn Structure,
        batch: Batch,
        any_hit: bool,
    ) -> Result<Vec<Answer>, GpuError> {
        gpu.run(|commands| structure.trace(commands, batch, any_hit))?;
        Ok(bytemuck::pod_collect_to_vec(&gpu.download_buffer(&self.answers)?))
    }
}

impl Answer {
    fn found(&self) -> bool {
        self.found_and_front & 1 != 0
    }

    /// Whether two answers to the same ray are different ones: of ties and of rays at edges a few are.
    fn differs(&self, other: &Self, any_hit: bool) -> bool {
        let (found, near) = (self.found(), (self.t - other.t).abs() <= 1e-4 * other.t.abs().max(1e-3));
        found != other.found() || (found && !any_hit && !near)
    }
}

fn wait(commands: &Commands<'_>) {
    commands.memory_barrier(Access::ALL, Access::ALL);
}
