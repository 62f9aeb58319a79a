//! What the render thread owns, and what it does with messages.

mod live;

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_gpu::{DeviceKind, Gpu};
use afterglow_render::{Backend as Rays, Mode, RenderError, RenderOptions, Renderer};
use parking_lot::Mutex;

use crate::contest::{Contest, Turn};
use crate::drawable::Drawable;
use crate::failures::Failures;
use crate::hud;
use crate::life::Ending;
use crate::message::Message;
use crate::options::{EngineOptions, OptionsSource};
use crate::slowness::{self, Slowness};
use crate::window::{Stage, Wanted, Window};
use crate::xcb::Servers;
use live::Live;

/// Empty frames that are kept to be filled again.
const RECYCLED_FRAMES: usize = 4;
/// How often a lost device is opened again, and how long to wait in between: drivers take a while to come back.
const OPENINGS: u32 = 3;
const OPENING_PAUSE: Duration = Duration::from_millis(500);

/// Everything that the thread owns.
pub(crate) struct State {
    /// None once it is given up: frames are dropped then.
    gpu: Option<Gpu>,
    /// As keys and their source have changed them.
    options: EngineOptions,
    live: Live,
    /// What frames become now.
    mode: Mode,
    slowness: Slowness,
    /// Until it is known which backend is the faster one.
    contest: Option<Contest>,
    recycled: Arc<Mutex<Vec<Frame>>>,
    /// By share group.
    renderers: HashMap<u64, Renderer>,
    /// By drawable.
    windows: HashMap<u64, Window>,
    /// Dropped after all windows.
    servers: Servers,
    /// Frames that were begun with another number name images that are lost.
    device_number: Arc<AtomicU64>,
    /// What is on the device is not to be trusted any more.
    has_failed: bool,
    failures: Failures,
}

impl State {
    pub(crate) fn new(
        gpu: Gpu,
        mut options: EngineOptions,
        source: Option<Box<dyn OptionsSource>>,
        recycled: Arc<Mutex<Vec<Frame>>>,
        device_number: Arc<AtomicU64>,
    ) -> Self {
        options.pathtrace.backend = first_backend(&gpu, options.backend);
        Self {
            live: Live::new(&options, source),
            contest: if options.backend.is_none() { Contest::on(&gpu) } else { None },
            gpu: Some(gpu),
            mode: options.mode.unwrap_or(Mode::Pathtrace),
            slowness: Slowness::default(),
            options,
            recycled,
            renderers: HashMap::new(),
            windows: HashMap::new(),
            servers: Servers::default(),
            device_number,
            has_failed: false,
            failures: Failures::default(),
        }
    }

    /// Handles messages until nobody can send any more, or the thread is not wanted.
    pub(crate) fn run(mut self, messages: &mpsc::Receiver<Message>, ending: &Ending) {
        while let Ok(message) = messages.recv()
            && ending.is_wanted()
        {
            let finished = match &message {
                Message::Frame { drawable, end, .. } => Some((drawable.clone(), *end)),
                _ => None,
            };
            if catch_unwind(AssertUnwindSafe(|| self.handle(message))).is_err() {
                tracing::error!("a bug in Afterglow: a frame was dropped");
                self.has_failed = true;
            }
            if catch_unwind(AssertUnwindSafe(|| self.recover())).is_err() {
                tracing::error!("a bug in Afterglow: nothing is drawn any more");
                self.gpu = None;
            }
            if let Some((drawable, end)) = finished {
                drawable.shared.queue_of(end).leave();
            }
        }
    }

    fn handle(&mut self, message: Message) {
        match message {
            Message::Drawable { drawable, surface } => {
                self.windows.insert(drawable, Window::new(surface, self.live.version));
            }
            Message::DropDrawable { drawable } => {
                if let Some(mut window) = self.windows.remove(&drawable) {
                    window.close(&mut self.servers);
                }
                self.live.forget(drawable);
                self.renderers.values_mut().for_each(|renderer| renderer.forget(drawable));
            }
            Message::DropGroup { group } => self.drop_group(group),
            Message::Frame { group, drawable, frame, end, handed_over } => {
                let begun = Instant::now();
                if self.frame(group, &drawable, frame, end) && end != End::Continued {
                    self.present(&drawable);
                    self.judge_speed(drawable.shared.id, begun.elapsed());
                    self.judge_backend(group);
                    self.note_pace(&drawable, handed_over);
                    self.live(&drawable);
                }
            }
            Message::Ask { group, drawable, frame, request, reply } => {
                let _ = reply.send(self.answer(group, &drawable, frame, request));
            }
            Message::Present { drawable } => self.present(&drawable),
            Message::Stop => {}
        }
    }

