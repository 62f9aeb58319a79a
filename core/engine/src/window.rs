//! Drawables of the render thread: windows with their pictures.

use afterglow_gpu::{Gpu, GpuError, Presented, Swapchain};
use afterglow_render::Renderer;

use crate::drawable::Surface;
use crate::xcb::Servers;

/// A drawable.
pub(crate) struct Window {
    surface: Surface,
    /// The share group that drew to it last.
    pub(crate) group: Option<u64>,
    swapchain: Option<Swapchain>,
    /// There is no way to show anything in it; that has been logged.
    has_failed: bool,
}

impl Window {
    pub(crate) fn new(surface: Surface) -> Self {
        Self { surface, group: None, swapchain: None, has_failed: false }
    }

    /// Shows what a renderer, with this drawable selected, has drawn. Returns the window's size.
    pub(crate) fn present(
        &mut self,
        gpu: &Gpu,
        servers: &mut Servers,
        renderer: &mut Renderer,
        waits_for_blank: bool,
    ) -> Option<(u32, u32)> {
        if self.has_failed || self.surface == Surface::None {
            return None;
        }
        match self.show(gpu, servers, renderer, waits_for_blank) {
            Ok(size) => size,
            Err(error) => {
                // Programs destroy windows whose last pictures are still to be shown.
                if self.is_there(servers) {
                    tracing::error!("nothing can be shown in a window: {error}");
                }
                self.has_failed = true;
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
        waits_for_blank: bool,
    ) -> Result<Option<(u32, u32)>, GpuError> {
        let Surface::X11 { display, window } = &self.surface else { return Ok(None) };
        if self.swapchain.as_ref().is_some_and(|chain| chain.waits_for_blank() != waits_for_blank) {
            self.swapchain = None;
        }
        let swapchain = match &mut self.swapchain {
            Some(swapchain) => swapchain,
            none => {
                let surface = servers.surface(gpu, display, *window)?;
                none.insert(gpu.swapchain(surface, waits_for_blank)?)
            }
        };
        let presented = renderer.present(swapchain)?;
        let [width, height] = swapchain.size();
        Ok((presented == Presented::Shown).then_some((width, height)))
    }
}
