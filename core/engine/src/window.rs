//! Drawables of the render thread: windows with their pictures.

use std::time::{Duration, Instant};

use afterglow_gpu::{Gpu, GpuError, Overlay, Presented, Swapchain};
use afterglow_render::{Carried, FrameReport, Renderer};

use crate::blanks::Blanks;
use crate::canvas::Canvas;
use crate::drawable::Surface;
use crate::hud::{self, Manner, Panel};
use crate::pace::Pace;
use crate::xcb::Servers;

/// How often figures are logged.
const LOG_PERIOD: Duration = Duration::from_secs(5);
/// How often those in a window change.
const HUD_PERIOD: Duration = Duration::from_millis(500);
/// How long a message stays.
const NOTICE_PERIOD: Duration = Duration::from_secs(2);
/// How long a window in which nothing could be shown is left alone.
const PAUSE: Duration = Duration::from_secs(1);

/// A drawable.
pub(crate) struct Window {
    surface: Surface,
    /// The share group that drew to it last.
    pub(crate) group: Option<u64>,
    /// What it shows, if that group is gone.
    pub(crate) left: Option<Carried>,
    /// Of the options that it was told last.
    pub(crate) version: u64,
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

/// The text in a window.
struct Hud {
    pace: Pace,
    /// What is said for a while, and until when.
    notice: Option<(String, Instant)>,
    figures: Vec<String>,
    panel: Option<Panel>,
    /// The panel, on the device.
    overlay: Option<Overlay>,
}

impl Hud {
    fn new(now: Instant) -> Self {
        let pace = Pace::new(now, HUD_PERIOD);
        Self { pace, notice: None, figures: Vec::new(), panel: None, overlay: None }
    }

    /// The message, and the figures below it, as pixels.
    fn renew(&mut self) {
        let notice = self.notice.iter().map(|(text, _)| text.clone());
        let lines: Vec<_> = notice.chain(self.figures.iter().cloned()).collect();
        self.panel = (!lines.is_empty()).then(|| Panel::new(&lines));
        self.overlay = None;
    }
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
    /// A window that nothing was drawn to, of this version of the options.
    pub(crate) fn new(surface: Surface, version: u64) -> Self {
        let now = Instant::now();
        Self {
            surface,
            group: None,
            left: None,
            version,
            logged: Pace::new(now, LOG_PERIOD),
            hud: Hud::new(now),
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

    /// What it is to the window system.
    pub(crate) fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Pictures shown so far.
    pub(crate) fn pictures(&self) -> u64 {
        self.logged.total()
    }

    /// Says something in the window for a while, from the next picture on.
    pub(crate) fn say(&mut self, text: String) {
        self.hud.notice = Some((text, Instant::now() + NOTICE_PERIOD));
        self.hud.renew();
    }

    /// Takes note that a picture was shown that the program handed over at `handed_over`. Where figures are wanted, they
    /// are shown in the window from the next picture on.
    pub(crate) fn note_pace(
        &mut self,
        handed_over: Instant,
        size: (u32, u32),
        wanted: Option<(Manner, &FrameReport)>,
    ) {
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
        let hud = &mut self.hud;
        let mut is_other = hud.notice.take_if(|(_, until)| *until <= now).is_some();
        let figures = hud.pace.shown(handed_over, now);
        match (wanted, figures) {
            (Some((manner, report)), Some(figures)) => {
                hud.figures = hud::lines(figures, manner, size, report);
                is_other = true;
            }
            (Some(_), None) => {}
            (None, _) => is_other |= !std::mem::take(&mut hud.figures).is_empty(),
        }
        if is_other {
            hud.renew();
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
                if let (Some(panel), None) = (&self.hud.panel, &self.hud.overlay) {
                    // Without memory for it, the picture is shown all the same.
                    self.hud.overlay = gpu.overlay(panel.size, &panel.greys).ok();
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
                if let Some(panel) = &self.hud.panel {
                    panel.lay_over(&mut picture, width as usize);
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