    /// Executes a frame. Whether there is something new to be shown.
    fn frame(&mut self, group: u64, drawable: &Drawable, mut frame: Frame, end: End) -> bool {
        let is_stale = self.is_stale(&frame);
        let Some(renderer) = self.renderer(group, drawable.shared.id) else { return false };
        if is_stale {
            frame.keep_images();
            renderer.submit_unlit(frame, End::Continued);
        } else {
            renderer.submit(frame, end);
        }
        let (empty, mode) = (renderer.recycle(), renderer.mode());
        // It may have found that it cannot trace.
        if mode != std::mem::replace(&mut self.mode, mode) {
            self.say(drawable.shared.id, format!("{}: no more is possible here", hud::mode_name(mode)));
        }
        let mut recycled = self.recycled.lock();
        if recycled.len() < RECYCLED_FRAMES {
            recycled.push(empty);
        }
        !is_stale
    }

    fn answer(&mut self, group: u64, drawable: &Drawable, mut frame: Frame, request: Request) -> Reply {
        let is_stale = self.is_stale(&frame);
        let Some(renderer) = self.renderer(group, drawable.shared.id) else { return Reply::Unavailable };
        if is_stale {
            frame.keep_images();
            renderer.submit_unlit(frame, End::Continued);
            return Reply::Unavailable;
        }
        renderer.answer(frame, request)
    }

    /// Whether a frame was begun before the images were lost that it names.
    fn is_stale(&self, frame: &Frame) -> bool {
        frame.device != self.device_number.load(Ordering::Relaxed)
    }

    /// Gives tracing up where nobody insists on it and it takes too long.
    fn judge_speed(&mut self, drawable: u64, taken: Duration) {
        if self.mode == Mode::Raster || self.options.mode.is_some() {
            return;
        }
        if self.slowness.note(taken) {
            tracing::warn!(
                "path tracing takes more than {} ms a frame here: frames are rasterized from now on \
                 (AFTERGLOW_MODE=pathtrace insists)",
                slowness::MOST.as_millis()
            );
            self.mode = Mode::Raster;
            self.live.version += 1;
            self.say(drawable, "raster: path tracing is too slow here".into());
        }
    }

    /// Goes on with the backend that is the faster one, once that is known.
    fn judge_backend(&mut self, group: u64) {
        let (Some(contest), Some(renderer)) = (&mut self.contest, self.renderers.get(&group)) else { return };
        let backend = match contest.note(renderer.last_report()) {
            Turn::Wait => return,
            Turn::Try(backend) => backend,
            Turn::Keep(backend) => {
                self.contest = None;
                backend
            }
        };
        self.trace_by(backend);
    }

    fn trace_by(&mut self, backend: Rays) {
        if backend == self.options.pathtrace.backend || self.mode == Mode::Raster {
            return;
        }
        let former = std::mem::replace(&mut self.options.pathtrace.backend, backend);
        for renderer in self.renderers.values_mut() {
            if let Err(error) = renderer.set_mode(self.mode, &self.options.traced()) {
                tracing::warn!("rays stay with the {former} backend: {error}");
                self.contest = None;
                self.options.pathtrace.backend = former;
                return;
            }
        }
    }

    fn note_pace(&mut self, drawable: &Drawable, handed_over: Instant) {
        let manner = self.manner();
        let Some(window) = self.windows.get_mut(&drawable.shared.id) else { return };
        let group = window.group.and_then(|group| self.renderers.get(&group));
        let figures = group.filter(|_| self.options.hud).map(|renderer| (manner, renderer.last_report()));
        window.note_pace(handed_over, drawable.size(), figures);
    }

    /// The renderer of a share group, with a drawable selected.
    fn renderer(&mut self, group: u64, drawable: u64) -> Option<&mut Renderer> {
        if !self.renderers.contains_key(&group) {
            let made = self.make_renderer(self.gpu.as_ref()?);
            let made = self.checked("no renderer", made)?;
            self.renderers.insert(group, made);
        }
        self.carry(drawable, group);
        let selected = self.renderers.get_mut(&group)?.select(drawable);
        self.checked("no drawable", selected)?;
        if let Some(window) = self.windows.get_mut(&drawable) {
            window.group = Some(group);
        }
        self.tell(group, drawable);
        self.renderers.get_mut(&group)
    }

    /// Drawables outlive the share group that drew to them last, and what they show with them.
    fn drop_group(&mut self, group: u64) {
        let Some(mut renderer) = self.renderers.remove(&group) else { return };
        for (drawable, window) in self.windows.iter_mut().filter(|(_, window)| window.group == Some(group)) {
            window.group = None;
            window.left = renderer.give_up(*drawable);
        }
    }

