//! What is drawn to, as contexts and window systems know it.

use std::sync::Arc;
use std::sync::atomic::{AtomicI32, AtomicU64, Ordering};
use std::time::Duration;

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
    /// Width in the upper half, height in the lower one.
    size: AtomicU64,
    swap_interval: AtomicI32,
    pub(crate) queue: Queue,
}

/// Frames that were handed over and not finished.
#[derive(Default)]
pub(crate) struct Queue {
    pending: parking_lot::Mutex<u32>,
    finished: parking_lot::Condvar,
}

/// How long to wait before looking whether the render thread is still there.
const PATIENCE: Duration = Duration::from_millis(200);
/// Frames of a drawable that wait or are being drawn, at most.
const MOST_PENDING: u32 = 2;

impl Queue {
    /// Waits until there is room for a frame, and takes it. `is_served` says whether anybody still makes room.
    pub(crate) fn enter(&self, is_served: impl Fn() -> bool) {
        let mut pending = self.pending.lock();
        while *pending >= MOST_PENDING && is_served() {
            self.finished.wait_for(&mut pending, PATIENCE);
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
    pub(crate) fn new(engine: Engine, id: u64, size: (u32, u32)) -> Self {
        let shared = Shared {
            id,
            engine,
            size: AtomicU64::new(packed(size)),
            swap_interval: AtomicI32::new(1),
            queue: Queue::default(),
        };
        Self { shared: Arc::new(shared) }
    }

    /// Width and height in pixels, as far as is known: of a window, what it had when it was last shown.
    pub fn size(&self) -> (u32, u32) {
        let packed = self.shared.size.load(Ordering::Relaxed);
        ((packed >> 32) as u32, packed as u32)
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

    /// Shows what is drawn without a buffer swap: after glFlush of a drawable with one buffer.
    pub fn present(&self) {
        self.shared.engine.send(Message::Present { drawable: self.clone() });
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_queue_holds_two_and_does_not_wait_for_nobody() {
        let queue = Queue::default();
        queue.enter(|| true);
        queue.enter(|| true);
        // Nobody serves it any more: it is full, and lets go.
        queue.enter(|| false);
        std::thread::scope(|scope| {
            let third = scope.spawn(|| queue.enter(|| true));
            queue.leave();
            queue.leave();
            third.join().unwrap();
        });
        assert_eq!(*queue.pending.lock(), 2);
    }
}
