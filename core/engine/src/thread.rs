//! The thread that owns the device.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_gpu::{DeviceInfo, Gpu, GpuError, GpuOptions};
use afterglow_render::{Mode, PathtraceOptions, RenderOptions, Renderer};
use parking_lot::Mutex;

use crate::drawable::{Drawable, Surface};
use crate::flushed::FlushedFrames;
use crate::life::{Ending, Life};
use crate::message::Message;
use crate::port::ShareGroup;
use crate::window::{Wanted, Window};
use crate::xcb::Servers;

/// Empty frames that are kept to be filled again.
const RECYCLED_FRAMES: usize = 4;

/// How to render.
#[derive(Debug, Clone, Default)]
pub struct EngineOptions {
    /// Which device.
    pub gpu: GpuOptions,
    /// What frames become.
    pub mode: Mode,
    /// How worlds are traced.
    pub pathtrace: PathtraceOptions,
}

/// Why there is no render thread.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// No device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// No thread.
    #[error("cannot start the render thread: {0}")]
    Thread(#[from] std::io::Error),
    /// The thread ended before it said anything.
    #[error("the render thread failed to start")]
    Died,
}

/// The render thread, as other threads see it. A clone is the same thread; it ends when the last one is gone.
#[derive(Clone)]
pub struct Engine {
    shared: Arc<Shared>,
}

struct Shared {
    sender: mpsc::Sender<Message>,
    life: Arc<Life>,
    recycled: Arc<Mutex<Vec<Frame>>>,
    flushed: FlushedFrames,
    /// A forked process has no render thread.
    process: u32,
    last_id: AtomicU64,
    device: DeviceInfo,
    /// Asked for the sizes of windows by threads that draw.
    sizes: Mutex<Servers>,
}

impl Engine {
    /// Opens the device and starts the thread.
    ///
    /// # Errors
    /// If there is no device that serves, or no thread.
    pub fn start(options: EngineOptions) -> Result<Self, EngineError> {
        let (sender, receiver) = mpsc::channel();
        let (ready, is_ready) = mpsc::sync_channel(1);
        let recycled = Arc::<Mutex<Vec<Frame>>>::default();
        let life = Arc::new(Life::default());
        let (frames, lives) = (recycled.clone(), life.clone());
        std::thread::Builder::new().name("afterglow-render".into()).spawn(move || {
            let opened = Gpu::new(&options.gpu).map(|gpu| {
                let info = gpu.info().clone();
                (State::new(gpu, options, frames), info)
            });
            let state = match opened {
                Ok((state, info)) => {
                    let _ = ready.send(Ok(info));
                    state
                }
                Err(error) => {
                    let _ = ready.send(Err(error));
                    return;
                }
            };
            let ending = Ending(lives);
            state.run(&receiver, &ending);
        })?;
        let device = is_ready.recv().map_err(|_| EngineError::Died)??;
        let shared = Shared {
            sender,
            life,
            recycled,
            flushed: FlushedFrames::default(),
            process: std::process::id(),
            last_id: AtomicU64::new(0),
            device,
            sizes: Mutex::default(),
        };
        Ok(Self { shared: Arc::new(shared) })
    }

    /// The device.
    pub fn device(&self) -> &DeviceInfo {
        &self.shared.device
    }

    /// Whether the thread runs, in this process.
    pub fn is_alive(&self) -> bool {
        !self.shared.life.has_ended() && self.shared.process == std::process::id()
    }

    /// Ends the thread after the frame that it draws, and waits for that, though not longer than `patience`.
    pub fn stop(&self, patience: Duration) {
        if self.is_alive() {
            self.shared.life.want_end();
            self.send(Message::Stop);
            self.shared.life.wait_for_end(patience);
        }
    }

    /// A new group of contexts.
    pub fn share_group(&self) -> ShareGroup {
        ShareGroup::new(self.clone(), self.next_id())
    }

    /// Something to draw to, of this size at first.
    pub fn drawable(&self, surface: Surface, size: (u32, u32)) -> Drawable {
        let id = self.next_id();
        self.send(Message::Drawable { drawable: id, surface: surface.clone() });
        Drawable::new(self.clone(), id, surface, size)
    }

    /// Width and height of a window now, pixels. The answer is waited for, on a connection that is not the program's.
    pub(crate) fn window_size(&self, surface: &Surface) -> Option<(u32, u32)> {
        match surface {
            Surface::X11 { display, window } if self.is_alive() => {
                self.shared.sizes.lock().size(display, *window)
            }
            _ => None,
        }
    }

