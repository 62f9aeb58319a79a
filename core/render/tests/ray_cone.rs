//! Ray cones: what `pathtrace/ray_cone.glsl` computes, on the processor and on a device.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

use std::f32::consts::{FRAC_1_SQRT_2, PI, TAU};
use std::path::Path as FilePath;
use std::process::Command;

use afterglow_gpu::{BufferDesc, BufferKind, ComputeDesc, Gpu, GpuOptions, vk};
use bytemuck::{Pod, Zeroable};

/// As `MOST_CONE_SPREAD`.
const MOST_SPREAD: f32 = 2.0;
/// As `LEAST_CONE_COSINE`.
const LEAST_COSINE: f32 = 0.0625;

/// The twin of the shader's `RayCone`.
#[derive(Debug, Clone, Copy)]
struct RayCone {
    width: f32,
    spread: f32,
}

impl RayCone {
    fn camera(pixel_spread: f32) -> Self {
        Self { width: 0.0, spread: pixel_spread }
    }

    fn travelled(self, away: f32) -> Self {
        Self { width: self.width + self.spread * away, ..self }
    }

    fn scattered(self, pdf: f32, samples: f32) -> Self {
        let share = 1.0 / (TAU * pdf * samples).max(1e-20);
        let cosine = (1.0 - share).max(FRAC_1_SQRT_2);
        let spread = 2.0 * (1.0 - cosine * cosine).max(0.0).sqrt() / cosine;
        Self { spread: self.spread.hypot(spread).min(MOST_SPREAD), ..self }
    }

    /// `cone_texels` of `cones_along`.
    fn texels(self, cosine: f32, area_world: f32, area_coordinates: f32) -> f32 {
        let width = self.width / cosine.abs().max(LEAST_COSINE);
        let cones = 0.5 * area_world.max(1e-20).log2() - width.max(1e-20).log2();
        cones - 0.5 * area_coordinates.max(1e-20).log2()
    }
}

/// A question to the shader: a ray, a bounce, another ray, a triangle.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Path {
    pixel_spread: f32,
    first: f32,
    pdf: f32,
    samples: f32,
    second: f32,
    cosine: f32,
    area_world: f32,
    area_coordinates: f32,
}

impl Path {
    /// Width, spread and texels at its end.
    fn answer(&self) -> [f32; 3] {
        let cone = RayCone::camera(self.pixel_spread).travelled(self.first);
        let cone = cone.scattered(self.pdf, self.samples).travelled(self.second);
        [cone.width, cone.spread, cone.texels(self.cosine, self.area_world, self.area_coordinates)]
    }
}

#[test]
fn a_pixel_on_a_wall_reads_a_texel_of_its_size() {
    // A wall of 2 by 2 units 10 away, its coordinates from 0 to 4; pixels 0.01 high at depth 1 are 0.1 high there.
    let cone = RayCone::camera(0.01).travelled(10.0);
    let texels = cone.texels(1.0, 4.0, 16.0).exp2();
    // A unit of coordinates is half a unit of the world: five pixels.
    assert!((texels - 5.0).abs() < 1e-3, "{texels}");
    // Seen obliquely, a pixel covers twice as much.
    assert!((cone.texels(0.5, 4.0, 16.0).exp2() - 2.5).abs() < 1e-3);
}

#[test]
fn levels_are_those_of_the_paper() {
    // Half the logarithm of the ratio of areas in texels and world units, and that of width by cosine.
    let (size, cone, cosine) = (256.0_f32, RayCone { width: 0.3, spread: 0.0 }, 0.4_f32);
    let (area_world, area_coordinates) = (3.0_f32, 0.7_f32);
    let level = 0.5 * (size * size * area_coordinates / area_world).log2() + (0.3 / cosine).log2();
    let own = size.log2() - cone.texels(cosine, area_world, area_coordinates);
    assert!((level - own).abs() < 1e-4, "{level} {own}");
}

