//! What programs flushed of frames that go on.
//!
//! A frame that is handed over in parts costs more than a whole one, and many programs flush before they swap. So what
//! is flushed waits here for the rest of its frame, until another context of the same share group, or one that draws
//! to the same drawable, has something for the render thread: that comes after it.

use afterglow_gl::frame::Frame;
use parking_lot::Mutex;

use crate::drawable::Drawable;

/// Words of vertices that wait of one context, at most.
const MOST_WORDS: usize = 1 << 22;

/// What a context flushed.
pub(crate) struct Flushed {
    /// The context's port.
    pub(crate) port: u64,
    /// Its share group.
    pub(crate) group: u64,
    pub(crate) drawable: Drawable,
    pub(crate) frame: Frame,
}

/// What all contexts flushed.
#[derive(Default)]
pub(crate) struct FlushedFrames {
    waiting: Mutex<Vec<Flushed>>,
}

impl FlushedFrames {
    /// Keeps what a context flushed, after what it flushed before. It is given back if it is too much.
    pub(crate) fn keep(&self, mut flushed: Flushed) -> Option<Flushed> {
        let mut waiting = self.waiting.lock();
        if let Some(before) = waiting.iter().position(|before| before.port == flushed.port) {
            let before = waiting.swap_remove(before).frame;
            let mut later = std::mem::replace(&mut flushed.frame, before);
            flushed.frame.append(&mut later);
        }
        if flushed.frame.words.len() > MOST_WORDS {
            return Some(flushed);
        }
        waiting.push(flushed);
        None
    }

    /// What a context flushed.
    pub(crate) fn take(&self, port: u64) -> Option<Flushed> {
        let mut waiting = self.waiting.lock();
        let own = waiting.iter().position(|flushed| flushed.port == port)?;
        Some(waiting.swap_remove(own))
    }

    /// Sends what others flushed that must come before something of this context.
    pub(crate) fn send_others(&self, port: u64, group: u64, drawable: &Drawable, send: impl Fn(Flushed)) {
        let mut waiting = self.waiting.lock();
        let comes_first = |other: &mut Flushed| {
            let meets = other.group == group || other.drawable.shared.id == drawable.shared.id;
            other.port != port && meets
        };
        // Sent under the lock: what their contexts hand over next comes after it.
        waiting.extract_if(.., comes_first).for_each(send);
    }
}
