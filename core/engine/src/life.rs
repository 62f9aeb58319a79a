//! Whether the render thread goes on.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use parking_lot::{Condvar, Mutex};

/// Whether the thread is to go on, and whether it does.
pub(crate) struct Life {
    is_wanted: AtomicBool,
    has_ended: AtomicBool,
    lock: Mutex<()>,
    ended: Condvar,
}

impl Default for Life {
    fn default() -> Self {
        Self {
            is_wanted: AtomicBool::new(true),
            has_ended: AtomicBool::new(false),
            lock: Mutex::default(),
            ended: Condvar::new(),
        }
    }
}

impl Life {
    /// Whether the thread is gone.
    pub(crate) fn has_ended(&self) -> bool {
        self.has_ended.load(Ordering::Relaxed)
    }

    /// Says that the thread is not wanted.
    pub(crate) fn want_end(&self) {
        self.is_wanted.store(false, Ordering::Relaxed);
    }

    /// Waits until the thread has ended, though not longer than `patience`.
    pub(crate) fn wait_for_end(&self, patience: Duration) {
        let mut lock = self.lock.lock();
        self.ended.wait_while_for(&mut lock, |()| !self.has_ended(), patience);
    }
}

/// Says that the thread is gone when it is dropped, however the thread ended.
pub(crate) struct Ending(pub(crate) Arc<Life>);

impl Ending {
    /// Whether the thread is to go on.
    pub(crate) fn is_wanted(&self) -> bool {
        self.0.is_wanted.load(Ordering::Relaxed)
    }
}

impl Drop for Ending {
    fn drop(&mut self) {
        let _lock = self.0.lock.lock();
        self.0.has_ended.store(true, Ordering::Relaxed);
        self.0.ended.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_is_waited_for() {
        let life = Arc::new(Life::default());
        let ending = Ending(life.clone());
        life.wait_for_end(Duration::from_millis(1));
        assert!(ending.is_wanted() && !life.has_ended());
        life.want_end();
        let thread = std::thread::spawn(move || assert!(!ending.is_wanted()));
        life.wait_for_end(Duration::from_secs(60));
        assert!(life.has_ended());
        thread.join().unwrap();
    }
}
