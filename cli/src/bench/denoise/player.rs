//! Plays sequences on the device.

use std::ops::Range;
use std::time::Instant;

use afterglow_gl::frame::Frame;
use afterglow_gpu::{DeviceInfo, Gpu};
use afterglow_metrics::{Encoding, FormatError, Image};
use afterglow_render::{Mode, Paint, PathtraceOptions, RenderOptions, Renderer};
use afterglow_scene::{Relighting, Scene};
use afterglow_scene_file::Stage;

use super::Arguments;
use super::references::Reference;
use crate::failure::Failure;
use crate::render::pace::Pace;
use afterglow_render::Denoiser;

/// From a frame's seed to the next one's, where they are to differ: the golden ratio, as hashes have it.
const SEED_STEP: u32 = 0x9e37_79b9;

/// A device, and what is the same for all that is played on it.
pub struct Player {
    gpu: Gpu,
    options: PathtraceOptions,
}

/// Pictures of successive frames, linear.
pub type Pictures = Vec<Image>;

impl Player {
    /// Opens the device.
    pub fn new(arguments: &Arguments) -> Result<Player, Failure> {
        let gpu = Gpu::new(&arguments.device.gpu_options())?;
        // A scene file says all that is to be known: nothing is recovered or remembered.
        let mut options = PathtraceOptions::default();
        options.backend = arguments.backend.fixed();
        (options.spp, options.seed, options.surfaces) =
            (arguments.spp, arguments.seed, arguments.bounces + 1);
        options.most_radiance = arguments.limit;
        options.accumulate = !arguments.no_accumulate;
        options.keeps_radiance = true;
        options.relighting = Relighting::Off;
        options.memory_bytes = 0;
        Ok(Player { gpu, options })
    }

    /// The device.
    pub fn device(&self) -> DeviceInfo {
        self.gpu.info().clone()
    }

    /// Messages of the validation layer so far.
    pub fn validation_messages(&self) -> Vec<String> {
        self.gpu.validation_messages()
    }

    /// Plays frames with a denoiser, with history from frame to frame and none before the first one.
    pub fn play(
        &self,
        stage: &Stage,
        frames: &Range<usize>,
        denoiser: Denoiser,
        mut progress: impl FnMut(),
    ) -> Result<Pictures, Failure> {
        let mut options = self.options.clone();
        options.denoiser = denoiser;
        let mut renderer = self.renderer(Mode::Pathtrace, &options)?;
        let picture = |index| {
            execute(&mut renderer, stage.staged(index))?;
            progress();
            read_radiance(&mut renderer)
        };
        frames.clone().map(picture).collect()
    }

    /// Plays frames each by itself, with noise of its own.
    pub fn play_noisy(
        &self,
        stage: &Stage,
        frames: &Range<usize>,
        mut progress: impl FnMut(),
    ) -> Result<Pictures, Failure> {
        let mut options = self.plain();
        let mut renderer = self.renderer(Mode::Pathtrace, &options)?;
        let picture = |index: usize| {
            options.seed = self.options.seed ^ (index as u32 + 1).wrapping_mul(SEED_STEP);
            renderer.set_mode(Mode::Pathtrace, &options).map_err(failed)?;
            execute(&mut renderer, stage.staged(index))?;
            progress();
            read_radiance(&mut renderer)
        };
        frames.clone().map(picture).collect()
    }

    /// What is known of the surfaces that are seen, in 8 bits.
    pub fn play_painted(
        &self,
        stage: &Stage,
        frames: &Range<usize>,
        paint: Paint,
    ) -> Result<Pictures, Failure> {
        let mut options = self.plain();
        options.paint = paint;
        let mut renderer = self.renderer(Mode::Pathtrace, &options)?;
        let picture = |index| {
            execute(&mut renderer, stage.staged(index))?;
            let pixels = renderer.read_color().map_err(failed)?;
            let [width, height] = renderer.size().map(|side| side as usize);
            Image::from_rgba8(width, height, &pixels).map_err(failed)
        };
        frames.clone().map(picture).collect()
    }

    /// Without any history, and without a filter.
    fn plain(&self) -> PathtraceOptions {
        let mut options = self.options.clone();
        options.accumulate = false;
        options.denoiser = Denoiser::None;
        options
    }

    /// A frame of so many samples a pixel by reference mode, in submissions of a part of a second each.
    pub fn reference(&self, stage: &Stage, index: usize, samples: u32) -> Result<Reference, Failure> {
        // Whatever pictures are held against it, it is the same.
        let mut options = self.options.clone();
        options.seed = 0;
        let mut renderer = self.renderer(Mode::Reference, &options)?;
        let (mut pace, mut done) = (Pace::default(), 0);
        while done < samples {
            options.spp = pace.next().min(samples - done);
            renderer.set_mode(Mode::Reference, &options).map_err(failed)?;
            let begun = Instant::now();
            let (frame, scene) = stage.staged(index);
            execute(&mut renderer, (frame, Scene { cut: done == 0, ..scene }))?;
            pace.note(options.spp, begun.elapsed());
            done += options.spp;
        }
        let radiance = renderer.read_radiance().map_err(failed)?.unwrap_or_default();
        let image = |pixels| linear(radiance.size, pixels).map_err(failed);
        Ok(Reference { mean: image(radiance.mean)?, standard_error: Some(image(radiance.standard_error)?) })
    }

    /// A new one, so that nothing of what was played before is in its pictures.
    fn renderer(&self, mode: Mode, options: &PathtraceOptions) -> Result<Renderer, Failure> {
        let mut renderer = Renderer::new(&self.gpu, &RenderOptions::default()).map_err(failed)?;
        renderer.set_mode(mode, options).map_err(failed)?;
        match renderer.mode() == mode {
            true => Ok(renderer),
            false => Err(Failure::Check("the device cannot trace rays".into())),
        }
    }
}

/// Renders a frame, and waits for it.
fn execute(renderer: &mut Renderer, (mut frame, scene): (Frame, Scene)) -> Result<(), Failure> {
    renderer.execute_staged(&mut frame, scene).map_err(failed)?;
    renderer.read_counters().map(|_| ()).map_err(failed)
}

fn read_radiance(renderer: &mut Renderer) -> Result<Image, Failure> {
    let radiance = renderer.read_radiance().map_err(failed)?.unwrap_or_default();
    linear(radiance.size, radiance.mean).map_err(failed)
}

fn linear(size: [u32; 2], pixels: Vec<[f32; 3]>) -> Result<Image, FormatError> {
    let [width, height] = size.map(|side| side as usize);
    Image::new(width, height, Encoding::Linear, pixels)
}

fn failed(error: impl ToString) -> Failure {
    Failure::Check(error.to_string())
}
