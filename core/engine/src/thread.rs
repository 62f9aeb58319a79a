//! The thread that owns the device.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, mpsc};
use std::time::Duration;

use afterglow_gl::frame::Frame;
use afterglow_gpu::{DeviceInfo, Gpu, GpuError};
use parking_lot::Mutex;

use crate::drawable::{Drawable, Surface};
use crate::flushed::FlushedFrames;
use crate::life::{Ending, Life};
use crate::message::Message;
use crate::options::{EngineOptions, OptionsSource};
use crate::port::ShareGroup;
use crate::state::State;
use crate::xcb::Servers;

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
    /// Another one whenever all that is on the device is lost.
    device_number: Arc<AtomicU64>,
    /// Asked for the sizes of windows by threads that draw.
    sizes: Mutex<Servers>,
}

impl Engine {
    /// Opens the device and starts the thread.
    ///
    /// # Errors
    /// If there is no device that serves, or no thread.
    pub fn start(options: EngineOptions) -> Result<Self, EngineError> {
        Self::start_with(options, None)
    }

    /// Likewise, with options that may change while the thread runs.
    ///
    /// # Errors
    /// As [`Engine::start`].
    pub fn start_with(
        options: EngineOptions,
        source: Option<Box<dyn OptionsSource>>,
    ) -> Result<Self, EngineError> {
        let (sender, receiver) = mpsc::channel();
        let (ready, is_ready) = mpsc::sync_channel(1);
        let recycled = Arc::<Mutex<Vec<Frame>>>::default();
        let life = Arc::new(Life::default());
        let device_number = Arc::<AtomicU64>::default();
        let (frames, lives, number) = (recycled.clone(), life.clone(), device_number.clone());
        std::thread::Builder::new().name("afterglow-render".into()).spawn(move || {
            let opened = Gpu::new(&options.gpu).map(|gpu| {
                let info = gpu.info().clone();
                (State::new(gpu, options, source, frames, number), info)
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
            device_number,
            sizes: Mutex::default(),
        };
        Ok(Self { shared: Arc::new(shared) })
    }

    /// The device that was found first.
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

    /// The number of the device that images are on now.
    pub(crate) fn device_number(&self) -> u64 {
        self.shared.device_number.load(Ordering::Acquire)
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
