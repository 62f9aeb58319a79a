//! `afterglow bench lights`: what many lights cost, and what choosing among them well is worth.
//!
//! A scene's lights are multiplied or thinned out, their power together staying the same. Each way to choose among them makes
//! pictures of a sample a pixel; they are compared with the picture that all samples together make. Time is the device's, of
//! the passes that choose lights and send rays. So that equal times are compared, equal chances get as many samples a pixel as
//! fit into the time of the others, rounded up.

use std::io::Write;
use std::path::{Path, PathBuf};

use afterglow_gpu::Gpu;
use afterglow_metrics::{Encoding, Image, pixelwise};
use afterglow_render::{LightChoice, Mode, PathtraceOptions, RenderOptions, Renderer};
use afterglow_scene::Relighting;
use afterglow_scene_file::{SceneFile, SphereLight, Stage};
use clap::Args;
use glam::DVec3;
use serde::Serialize;

use crate::failure::Failure;
use crate::options::{DeviceArguments, Size};
use crate::output;

/// Passes whose time counts.
const PASSES: [&str; 2] = ["reservoir", "light"];
/// Frames before those that are measured: pixels have kept lights by then.
const WARM: u32 = 8;

/// Arguments of `bench lights`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A scene with sphere lights (JSON)
    scene: PathBuf,
    /// How many lights
    #[arg(long, value_name = "N,N...", value_delimiter = ',', default_values_t = [10, 100, 1000, 10_000], value_parser = clap::value_parser!(u32).range(1..=100_000))]
    lights: Vec<u32>,
    /// Samples a pixel of the picture that others are compared with
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=65536))]
    spp: u32,
    /// Frames that are measured of each; medians count
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=1000))]
    frames: u32,
    /// Size of the pictures; the default is the scene's
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
    #[command(flatten)]
    device: DeviceArguments,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// One way to choose lights.
#[derive(Debug, Serialize)]
struct Row {
    lights: u32,
    choice: &'static str,
    samples: u32,
    /// Milliseconds of the device, a frame.
    ms: f64,
    relmse: f64,
    /// The error of equal chances over this one's, in the same time.
    gain: Option<f64>,
}

/// Runs `bench lights`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = afterglow_scene_file::load(&arguments.scene)
        .map_err(|error| Failure::input(&error.path, error.problem))?;
    if scene.sphere_lights.is_empty() {
        return Err(Failure::input(&arguments.scene, "has no sphere lights"));
    }
    let mut bench = Bench::new(arguments)?;
    let prints = arguments.json.as_deref() != Some(Path::new("-"));
    let mut rows = Vec::new();
    for &lights in &arguments.lights {
        for row in bench.measure(arguments, &scene, lights)? {
            if prints {
                output::print(|out| row.write(out))?;
            }
            rows.push(row);
        }
    }
    arguments.json.as_deref().map_or(Ok(()), |path| output::write_json(path, &rows))
}

impl Row {
    fn write(&self, out: &mut dyn Write) -> std::io::Result<()> {
        let gain = self.gain.map(|gain| format!(", {gain:.1} times less error in the same time"));
        writeln!(
            out,
            "{:>6} lights, {:<10} {:>2} spp {:>9.2} ms, relMSE {:.5}{}",
            self.lights,
            self.choice,
            self.samples,
            self.ms,
            self.relmse,
            gain.unwrap_or_default()
        )
    }
}

/// A way to choose lights.
struct Choice {
    name: &'static str,
    how: LightChoice,
    candidates: u32,
    keeps: bool,
}

const CHOICES: [Choice; 3] = [
    Choice { name: "tree", how: LightChoice::Resampled, candidates: 1, keeps: false },
    Choice { name: "resampled", how: LightChoice::Resampled, candidates: 4, keeps: false },
    Choice { name: "kept", how: LightChoice::Resampled, candidates: 4, keeps: true },
];
const UNIFORM: Choice = Choice { name: "uniform", how: LightChoice::Uniform, candidates: 1, keeps: false };

struct Bench {
    renderer: Renderer,
    size: Option<Size>,
}

impl Bench {
    fn new(arguments: &Arguments) -> Result<Self, Failure> {
        let gpu = Gpu::new(&arguments.device.gpu_options())?;
        let mut options = RenderOptions::default();
        options.timing = true;
        let renderer = Renderer::new(&gpu, &options).map_err(failed)?;
        Ok(Self { renderer, size: arguments.size })
    }