    pub(crate) fn next_id(&self) -> u64 {
        self.shared.last_id.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Sends a message; nobody gets it if the thread is gone.
    pub(crate) fn send(&self, message: Message) {
        if self.is_alive() {
            let _ = self.shared.sender.send(message);
        }
    }

    /// What programs flushed; nothing where nobody will draw it. In a forked process the lock may be held for ever.
    pub(crate) fn flushed(&self) -> Option<&FlushedFrames> {
        self.is_alive().then_some(&self.shared.flushed)
    }

    /// An empty frame, with the memory of an earlier one where possible.
    pub(crate) fn recycled(&self) -> Frame {
        // In a forked process the lock may be held for ever.
        if !self.is_alive() {
            return Frame::default();
        }
        self.shared.recycled.lock().pop().unwrap_or_default()
    }
}

/// Everything that the thread owns.
struct State {
    gpu: Gpu,
    options: EngineOptions,
    recycled: Arc<Mutex<Vec<Frame>>>,
    /// By share group.
    renderers: HashMap<u64, Renderer>,
    /// By drawable.
    windows: HashMap<u64, Window>,
    /// Dropped after all windows.
    servers: Servers,
}

impl State {
    fn new(gpu: Gpu, options: EngineOptions, recycled: Arc<Mutex<Vec<Frame>>>) -> Self {
        Self {
            gpu,
            options,
            recycled,
            renderers: HashMap::new(),
            windows: HashMap::new(),
            servers: Servers::default(),
        }
    }

    /// Handles messages until nobody can send any more, or the thread is not wanted.
    fn run(mut self, messages: &mpsc::Receiver<Message>, ending: &Ending) {
        while let Ok(message) = messages.recv()
            && ending.is_wanted()
        {
            let (group, finished) = match &message {
                Message::Frame { group, drawable, end, .. } => (Some(*group), Some((drawable.clone(), *end))),
                Message::Ask { group, .. } => (Some(*group), None),
                _ => (None, None),
            };
            if catch_unwind(AssertUnwindSafe(|| self.handle(message))).is_err() {
                tracing::error!("a bug in Afterglow: a frame was dropped");
                // Whatever state it is in, it is not to be trusted.
                group.map(|group| self.renderers.remove(&group));
            }
            if let Some((drawable, end)) = finished {
                drawable.shared.queue_of(end).leave();
            }
        }
    }

    fn handle(&mut self, message: Message) {
        match message {
            Message::Drawable { drawable, surface } => {
                self.windows.insert(drawable, Window::new(surface));
            }
            Message::DropDrawable { drawable } => {
                self.windows.remove(&drawable);
                self.renderers.values_mut().for_each(|renderer| renderer.forget(drawable));
            }
            Message::DropGroup { group } => self.drop_group(group),
            Message::Frame { group, drawable, frame, end, handed_over } => {
                self.frame(group, &drawable, frame, end);
                if end != End::Continued {
                    self.present(&drawable);
                    self.note_pace(&drawable, handed_over);
                }
            }
            Message::Ask { group, drawable, frame, request, reply } => {
                let _ = reply.send(self.answer(group, &drawable, frame, request));
            }
            Message::Present { drawable } => self.present(&drawable),
            Message::Stop => {}
        }
    }

    fn frame(&mut self, group: u64, drawable: &Drawable, frame: Frame, end: End) {
        let id = drawable.shared.id;
        if let Some(renderer) = self.renderer(group, id) {
            renderer.submit(frame, end);
            let empty = renderer.recycle();
            let mut recycled = self.recycled.lock();
            if recycled.len() < RECYCLED_FRAMES {
                recycled.push(empty);
            }
        }
    }

    fn note_pace(&mut self, drawable: &Drawable, handed_over: Instant) {
        let Some(window) = self.windows.get_mut(&drawable.shared.id) else { return };
        if let Some((rate, latency)) = window.pace.shown(handed_over, Instant::now()) {
            let (width, height) = drawable.size();
            tracing::info!(
                "{rate:.1} frames a second at {width}x{height}, {latency:.1} ms after the buffer swap"
            );
        }
    }

    fn answer(&mut self, group: u64, drawable: &Drawable, frame: Frame, request: Request) -> Reply {
        match self.renderer(group, drawable.shared.id) {
            Some(renderer) => renderer.answer(frame, request),
            None => Reply::Unavailable,
        }
    }

    /// The renderer of a share group, with a drawable selected.
    fn renderer(&mut self, group: u64, drawable: u64) -> Option<&mut Renderer> {
        if !self.renderers.contains_key(&group) {
            let made = self.make_renderer().map_err(|error| tracing::error!("no renderer: {error}")).ok()?;
            self.renderers.insert(group, made);
        }
        self.carry(drawable, group);
        let renderer = self.renderers.get_mut(&group)?;
        renderer.select(drawable).map_err(|error| tracing::error!("no drawable: {error}")).ok()?;
        if let Some(window) = self.windows.get_mut(&drawable) {
            window.group = Some(group);
        }
        Some(renderer)
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
        let (Some(window), Some(renderer)) = (self.windows.get_mut(&id), self.renderers.get_mut(&group))
        else {
            return;
        };
        let wanted = Wanted { waits_for_blank: drawable.swap_interval() != 0, size: drawable.size() };
        if let Some(size) = window.present(&self.gpu, &mut self.servers, renderer, wanted) {
            drawable.set_size(size);
        }
    }

    fn make_renderer(&self) -> Result<Renderer, afterglow_render::RenderError> {
        let mut renderer = Renderer::new(&self.gpu, &RenderOptions::default())?;
        renderer.set_mode(self.options.mode, &self.options.pathtrace)?;
        Ok(renderer)
    }
}
