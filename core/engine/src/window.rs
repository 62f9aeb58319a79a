//! Drawables of the render thread: windows with their pictures.

use std::time::{Duration, Instant};

use afterglow_gpu::{Gpu, GpuError, Overlay, Presented, Swapchain};
use afterglow_render::{Carried, Renderer};

use crate::blanks::Blanks;
use crate::canvas::Canvas;
use crate::drawable::Surface;
use crate::hud;
use crate::pace::Pace;
use crate::xcb::Servers;

/// How often figures are logged.
const LOG_PERIOD: Duration = Duration::from_secs(5);
/// How often those in a window change.
const HUD_PERIOD: Duration = Duration::from_millis(500);

/// How long a window in which nothing could be shown is left alone.
const PAUSE: Duration = Duration::from_secs(1);

/// A drawable.
pub(crate) struct Window {
    surface: Surface,
    /// The share group that drew to it last.
    pub(crate) group: Option<u64>,
    /// What it shows, if that group is gone.
    pub(crate) left: Option<Carried>,
    logged: Pace,
    hud: Hud,
    output: Option<Output>,
    blanks: Blanks,
    /// When nothing could be shown in it; that has been logged.
    failed_at: Option<Instant>,
}

/// How pictures get to a window.
enum Output {
    Swapchain(Swapchain),
    /// They are read back and copied by the window system.
    Canvas(Canvas),
}

/// The line of figures in a window.
struct Hud {
    pace: Pace,
    line: Option<hud::Line>,
    /// The line, on the device.
    overlay: Option<Overlay>,
}

/// What showing a picture takes.
pub(crate) struct Stage<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) servers: &'a mut Servers,
    /// With the window's drawable selected.
    pub(crate) renderer: &'a mut Renderer,
}

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
    fn is_served_by(self, output: &Output) -> bool {
        let Output::Swapchain(swapchain) = output else { return true };
        let is_hidden = swapchain.size() == [0, 0];
        let has_size = is_hidden || swapchain.size() == <[u32; 2]>::from(self.size);
        has_size && swapchain.waits_for_blank() == self.waits_for_blank
    }
}

impl Window {
    pub(crate) fn new(surface: Surface) -> Self {
        let now = Instant::now();
        Self {
            surface,
            group: None,
            left: None,
            logged: Pace::new(now, LOG_PERIOD),
            hud: Hud { pace: Pace::new(now, HUD_PERIOD), line: None, overlay: None },
            output: None,
            blanks: Blanks::default(),
            failed_at: None,
        }
    }

    /// Drops all that it has on the device, which is lost, or not to be trusted. Nothing is shown in it until something
    /// is drawn.
    pub(crate) fn leave_device(&mut self) {
        self.group = None;
        self.left = None;
        self.hud.overlay = None;
        if let Some(Output::Swapchain(_)) = self.output {
            self.output = None;
        }
    }

    /// Gives back all that there is to show pictures with.
    pub(crate) fn close(&mut self, servers: &mut Servers) {
        if let Some(Output::Canvas(canvas)) = self.output.take() {
            servers.release(&canvas);
        }
    }

    /// Takes note that a picture was shown that the program handed over at `handed_over`. With a renderer, its figures
    /// are shown in the window from the next picture on.
    pub(crate) fn note_pace(&mut self, handed_over: Instant, size: (u32, u32), renderer: Option<&Renderer>) {
        let now = Instant::now();
        if let Some(figures) = self.logged.shown(handed_over, now) {
            tracing::info!(
                "frame {}: {:.1} a second at {}x{}, {:.1} ms after the buffer swap",
                figures.frame,
                figures.rate,
                size.0,
                size.1,
                figures.latency
            );
        }
        if let Some(renderer) = renderer
            && let Some(figures) = self.hud.pace.shown(handed_over, now)
        {
            let line = hud::line(figures, renderer.mode(), size, renderer.last_report());
            self.hud.line = Some(hud::Line::new(&line));
            self.hud.overlay = None;
        }
    }

