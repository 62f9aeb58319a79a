//! The traced program's contexts: who shares names with whom, and which is current on which thread.

use std::collections::HashMap;

use afterglow_gl::backend::Backend;
use afterglow_gl::{Context, SharedNames};

use crate::DrawableSizes;
use crate::window::WindowCall;

/// Makes the backend of a context when it is first current. The argument is its number, as in
/// [`FrameEnd::context`](crate::FrameEnd::context).
pub type BackendFactory = Box<dyn FnMut(usize) -> Box<dyn Backend> + Send>;

/// Contexts that exist at a time; no program has more, but a hostile trace may.
const MOST_CONTEXTS: usize = 256;

/// All contexts, by handle and by thread.
pub(crate) struct Contexts {
    slots: Vec<Slot>,
    by_handle: HashMap<u64, usize>,
    current: HashMap<u32, Current>,
    /// The slot of the thread that called last, to be found without a look-up.
    recent: Option<(u32, usize)>,
    sizes: DrawableSizes,
    factory: BackendFactory,
}

struct Slot {
    /// Made when it is first current, and gone once it is destroyed and no longer current.
    gl: Option<Box<Context>>,
    names: SharedNames,
    doomed: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
struct Current {
    slot: usize,
    drawable: u64,
}

impl Contexts {
    pub fn new(sizes: DrawableSizes, factory: BackendFactory) -> Contexts {
        Contexts {
            slots: Vec::new(),
            by_handle: HashMap::new(),
            current: HashMap::new(),
            recent: None,
            sizes,
            factory,
        }
    }

    /// The context that is current on a thread.
    #[inline]
    pub fn current(&mut self, thread: u32) -> Option<&mut Context> {
        let slot = self.current_slot(thread)?;
        self.slots[slot].gl.as_deref_mut()
    }

    /// Which context is current on a thread, as a number that no other context ever has.
    #[inline]
    pub fn current_slot(&mut self, thread: u32) -> Option<usize> {
        match self.recent {
            Some((recent, slot)) if recent == thread => Some(slot),
            _ => {
                let slot = self.current.get(&thread)?.slot;
                self.recent = Some((thread, slot));
                Some(slot)
            }
        }
    }

    /// Plays a call of a window system; the slot of the context whose frame it ends. `None` also where a
    /// swap meets no context.
    pub fn play(&mut self, thread: u32, call: WindowCall) -> Option<usize> {
        match call {
            WindowCall::Create { context, share } => {
                let names = self.slot(share).map(|slot| self.slots[slot].names.clone());
                self.create(context, names.unwrap_or_default());
            }
            WindowCall::Destroy { context } => self.destroy(context),
            WindowCall::MakeCurrent { drawable, context } => self.make_current(thread, drawable, context),
            WindowCall::Swap { drawable } => return self.swap(thread, drawable),
            WindowCall::Share { from, to } => self.share(from, to),
            WindowCall::Nothing => {}
        }
        None
    }

    fn slot(&self, handle: u64) -> Option<usize> {
        self.by_handle.get(&handle).copied()
    }

    fn create(&mut self, handle: u64, names: SharedNames) -> usize {
        let slot = self.slots.len();
        self.slots.push(Slot { gl: None, names, doomed: false });
        // A handle of a context that is gone may come again.
        if let Some(former) = self.by_handle.insert(handle, slot) {
            self.doom(former);
        }
        slot
    }

    fn destroy(&mut self, handle: u64) {
        if let Some(slot) = self.by_handle.remove(&handle) {
            self.doom(slot);
        }
    }

    fn doom(&mut self, slot: usize) {
        self.slots[slot].doomed = true;
        self.bury(slot);
    }

    /// Ends a doomed context unless it is current somewhere.
    fn bury(&mut self, slot: usize) {
        if self.slots[slot].doomed && !self.current.values().any(|current| current.slot == slot) {
            self.slots[slot].gl = None;
        }
    }

    fn make_current(&mut self, thread: u32, drawable: u64, handle: u64) {
        let wanted = (handle != 0).then(|| Current {
            // One that was made before the trace began, perhaps.
            slot: self.slot(handle).unwrap_or_else(|| self.create(handle, SharedNames::default())),
            drawable,
        });
        let former = self.current.get(&thread).copied();
        if wanted == former {
            return;
        }
        self.recent = None;
        if let Some(former) = former {
            // Releasing a context flushes it (GLX 1.4 specification, 3.3.7).
            if let Some(gl) = self.slots[former.slot].gl.as_deref_mut() {
                gl.flush();
            }
            self.current.remove(&thread);
            self.bury(former.slot);
        }
        if let Some(wanted) = wanted {
            self.current.insert(thread, wanted);
            self.bind(wanted);
        }
    }

