//! How far a program may be ahead of the render thread.

use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use parking_lot::{Condvar, Mutex};

/// How often a thread that waits for the render thread looks whether that is still there.
const LOOK: Duration = Duration::from_millis(100);

/// Frames that were handed over and not finished.
///
/// The render thread must never wait for the program here: a program's signal handler may end the process, and with
/// it the render thread, while the thread that it interrupted has the lock.
pub(crate) struct Queue {
    most: u32,
    pending: AtomicU32,
    lock: Mutex<()>,
    finished: Condvar,
}

impl Queue {
    pub(crate) fn new(most: u32) -> Self {
        Self { most, pending: AtomicU32::new(0), lock: Mutex::new(()), finished: Condvar::new() }
    }

    /// Waits until there is room for a frame, and takes it. Does not wait for a thread that is gone.
    pub(crate) fn enter(&self, is_alive: impl Fn() -> bool) {
        if self.is_full() && is_alive() {
            let mut lock = self.lock.lock();
            while self.is_full() && is_alive() {
                self.finished.wait_for(&mut lock, LOOK);
            }
        }
        self.enter_full();
    }

    /// Takes room for a frame where there may be none.
    pub(crate) fn enter_full(&self) {
        self.pending.fetch_add(1, Ordering::AcqRel);
    }

    /// A frame is finished.
    pub(crate) fn leave(&self) {
        self.pending.fetch_sub(1, Ordering::AcqRel);
        // Whoever has the lock either sees the number or looks again.
        drop(self.lock.try_lock());
        self.finished.notify_all();
    }

    fn is_full(&self) -> bool {
        self.pending.load(Ordering::Acquire) >= self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_queue_is_waited_for() {
        let queue = std::sync::Arc::new(Queue::new(2));
        queue.enter(|| true);
        queue.enter(|| true);
        assert!(queue.is_full());
        queue.enter(|| false);
        queue.leave();
        let waiting = queue.clone();
        let thread = std::thread::spawn(move || waiting.enter(|| true));
        queue.leave();
        thread.join().unwrap();
        assert!(queue.is_full());
    }

    #[test]
    fn leaving_does_not_wait_for_the_lock() {
        let queue = Queue::new(1);
        queue.enter(|| true);
        let _held = queue.lock.lock();
        queue.leave();
        assert!(!queue.is_full());
    }
}