    /// Takes what a drawable shows to a share group's renderer, if another group drew to it last.
    fn carry(&mut self, drawable: u64, group: u64) {
        let Some(window) = self.windows.get_mut(&drawable).filter(|window| window.group != Some(group))
        else {
            return;
        };
        let former = window.group.and_then(|former| self.renderers.get_mut(&former));
        let carried = window.left.take().or_else(|| former?.give_up(drawable));
        if let (Some(carried), Some(renderer)) = (carried, self.renderers.get_mut(&group))
            && let Err(error) = renderer.take_over(drawable, carried)
        {
            tracing::error!("a drawable begins anew: {error}");
        }
    }

    /// Shows what was drawn to a drawable last.
    fn present(&mut self, drawable: &Drawable) {
        let id = drawable.shared.id;
        let Some(group) = self.windows.get(&id).and_then(|window| window.group) else { return };
        if self.renderer(group, id).is_none() {
            return;
        }
        let (Some(gpu), Some(window), Some(renderer)) =
            (&self.gpu, self.windows.get_mut(&id), self.renderers.get_mut(&group))
        else {
            return;
        };
        let wanted = Wanted { waits_for_blank: drawable.swap_interval() != 0, size: drawable.size() };
        let stage = Stage { gpu, servers: &mut self.servers, renderer };
        if let Some(size) = window.present(stage, wanted) {
            drawable.set_size(size);
        }
    }

    fn make_renderer(&self, gpu: &Gpu) -> Result<Renderer, RenderError> {
        let mut options = RenderOptions::default();
        // A processor that plays the device would have to wait for each pass.
        let is_wanted = self.options.hud || self.options.keys.is_some() || self.contest.is_some();
        options.timing = is_wanted && gpu.info().kind != DeviceKind::Cpu;
        let mut renderer = Renderer::new(gpu, &options)?;
        match renderer.set_mode(self.mode, &self.options.traced()) {
            Err(error) if error.is_out_of_memory() => {
                tracing::error!("path tracing is off, frames are rasterized: {error}");
            }
            other => other?,
        }
        Ok(renderer)
    }

    /// A failure is logged and remembered.
    fn checked<T>(&mut self, what: &str, result: Result<T, RenderError>) -> Option<T> {
        if let Err(error) = &result {
            if !error.is_device_lost() {
                tracing::error!("{what}: {error}");
            }
            self.has_failed = true;
        }
        result.ok()
    }

    /// Begins anew if the device was lost, or a renderer has failed.
    fn recover(&mut self) {
        let Some(gpu) = &self.gpu else { return };
        let is_lost = gpu.is_lost();
        if !is_lost
            && !self.has_failed
            && self.renderers.values().all(|renderer| renderer.failure().is_none())
        {
            return;
        }
        self.has_failed = false;
        self.renderers.clear();
        self.windows.values_mut().for_each(Window::leave_device);
        let may_try = self.may_try(if is_lost { "the device was lost" } else { "drawing has failed" });
        if is_lost || !may_try {
            self.gpu = None;
        }
        if is_lost && may_try {
            tracing::error!("the device was lost: it is opened again, and everything uploaded again");
            self.gpu = opened(&self.options);
        }
        // From here on contexts define their images anew.
        self.device_number.fetch_add(1, Ordering::Release);
    }

    /// Whether to go on after one more failure: at first as before, then without rays.
    fn may_try(&mut self, what: &str) -> bool {
        if self.failures.allow(Instant::now()) {
            return true;
        }
        if self.mode == Mode::Raster {
            tracing::error!("{what} again and again: nothing is drawn any more");
            return false;
        }
        tracing::error!("{what} again and again: path tracing is off, frames are rasterized");
        self.mode = Mode::Raster;
        self.failures = Failures::default();
        true
    }
}

/// The backend to begin with: the one that is asked for, if the device has it.
fn first_backend(gpu: &Gpu, asked: Option<Rays>) -> Rays {
    let backend = asked.unwrap_or_default();
    if backend.is_on(gpu) {
        return backend;
    }
    let device = &gpu.info().name;
    tracing::warn!("{device} has no ray-tracing pipelines: rays are traced by the software backend");
    Rays::Software
}

/// A device in place of a lost one, which must have been dropped.
fn opened(options: &EngineOptions) -> Option<Gpu> {
    for opening in 1.. {
        match Gpu::new(&options.gpu) {
            Ok(gpu) => return Some(gpu),
            Err(error) if opening == OPENINGS => {
                tracing::error!("there is no device any more, nothing is drawn: {error}");
                break;
            }
            Err(_) => std::thread::sleep(OPENING_PAUSE),
        }
    }
    None
}