    fn bind(&mut self, Current { slot, drawable }: Current) {
        let (width, height) = self.sizes.of(drawable);
        if self.slots[slot].gl.is_none()
            && self.slots.iter().filter(|s| s.gl.is_some()).count() >= MOST_CONTEXTS
        {
            return;
        }
        let Slot { gl, names, .. } = &mut self.slots[slot];
        let factory = &mut self.factory;
        let gl = gl.get_or_insert_with(|| Box::new(Context::new(factory(slot), names.clone())));
        gl.set_drawable(width, height);
    }

    fn swap(&mut self, thread: u32, drawable: u64) -> Option<usize> {
        let own = self.current.get(&thread).filter(|current| current.drawable == drawable);
        let other = || self.current.values().find(|current| current.drawable == drawable);
        let slot = own.or_else(other)?.slot;
        self.slots[slot].gl.as_deref_mut()?.swap_buffers();
        Some(slot)
    }

    fn share(&mut self, from: u64, to: u64) {
        let (Some(from), Some(to)) = (self.slot(from), self.slot(to)) else { return };
        // wglShareLists is for contexts without names of their own: one in use keeps those that it has.
        if self.slots[to].gl.is_none() {
            self.slots[to].names = self.slots[from].names.clone();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_gl::backend::NullBackend;

    fn contexts() -> Contexts {
        Contexts::new(DrawableSizes::all(8, 8), Box::new(|_| Box::new(NullBackend)))
    }

    fn make_current(contexts: &mut Contexts, thread: u32, drawable: u64, context: u64) {
        contexts.play(thread, WindowCall::MakeCurrent { drawable, context });
    }

    #[test]
    fn each_thread_has_its_context() {
        let mut contexts = contexts();
        assert!(contexts.current(0).is_none());
        contexts.play(0, WindowCall::Create { context: 10, share: 0 });
        contexts.play(0, WindowCall::Create { context: 11, share: 0 });
        make_current(&mut contexts, 0, 1, 10);
        make_current(&mut contexts, 1, 2, 11);
        assert_eq!((contexts.current_slot(0), contexts.current_slot(1)), (Some(0), Some(1)));
        assert_eq!(contexts.current_slot(0), Some(0));
        assert_eq!(contexts.play(0, WindowCall::Swap { drawable: 2 }), Some(1));
        assert_eq!(contexts.play(0, WindowCall::Swap { drawable: 3 }), None);
        make_current(&mut contexts, 0, 0, 0);
        assert!(contexts.current(0).is_none() && contexts.current(1).is_some());
    }

    #[test]
    fn names_are_shared_where_the_program_said_so() {
        let mut contexts = contexts();
        contexts.play(0, WindowCall::Create { context: 10, share: 0 });
        contexts.play(0, WindowCall::Create { context: 11, share: 10 });
        contexts.play(0, WindowCall::Create { context: 12, share: 0 });
        contexts.play(0, WindowCall::Create { context: 13, share: 0 });
        contexts.play(0, WindowCall::Share { from: 10, to: 13 });
        make_current(&mut contexts, 0, 1, 10);
        let list = contexts.current(0).unwrap().gen_lists(1);
        let is_list = |contexts: &mut Contexts, context| {
            make_current(contexts, 0, 1, context);
            contexts.current(0).unwrap().is_list(list)
        };
        assert!(is_list(&mut contexts, 11) && is_list(&mut contexts, 13));
        assert!(!is_list(&mut contexts, 12));
    }

    #[test]
    fn there_are_not_arbitrarily_many() {
        let mut contexts = contexts();
        for handle in 1..=MOST_CONTEXTS as u64 {
            make_current(&mut contexts, 0, 1, handle);
            assert!(contexts.current(0).is_some());
        }
        make_current(&mut contexts, 0, 1, 1 << 40);
        assert!(contexts.current(0).is_none());
    }

    #[test]
    fn a_destroyed_context_lives_while_it_is_current() {
        let mut contexts = contexts();
        contexts.play(0, WindowCall::Create { context: 10, share: 0 });
        make_current(&mut contexts, 0, 1, 10);
        contexts.play(0, WindowCall::Destroy { context: 10 });
        assert!(contexts.current(0).is_some());
        make_current(&mut contexts, 0, 0, 0);
        assert!(contexts.slots[0].gl.is_none());
        // The handle comes again, for another context.
        contexts.play(0, WindowCall::Create { context: 10, share: 0 });
        make_current(&mut contexts, 0, 1, 10);
        assert_eq!(contexts.current_slot(0), Some(1));
    }
}
