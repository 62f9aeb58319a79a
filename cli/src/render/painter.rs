//! A device, and a renderer of one scene's frames on it.

use afterglow_gpu::{DeviceInfo, Gpu};
use afterglow_metrics::Image;
use afterglow_render::{self as render, PathtraceOptions, RenderOptions, Renderer};
use afterglow_scene::Relighting;
use afterglow_scene_file::Stage;

use super::Arguments;
use crate::failure::Failure;
use crate::options::Mode;

/// Samples a pixel and frame where none are asked for.
const SAMPLES: u32 = 4;

/// Renders frames.
pub struct Painter {
    gpu: Gpu,
    renderer: Renderer,
}

/// A picture, and what is known of it.
pub struct Picture {
    /// Linear light, but for what is shown in a window.
    pub image: Image,
    /// Samples a pixel that are in it.
    pub samples: u64,
    /// Samples, or pixels if those are not known, that were no number.
    pub non_finite: u64,
}

impl Painter {
    /// Opens the device.
    pub fn new(arguments: &Arguments) -> Result<Painter, Failure> {
        let gpu = Gpu::new(&arguments.device.gpu_options())?;
        let mut renderer = Renderer::new(&gpu, &RenderOptions::default()).map_err(failed)?;
        if arguments.mode == Mode::Pathtrace {
            renderer.set_mode(render::Mode::Pathtrace, &options(arguments)).map_err(failed)?;
            if renderer.mode() != render::Mode::Pathtrace {
                return Err(Failure::Check("the device cannot trace paths".into()));
            }
        }
        Ok(Painter { gpu, renderer })
    }

    /// The device.
    pub fn device(&self) -> DeviceInfo {
        self.gpu.info().clone()
    }

    /// Renders a frame of the sequence, or the still scene.
    pub fn paint(&mut self, stage: &Stage, index: Option<u64>) -> Result<(), Failure> {
        let (mut frame, scene) = match index {
            Some(index) => stage.staged(index as usize),
            None => stage.still(),
        };
        self.renderer.execute_staged(&mut frame, scene).map_err(failed)
    }

    /// The picture of the last frame. It is what a window would show, 8 bits a channel, taken back to light.
    pub fn read(&mut self) -> Result<Picture, Failure> {
        // The report first: reading back is a submission of its own.
        let traced = self.renderer.frame_report().map_err(failed)?.traced;
        let pixels = self.renderer.read_color().map_err(failed)?;
        let [width, height] = self.renderer.size().map(|side| side as usize);
        let shown = Image::from_rgba8(width, height, &pixels).map_err(failed)?;
        let image = shown.to_linear().into_owned();
        let samples = traced.map_or(1, |traced| traced.samples as u64);
        Ok(Picture { non_finite: image.non_finite_count(), samples, image })
    }

    /// Messages of the validation layer so far.
    pub fn validation_messages(&self) -> Vec<String> {
        self.gpu.validation_messages()
    }
}

/// A scene file says all that is to be known: nothing is recovered or remembered.
fn options(arguments: &Arguments) -> PathtraceOptions {
    let mut options = PathtraceOptions::default();
    (options.spp, options.seed) = (arguments.spp.unwrap_or(SAMPLES), arguments.seed);
    options.relighting = Relighting::Off;
    options.memory_bytes = 0;
    options
}

fn failed(error: impl ToString) -> Failure {
    Failure::Check(error.to_string())
}
