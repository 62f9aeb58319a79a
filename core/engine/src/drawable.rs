//! What is drawn to, as contexts and window systems know it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, AtomicU64, Ordering};
use std::time::Duration;

use afterglow_gl::backend::End;
use afterglow_gl::frame::Frame;

use crate::message::Message;
use crate::thread::Engine;

/// Where a drawable's picture goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Surface {
    /// Nowhere: it is only read back (pbuffers, pixmaps).
    None,
    /// A window of an X server.
    X11 {
        /// The server, as in `DISPLAY`.
        display: String,
        /// The window's id.
        window: u32,
    },
}

/// Something to draw to. Its memory on the device is given back when the last clone is gone.
#[derive(Clone)]
pub struct Drawable {
    pub(crate) shared: Arc<Shared>,
}

pub(crate) struct Shared {
    pub(crate) id: u64,
    pub(crate) engine: Engine,
    surface: Surface,
    /// Width in the upper half, height in the lower one.
    size: AtomicU64,
    swap_interval: AtomicI32,
    /// Complete frames.
    queue: Queue,
    /// Parts of frames.
    parts: Queue,
    /// Something was drawn since it was last to be shown.
    pub(crate) is_drawn: AtomicBool,
}

/// Frames that were handed over and not finished.
pub(crate) struct Queue {
    most: u32,
    pending: parking_lot::Mutex<u32>,
    finished: parking_lot::Condvar,
}

/// Frames of a drawable that wait or are being drawn, at most.
const MOST_PENDING: u32 = 2;
/// Parts of frames, likewise: a program that never swaps must not fill the memory.
const MOST_PARTS: u32 = 8;
/// How often a thread that waits for the render thread looks whether that is still there.
const LOOK: Duration = Duration::from_millis(100);

impl Queue {
    fn new(most: u32) -> Self {
        Self { most, pending: parking_lot::Mutex::default(), finished: parking_lot::Condvar::new() }
    }

    /// Waits until there is room for a frame, and takes it. Does not wait for a thread that is gone.
    pub(crate) fn enter(&self, is_alive: impl Fn() -> bool) {
        if !is_alive() {
            return;
        }
        let mut pending = self.pending.lock();
        while *pending >= self.most && is_alive() {
            self.finished.wait_for(&mut pending, LOOK);
        }
        *pending += 1;
    }

    /// A frame is finished.
    pub(crate) fn leave(&self) {
        let mut pending = self.pending.lock();
        *pending = pending.saturating_sub(1);
        self.finished.notify_all();
    }
}

impl Drawable {
    pub(crate) fn new(engine: Engine, id: u64, surface: Surface, size: (u32, u32)) -> Self {
        let shared = Shared {
            id,
            engine,
            surface,
            size: AtomicU64::new(packed(size)),
            swap_interval: AtomicI32::new(1),
            queue: Queue::new(MOST_PENDING),
            parts: Queue::new(MOST_PARTS),
            is_drawn: AtomicBool::new(false),
        };
        Self { shared: Arc::new(shared) }
    }

    /// Width and height in pixels, as far as is known: of a window, what it had when it was last shown.
    pub fn size(&self) -> (u32, u32) {
        let packed = self.shared.size.load(Ordering::Relaxed);
        ((packed >> 32) as u32, packed as u32)
    }

    /// Asks the window system for a window's size and takes note of it.
    pub fn ask_size(&self) -> (u32, u32) {
        if let Some(size) = self.shared.engine.window_size(&self.shared.surface) {
            self.set_size(size);
        }
        self.size()
    }

    /// Takes note of another size.
    pub fn set_size(&self, size: (u32, u32)) {
        self.shared.size.store(packed(size), Ordering::Relaxed);
    }

    /// Vertical blanks between two pictures: 0 does not wait.
    pub fn swap_interval(&self) -> i32 {
        self.shared.swap_interval.load(Ordering::Relaxed)
    }

    /// Sets the vertical blanks between two pictures.
    pub fn set_swap_interval(&self, interval: i32) {
        self.shared.swap_interval.store(interval, Ordering::Relaxed);
    }

    /// Takes note that a frame draws something.
    pub(crate) fn note_operations(&self, frame: &Frame) {
        if !frame.operations.is_empty() {
            self.shared.is_drawn.store(true, Ordering::Release);
        }
    }

    /// Shows what is drawn without a buffer swap: after glFlush of a drawable with one buffer. Programs flush often;
    /// where nothing was drawn since, nothing happens.
    pub fn present(&self) {
        if self.shared.is_drawn.swap(false, Ordering::AcqRel) {
            self.shared.engine.send(Message::Present { drawable: self.clone() });
        }
    }
}

impl Shared {
    /// The queue of frames that end like this.
    pub(crate) fn queue_of(&self, end: End) -> &Queue {
        match end {
            End::Swap => &self.queue,
            End::Continued => &self.parts,
        }
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        self.engine.send(Message::DropDrawable { drawable: self.id });
    }
}

fn packed((width, height): (u32, u32)) -> u64 {
    u64::from(width) << 32 | u64::from(height)
}
