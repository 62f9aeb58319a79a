//! Drawables of the render thread: windows with their pictures.

use std::time::{Duration, Instant};

use afterglow_gpu::{Gpu, GpuError, Presented, Swapchain};
use afterglow_render::{Carried, Renderer};

use crate::drawable::Surface;
use crate::pace::Pace;
use crate::xcb::Servers;

/// A drawable.
pub(crate) struct Window {
    surface: Surface,
    /// The share group that drew to it last.
    pub(crate) group: Option<u64>,
    /// What it shows, if that group is gone.
    pub(crate) left: Option<Carried>,
    pub(crate) pace: Pace,
    swapchain: Option<Swapchain>,
    /// When nothing could be shown in it; that has been logged.
    failed_at: Option<Instant>,
}

/// How long a window in which nothing could be shown is left alone.
const PAUSE: Duration = Duration::from_secs(1);

/// How a picture is to be shown.
#[derive(Clone, Copy)]
pub(crate) struct Wanted {
    /// It waits for the screen's blank.
    pub(crate) waits_for_blank: bool,
    /// Width and height that the window has as far as is known, pixels.
    pub(crate) size: (u32, u32),
}

impl Wanted {
    /// Pictures of another size would be shown once before the window system finds them wrong.
    fn is_served_by(self, swapchain: &Swapchain) -> bool {
        let is_hidden = swapchain.size() == [0, 0];
        let has_size = is_hidden || swapchain.size() == <[u32; 2]>::from(self.size);
        has_size && swapchain.waits_for_blank() == self.waits_for_blank
    }
}

impl Window {
    pub(crate) fn new(surface: Surface) -> Self {
        Self {
            surface,
            group: None,
            left: None,
            pace: Pace::new(Instant::now()),
            swapchain: None,
            failed_at: None,
        }
    }

    /// Shows what a renderer, with this drawable selected, has drawn. Returns the window's size.
    pub(crate) fn present(
        &mut self,
        gpu: &Gpu,
        servers: &mut Servers,
        renderer: &mut Renderer,
        wanted: Wanted,
    ) -> Option<(u32, u32)> {
        if self.surface == Surface::None || self.failed_at.is_some_and(|at| at.elapsed() < PAUSE) {
            return None;
        }
        match self.show(gpu, servers, renderer, wanted) {
            Ok(size) => {
                self.failed_at = None;
                size
            }
            Err(error) => {
                // Programs destroy windows whose last pictures are still to be shown.
                if self.failed_at.is_none() && self.is_there(servers) {
                    tracing::error!("nothing can be shown in a window: {error}");
                }
                self.failed_at = Some(Instant::now());
                self.swapchain = None;
                None
            }
        }
    }

    fn is_there(&self, servers: &Servers) -> bool {
        match &self.surface {
            Surface::None => false,
            Surface::X11 { display, window } => servers.has_window(display, *window),
        }
    }

    fn show(
        &mut self,
        gpu: &Gpu,
        servers: &mut Servers,
        renderer: &mut Renderer,
        wanted: Wanted,
    ) -> Result<Option<(u32, u32)>, GpuError> {
        let Surface::X11 { display, window } = &self.surface else { return Ok(None) };
        if self.swapchain.as_ref().is_some_and(|chain| !wanted.is_served_by(chain)) {
            self.swapchain = None;
        }
        let swapchain = match &mut self.swapchain {
            Some(swapchain) => swapchain,
            none => {
                let surface = servers.surface(gpu, display, *window)?;
                none.insert(gpu.swapchain(surface, wanted.waits_for_blank)?)
            }
        };
        let presented = renderer.present(swapchain)?;
        let [width, height] = swapchain.size();
        Ok((presented == Presented::Shown).then_some((width, height)))
    }
}