    /// Shows what was drawn. Returns the window's size.
    pub(crate) fn present(&mut self, stage: Stage<'_>, wanted: Wanted) -> Option<(u32, u32)> {
        let Surface::X11 { display, window } = self.surface.clone() else { return None };
        if self.failed_at.is_some_and(|at| at.elapsed() < PAUSE) {
            return None;
        }
        if self.output.as_ref().is_some_and(|output| !wanted.is_served_by(output)) {
            self.output = None;
        }
        let (gpu, servers) = (stage.gpu, stage.servers);
        let shown = match self.open(gpu, servers, (&display, window), wanted.waits_for_blank) {
            Ok(()) => self.show(gpu, servers, stage.renderer),
            Err(error) => Err(error),
        };
        match shown {
            Ok(size) => {
                self.failed_at = None;
                let is_paced = matches!((&self.output, size), (Some(Output::Swapchain(_)), Some(_)));
                if wanted.waits_for_blank && !is_paced {
                    self.blanks.wait();
                }
                size
            }
            Err(error) if error.is_device_lost() => None,
            Err(error) if error.is_out_of_memory() => {
                tracing::debug!("a picture was not shown: {error}");
                None
            }
            Err(error) => {
                // Programs destroy windows whose last pictures are still to be shown.
                if self.failed_at.is_none() && servers.has_window(&display, window) {
                    tracing::error!("nothing can be shown in a window: {error}");
                }
                self.failed_at = Some(Instant::now());
                self.close(servers);
                None
            }
        }
    }

    /// Finds a way for pictures to get to the window, unless there is one.
    fn open(
        &mut self,
        gpu: &Gpu,
        servers: &mut Servers,
        (display, window): (&str, u32),
        waits_for_blank: bool,
    ) -> Result<(), GpuError> {
        if self.output.is_some() {
            return Ok(());
        }
        let surface = servers.surface(gpu, display, window);
        let output = match surface.and_then(|surface| gpu.swapchain(surface, waits_for_blank)) {
            Ok(swapchain) => Output::Swapchain(swapchain),
            Err(error) if error.is_device_lost() || !servers.has_window(display, window) => {
                return Err(error);
            }
            Err(error) => {
                tracing::warn!("pictures are copied to a window, which is slow: {error}");
                Output::Canvas(servers.canvas(display, window)?)
            }
        };
        self.output = Some(output);
        Ok(())
    }

    /// Shows a picture. Returns the window's size unless it has none.
    fn show(
        &mut self,
        gpu: &Gpu,
        servers: &mut Servers,
        renderer: &mut Renderer,
    ) -> Result<Option<(u32, u32)>, GpuError> {
        match &mut self.output {
            Some(Output::Swapchain(swapchain)) => {
                if let (Some(line), None) = (&self.hud.line, &self.hud.overlay) {
                    // Without memory for it, the picture is shown all the same.
                    self.hud.overlay = gpu.overlay(line.size, &line.greys).ok();
                }
                let presented = renderer.present(swapchain, self.hud.overlay.as_ref())?;
                let [width, height] = swapchain.size();
                Ok((presented == Presented::Shown).then_some((width, height)))
            }
            Some(Output::Canvas(canvas)) => {
                let [width, _] = renderer.size();
                let mut picture = match renderer.read_color() {
                    Ok(picture) => picture,
                    Err(afterglow_render::RenderError::Gpu(error)) => return Err(error),
                    Err(error) => return Err(invalid("picture", error)),
                };
                if let Some(line) = &self.hud.line {
                    line.lay_over(&mut picture, width as usize);
                }
                servers.put(canvas, width, picture).map(Some)
            }
            None => Ok(None),
        }
    }
}

/// Something besides the device that is not as it should be.
pub(crate) fn invalid(what: &'static str, error: impl ToString) -> GpuError {
    GpuError::Invalid { what, detail: error.to_string() }
}