#[test]
fn bounces_widen_cones_by_what_a_sample_stands_for() {
    let cone = RayCone::camera(0.002).travelled(5.0);
    let diffuse = cone.scattered(1.0 / PI, 1.0);
    assert_eq!(diffuse.spread, MOST_SPREAD);
    assert_eq!(diffuse.width, cone.width);
    // A mirror leaves the cone as it is, and so do many samples.
    assert!((cone.scattered(1e9, 1.0).spread - cone.spread).abs() < 1e-4);
    assert!(cone.scattered(1.0 / PI, 1e6).spread < 0.01);
    // A sample of a lobe of 0.01 steradians: 1 / 0.01 = pi tan^2, for small angles.
    let lobe = RayCone::camera(0.0).scattered(100.0, 1.0).spread;
    assert!((PI * (lobe / 2.0).powi(2) / 0.01 - 1.0).abs() < 0.01, "{lobe}");
}

#[test]
fn nothing_is_not_a_number() {
    for cone in [RayCone::camera(0.0), RayCone::camera(0.0).scattered(0.0, 0.0).travelled(0.0)] {
        for (cosine, area_world, area_coordinates) in [(0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (-1.0, 1.0, 0.0)] {
            assert!(cone.texels(cosine, area_world, area_coordinates).is_finite());
        }
    }
}

/// Push constants of the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Push {
    paths: u64,
    answers: u64,
    count: u32,
    padding: u32,
}

#[test]
fn a_device_computes_the_same() {
    let spread = |i: u32, axis: u32| {
        const STEPS: [f64; 8] = [0.754, 0.569, 0.430, 0.324, 0.245, 0.618, 0.707, 0.414];
        (f64::from(i + 1) * STEPS[axis as usize]).fract() as f32
    };
    let path = |i: u32| Path {
        pixel_spread: 0.02 * spread(i, 0),
        first: 100.0 * spread(i, 1),
        pdf: 10.0_f32.powf(6.0 * spread(i, 2) - 2.0),
        samples: 1.0 + (i % 5) as f32 * 100.0,
        second: 40.0 * spread(i, 3),
        cosine: 2.0 * spread(i, 4) - 1.0,
        area_world: 10.0 * spread(i, 5),
        area_coordinates: spread(i, 6),
    };
    let paths: Vec<Path> = (0..256).map(path).collect();
    let gpu = Gpu::new(&GpuOptions::for_tests()).unwrap();
    let answers = on_device(&gpu, &paths);
    for (path, answer) in paths.iter().zip(answers) {
        for (own, found) in path.answer().into_iter().zip(answer) {
            assert!((own - found).abs() <= 1e-3 * own.abs().max(1.0), "{path:?}: {own} {found}");
        }
    }
    assert_eq!(gpu.validation_count(), 0, "{:#?}", gpu.validation_messages());
}

fn on_device(gpu: &Gpu, paths: &[Path]) -> Vec<[f32; 3]> {
    let spirv = compile();
    let desc = ComputeDesc::new("ray cones", &spirv).push_constants(size_of::<Push>() as u32);
    let pipeline = gpu.create_compute_pipeline(&desc).unwrap();
    let asked = bytemuck::cast_slice(paths);
    let asked = gpu.upload_buffer("paths", vk::BufferUsageFlags::empty(), asked).unwrap();
    let desc = BufferDesc::new("answers", BufferKind::Device, 12 * paths.len() as u64);
    let answers = gpu.create_buffer(&desc).unwrap();
    let push =
        Push { paths: asked.address(), answers: answers.address(), count: paths.len() as u32, padding: 0 };
    gpu.run(|commands| commands.compute(&pipeline, &[], &push, [paths.len().div_ceil(64) as u32, 1, 1]))
        .unwrap();
    bytemuck::pod_collect_to_vec(&gpu.download_buffer(&answers).unwrap())
}

fn compile() -> Vec<u32> {
    let root = FilePath::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var("GLSLC").unwrap_or_else(|_| "glslc".to_owned());
    let output = Command::new(compiler)
        .args(["--target-env=vulkan1.2", "-O", "-Werror", "-o", "-", "-I"])
        .arg(root.join("../../shaders/include"))
        .arg(root.join("tests/shaders/ray_cone.comp"))
        .output()
        .expect("glslc runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    bytemuck::pod_collect_to_vec(&output.stdout)
}
