//! Things that were dropped while the device might still use them.

use std::collections::VecDeque;

use parking_lot::Mutex;

use crate::gpu::Shared;

type Destroy = Box<dyn FnOnce(&Shared) + Send>;

/// What is to be destroyed, each with the timeline value after which nothing uses it.
#[derive(Default)]
pub(crate) struct Garbage {
    queue: Mutex<VecDeque<(u64, Destroy)>>,
}

impl Garbage {
    pub(crate) fn push(&self, after: u64, destroy: Destroy) {
        self.queue.lock().push_back((after, destroy));
    }

    /// Destroys what the device has finished with, in the order of dropping.
    pub(crate) fn collect(&self, shared: &Shared, completed: u64) {
        // The lock is given back before each call: destroying one thing may drop another.
        while let Some(destroy) = self.pop(completed) {
            destroy(shared);
        }
    }

    pub(crate) fn run_all(&self, shared: &Shared) {
        self.collect(shared, u64::MAX);
    }

    /// How many things wait.
    pub(crate) fn len(&self) -> usize {
        self.queue.lock().len()
    }

    fn pop(&self, completed: u64) -> Option<Destroy> {
        let mut queue = self.queue.lock();
        if queue.front()?.0 > completed {
            return None;
        }
        queue.pop_front().map(|(_, destroy)| destroy)
    }
}
