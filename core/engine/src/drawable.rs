//! What is drawn to, as contexts and window systems know it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, AtomicU64, Ordering};

use afterglow_gl::backend::End;
use afterglow_gl::frame::Frame;

use crate::message::Message;
use crate::queue::Queue;
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

/// Frames of a drawable that wait or are being drawn, at most.
const MOST_PENDING: u32 = 2;
/// Parts of frames, likewise: a program that never swaps must not fill the memory.
const MOST_PARTS: u32 = 8;

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

    /// Takes note of a frame, or a part of one, that is handed over. At its end, other than a part's, it is shown.
    pub(crate) fn note_operations(&self, frame: &Frame, end: End) {
        match end {
            End::Continued if frame.operations.is_empty() => {}
            end => self.shared.is_drawn.store(end == End::Continued, Ordering::Release),
        }
    }

    /// Whether something was drawn that has not been shown. From now on it counts as shown.
    pub fn take_drawn(&self) -> bool {
        self.shared.is_drawn.swap(false, Ordering::AcqRel)
    }

    /// Shows what is drawn without a buffer swap. Programs flush often; where nothing was drawn since, nothing happens.
    pub fn present(&self) {
        if self.take_drawn() {
            self.shared.engine.send(Message::Present { drawable: self.clone() });
        }
    }
}

impl Shared {
    /// The queue of frames that end like this.
    pub(crate) fn queue_of(&self, end: End) -> &Queue {
        match end {
            End::Swap => &self.queue,
            End::Continued | End::Over => &self.parts,
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
