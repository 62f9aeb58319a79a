//! The renderer that all tests share.

use std::sync::{Mutex, OnceLock, PoisonError};

use afterglow_gl::frame::Frame;
use afterglow_gpu::{Gpu, GpuOptions};
use afterglow_render::{Backend, Mode, PathtraceOptions, RenderOptions, Renderer};
use afterglow_scene::{Relighting, Scene};
use afterglow_scene_file::Stage;

use crate::picture::Picture;
use crate::world::World;

/// How a world is rendered.
#[derive(Debug, Clone)]
pub struct Shot {
    pub options: PathtraceOptions,
}

impl Shot {
    /// So many samples a pixel, in one frame.
    pub fn of(samples: u32) -> Self {
        let mut options = PathtraceOptions::default();
        (options.spp, options.relighting, options.memory_bytes) = (samples, Relighting::Off, 0);
        (options.keeps_radiance, options.backend) = (true, backend());
        Self { options }
    }

    /// With other options.
    #[must_use]
    pub fn with(mut self, change: impl FnOnce(&mut PathtraceOptions)) -> Self {
        change(&mut self.options);
        self
    }

    /// Renders a frame whose scene is known.
    pub fn render(&self, mode: Mode, staged: (Frame, Scene)) -> Picture {
        static RENDERER: OnceLock<Mutex<Renderer>> = OnceLock::new();
        let new = || Mutex::new(Renderer::new(gpu(), &RenderOptions::default()).unwrap());
        // A test that has failed leaves a renderer that works.
        let mut renderer = RENDERER.get_or_init(new).lock().unwrap_or_else(PoisonError::into_inner);
        let picture = self.render_with(&mut renderer, mode, staged);
        assert_eq!(gpu().validation_count(), 0, "{:#?}", gpu().validation_messages());
        picture
    }

    fn render_with(
        &self,
        renderer: &mut Renderer,
        mode: Mode,
        (mut frame, scene): (Frame, Scene),
    ) -> Picture {
        renderer.set_mode(mode, &self.options).unwrap();
        assert_eq!(renderer.mode(), mode, "the device cannot trace");
        // It has nothing in common with the frames of other tests.
        renderer.execute_staged(&mut frame, Scene { cut: true, ..scene }).unwrap();
        let counters = renderer.read_counters().unwrap();
        let radiance = renderer.read_radiance().unwrap().unwrap_or_default();
        Picture {
            radiance,
            non_finite: u64::from(counters.non_finite),
            limited: u64::from(counters.limited),
            removed: f64::from(counters.removed) / 16.0,
            rays: u64::from(counters.rays),
            shown: renderer.read_color().unwrap(),
        }
    }
}

/// Renders a world with the camera's own rays, without any bias.
pub fn reference(world: &World, shot: &Shot) -> Picture {
    shot.render(Mode::Reference, staged(world))
}

/// Renders a world as a game's, where what the camera sees is rasterized.
pub fn pathtrace(world: &World, shot: &Shot) -> Picture {
    shot.render(Mode::Pathtrace, staged(world))
}

/// What the renderer takes of a world.
pub fn staged(world: &World) -> (Frame, Scene) {
    Stage::new(world.file.clone()).unwrap().still()
}

/// What traces rays: `AFTERGLOW_EXTREMES_BACKEND` may say `hardware`.
pub fn backend() -> Backend {
    match std::env::var("AFTERGLOW_EXTREMES_BACKEND").as_deref() {
        Ok("hardware") => Backend::Hardware,
        _ => Backend::Software,
    }
}

/// The device of all tests.
fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| Gpu::new(&GpuOptions::for_tests()).unwrap())
}
