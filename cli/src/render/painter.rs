//! A device, and a renderer of one scene's frames on it.

use std::time::{Duration, Instant};

use afterglow_gl::frame::Frame;
use afterglow_gpu::{DeviceInfo, Gpu};
use afterglow_metrics::{Encoding, Image};
use afterglow_render::{self as render, PathtraceOptions, Radiance, RenderOptions, Renderer};
use afterglow_scene::{Relighting, Scene};
use afterglow_scene_file::Stage;

use super::pace::Pace;
use super::{Arguments, Target};
use crate::failure::Failure;
use crate::options::Mode;

/// Samples a pixel and frame where none are asked for.
const SAMPLES: u32 = 4;
/// The same of reference mode, if no time is given either.
const REFERENCE_SAMPLES: u32 = 64;
/// The most samples of a picture in reference mode: sums in f32 do not gain from more.
pub const MOST_REFERENCE_SAMPLES: u32 = 1 << 16;
/// The fewest, if there is a time: fewer have no standard error.
const LEAST_REFERENCE_SAMPLES: u32 = 2;

/// Renders frames.
pub struct Painter {
    gpu: Gpu,
    renderer: Renderer,
    mode: Mode,
    options: PathtraceOptions,
    /// Of a picture in reference mode.
    most_samples: u32,
    /// Of a picture in reference mode.
    most_time: Duration,
    pace: Pace,
    counts: Counts,
}

/// What happened on the device.
#[derive(Debug, Clone, Copy, Default)]
pub struct Counts {
    /// Rays of all frames so far.
    pub rays: u64,
    /// Samples of the last frame that were no number.
    pub non_finite: u64,
    /// Samples of the last frame that were darkened.
    pub limited: u64,
}

/// A picture, and what is known of it.
pub struct Picture {
    /// Linear light.
    pub image: Image,
    /// Of each pixel and channel, where samples are independent.
    pub standard_error: Option<Image>,
    /// Samples a pixel that are in it.
    pub samples: u32,
}

impl Painter {
    /// Opens the device.
    pub fn new(arguments: &Arguments) -> Result<Painter, Failure> {
        let gpu = Gpu::new(&arguments.device.gpu_options())?;
        let renderer = Renderer::new(&gpu, &RenderOptions::default()).map_err(failed)?;
        let most_samples = match (arguments.spp, arguments.seconds) {
            (Some(samples), _) => samples.min(MOST_REFERENCE_SAMPLES),
            (None, Some(_)) => MOST_REFERENCE_SAMPLES,
            (None, None) => REFERENCE_SAMPLES,
        };
        let mut painter = Painter {
            gpu,
            renderer,
            mode: arguments.mode,
            options: options(arguments),
            most_samples,
            most_time: arguments.seconds.unwrap_or(Duration::MAX),
            pace: Pace::default(),
            counts: Counts::default(),
        };
        painter.set_samples(painter.options.spp)?;
        match painter.renderer.mode() == arguments.mode.of_renderer() {
            true => Ok(painter),
            false => Err(Failure::Check("the device cannot trace rays".into())),
        }
    }

    /// The device.
    pub fn device(&self) -> DeviceInfo {
        self.gpu.info().clone()
    }

    /// What has happened so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Renders a frame of the sequence, or the still scene. `progress` is told which share of it is done.
    pub fn paint(
        &mut self,
        stage: &Stage,
        index: Option<u64>,
        progress: impl Fn(f64),
    ) -> Result<(), Failure> {
        self.counts = Counts { rays: self.counts.rays, ..Counts::default() };
        let staged = || match index {
            Some(index) => stage.staged(index as usize),
            None => stage.still(),
        };
        match self.mode {
            Mode::Raster | Mode::Pathtrace => self.execute(staged()),
            Mode::Reference => self.refine(staged, progress),
        }
    }

    /// Adds up samples of a frame, in submissions that each take a part of a second: devices give up work that takes
    /// longer than a few. The picture does not depend on how many there are.
    fn refine(&mut self, staged: impl Fn() -> (Frame, Scene), progress: impl Fn(f64)) -> Result<(), Failure> {
        let started = Instant::now();
        let least = LEAST_REFERENCE_SAMPLES.min(self.most_samples);
        let mut samples = 0;
        while samples < least || (samples < self.most_samples && started.elapsed() < self.most_time) {
            let count = self.pace.next().min(self.most_samples - samples);
            self.set_samples(count)?;
            let begun = Instant::now();
            let (frame, scene) = staged();
            // Nothing of another frame is part of the picture.
            self.execute((frame, Scene { cut: samples == 0, ..scene }))?;
            self.pace.note(count, begun.elapsed());
            samples += count;
            let of_time = started.elapsed().as_secs_f64() / self.most_time.as_secs_f64();
            progress((f64::from(samples) / f64::from(self.most_samples)).max(of_time).min(1.0));
        }
        Ok(())
    }

    /// Renders a frame, and waits for it.
    fn execute(&mut self, (mut frame, scene): (Frame, Scene)) -> Result<(), Failure> {
        self.renderer.execute_staged(&mut frame, scene).map_err(failed)?;
        let counters = self.renderer.read_counters().map_err(failed)?;
        self.counts.rays += u64::from(counters.rays);
        self.counts.non_finite += u64::from(counters.non_finite);
        self.counts.limited += u64::from(counters.limited);
        Ok(())
    }

    fn set_samples(&mut self, count: u32) -> Result<(), Failure> {
        self.options.spp = count;
        self.renderer.set_mode(self.mode.of_renderer(), &self.options).map_err(failed)
    }

    /// The picture of the last frame: radiance, but in raster mode what a window would show, 8 bits a channel, taken back
    /// to light.
    pub fn read(&mut self) -> Result<Picture, Failure> {
        if let Some(radiance) = self.renderer.read_radiance().map_err(failed)? {
            return traced(radiance, self.mode).map_err(failed);
        }
        let pixels = self.renderer.read_color().map_err(failed)?;
        let [width, height] = self.renderer.size().map(|side| side as usize);
        let shown = Image::from_rgba8(width, height, &pixels).map_err(failed)?;
        Ok(Picture { image: shown.to_linear().into_owned(), standard_error: None, samples: 1 })
    }

    /// Messages of the validation layer so far.
    pub fn validation_messages(&self) -> Vec<String> {
        self.gpu.validation_messages()
    }
}

fn traced(radiance: Radiance, mode: Mode) -> Result<Picture, afterglow_metrics::FormatError> {
    let [width, height] = radiance.size.map(|side| side as usize);
    let image = |pixels| Image::new(width, height, Encoding::Linear, pixels);
    Ok(Picture {
        image: image(radiance.mean)?,
        standard_error: match mode {
            Mode::Reference => Some(image(radiance.standard_error)?),
            Mode::Raster | Mode::Pathtrace => None,
        },
        samples: radiance.samples,
    })
}

/// A scene file says all that is to be known: nothing is recovered or remembered.
fn options(arguments: &Arguments) -> PathtraceOptions {
    let mut options = PathtraceOptions::default();
    (options.spp, options.seed) = (SAMPLES, arguments.seed);
    options.keeps_radiance = true;
    arguments.light.apply(arguments.spp, &mut options);
    options.relighting = Relighting::Off;
    options.memory_bytes = 0;
    (options.target, options.surfaces) = match arguments.target {
        Target::Direct => (render::Target::Direct, 1),
        Target::Bounce1 => (render::Target::Bounce1, 2),
        Target::Full => (render::Target::Full, options.surfaces),
    };
    options
}

fn failed(error: impl ToString) -> Failure {
    Failure::Check(error.to_string())
}