    fn measure(&mut self, arguments: &Arguments, scene: &SceneFile, count: u32) -> Result<Vec<Row>, Failure> {
        let scene = SceneFile { sphere_lights: with_count(&scene.sphere_lights, count), ..scene.clone() };
        let stage = Stage::new(scene).map_err(|problem| Failure::input(&arguments.scene, problem))?;
        let stage = match self.size {
            Some(Size(width, height)) => stage.with_size([width, height]),
            None => stage,
        };
        let truth = self.truth(&stage, arguments.spp)?;
        let mut rows = Vec::new();
        let (uniform_ms, _) = self.one(&stage, &UNIFORM, 1, arguments.frames, &truth)?;
        for choice in CHOICES {
            let (ms, relmse) = self.one(&stage, &choice, 1, arguments.frames, &truth)?;
            let samples = (ms / uniform_ms).ceil().clamp(1.0, 64.0) as u32;
            let (_, other) = self.one(&stage, &UNIFORM, samples, arguments.frames, &truth)?;
            let row =
                |choice, samples, ms, relmse, gain| Row { lights: count, choice, samples, ms, relmse, gain };
            rows.push(row(choice.name, 1, ms, relmse, Some(other / relmse)));
        }
        let (ms, relmse) = self.one(&stage, &UNIFORM, 1, arguments.frames, &truth)?;
        rows.push(Row { lights: count, choice: UNIFORM.name, samples: 1, ms, relmse, gain: None });
        Ok(rows)
    }

    /// The picture of many samples.
    fn truth(&mut self, stage: &Stage, samples: u32) -> Result<Image, Failure> {
        let choice = Choice { keeps: false, candidates: 4, ..CHOICES[0] };
        self.set(&choice, 16, true)?;
        for _ in 0..samples.div_ceil(16) {
            self.paint(stage)?;
        }
        self.picture()
    }

    /// Milliseconds of a frame and its error: medians.
    fn one(
        &mut self,
        stage: &Stage,
        choice: &Choice,
        samples: u32,
        frames: u32,
        truth: &Image,
    ) -> Result<(f64, f64), Failure> {
        self.set(choice, samples, false)?;
        for _ in 0..WARM {
            self.paint(stage)?;
        }
        let (mut times, mut errors) = (Vec::new(), Vec::new());
        for _ in 0..frames {
            self.paint(stage)?;
            let report = self.renderer.frame_report().map_err(failed)?;
            let counts = |name: &str| PASSES.contains(&name);
            let passes = report.passes.iter().filter(|pass| counts(&pass.name));
            times.push(passes.map(|pass| pass.milliseconds).sum());
            errors.push(pixelwise::relmse(&self.picture()?, truth).map_err(failed)?);
        }
        Ok((median(times), median(errors)))
    }

    fn set(&mut self, choice: &Choice, samples: u32, accumulates: bool) -> Result<(), Failure> {
        let mut options = PathtraceOptions::default();
        (options.spp, options.surfaces, options.asked) = (samples, 2, 1);
        (options.light_choice, options.candidates, options.keeps_lights) =
            (choice.how, choice.candidates, choice.keeps);
        (options.accumulate, options.keeps_radiance) = (accumulates, true);
        (options.denoiser, options.smooth_edges) = (afterglow_render::Denoiser::None, false);
        options.most_radiance = f32::INFINITY;
        options.relighting = Relighting::Off;
        options.memory_bytes = 0;
        self.renderer.set_mode(Mode::Pathtrace, &options).map_err(failed)
    }

    fn paint(&mut self, stage: &Stage) -> Result<(), Failure> {
        let (mut frame, scene) = stage.still();
        self.renderer.execute_staged(&mut frame, scene).map_err(failed)
    }

    fn picture(&mut self) -> Result<Image, Failure> {
        let radiance = self.renderer.read_radiance().map_err(failed)?.unwrap_or_default();
        let [width, height] = radiance.size.map(|side| side as usize);
        Image::new(width, height, Encoding::Linear, radiance.mean).map_err(failed)
    }
}

/// So many lights of the same power together: some of them, or copies near by.
fn with_count(lights: &[SphereLight], count: u32) -> Vec<SphereLight> {
    let given = lights.len().max(1);
    let copies = (count as usize).div_ceil(given);
    let share = given as f64 / f64::from(count);
    let (least, greatest) =
        lights.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(least, most), light| {
            (least.min(light.center), most.max(light.center))
        });
    let moved = |number: usize, light: &SphereLight| {
        // The R3 sequence: copies fill the room evenly.
        let step = DVec3::new(0.819_172_513_396_164, 0.671_043_606_703_789, 0.549_700_477_901_97);
        let place = (number as f64 * step).fract_gl();
        SphereLight {
            center: if number < given { light.center } else { least + place * (greatest - least) },
            radius: light.radius * share.min(1.0).sqrt(),
            radiance: light.radiance * share.max(1.0),
            ..light.clone()
        }
    };
    let all = (0..copies).flat_map(|_| lights).take(count as usize);
    all.enumerate().map(|(number, light)| moved(number, light)).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn failed(error: impl ToString) -> Failure {
    Failure::Check(error.to_string())
}
