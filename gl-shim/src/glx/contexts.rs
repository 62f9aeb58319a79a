//! Contexts that exist, by handle.

use std::cell::UnsafeCell;
use std::collections::HashMap;
use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use afterglow_engine::{Port, ShareGroup};
use afterglow_gl::backend::{Discard, NullBackend};
use afterglow_gl::{Context, SharedNames};
use parking_lot::Mutex;

use super::config::Config;
use super::errors::Fault;
use super::render;
use crate::current;

/// Contexts that exist at a time.
const MOST_CONTEXTS: usize = 1024;
/// Handles are no addresses; they are this far apart, and never come again.
const HANDLE_STEP: usize = 16;

/// Contexts that share names.
pub struct Group {
    names: SharedNames,
    /// Nothing without a render thread.
    pub shared: Option<ShareGroup>,
}

impl Group {
    fn new() -> Self {
        match render::engine() {
            Some(engine) => {
                let shared = engine.share_group();
                Self { names: shared.names(), shared: Some(shared) }
            }
            None => Self { names: SharedNames::default(), shared: None },
        }
    }
}

/// A context.
pub struct GlxContext {
    /// What programs know it by.
    pub handle: usize,
    /// Its configuration.
    pub config: &'static Config,
    /// Whom it shares names with.
    pub group: Arc<Group>,
    /// Where its frames go; nothing without a render thread.
    pub port: Option<Port>,
    is_current: AtomicBool,
    /// Its first drawable's size is in the recording.
    pub has_recorded_size: AtomicBool,
    gl: UnsafeCell<Context>,
}

// SAFETY: `gl` is only used by the thread that has the context current (`claim`).
unsafe impl Send for GlxContext {}
// SAFETY: as above.
unsafe impl Sync for GlxContext {}

impl GlxContext {
    fn new(handle: usize, config: &'static Config, group: Arc<Group>) -> Self {
        let port = group.shared.as_ref().map(Port::new);
        let gl = match &port {
            Some(port) => Context::new(Box::new(port.clone()), group.names.clone()),
            None if render::is_noop() => Context::new(Box::<Discard>::default(), group.names.clone()),
            None => Context::new(Box::new(NullBackend), group.names.clone()),
        };
        Self {
            handle,
            config,
            group,
            port,
            is_current: AtomicBool::new(false),
            has_recorded_size: AtomicBool::new(false),
            gl: UnsafeCell::new(gl),
        }
    }

    /// Makes the context the calling thread's alone; `false` if it is a thread's already.
    pub fn claim(&self) -> bool {
        self.is_current.compare_exchange(false, true, Ordering::Acquire, Ordering::Relaxed).is_ok()
    }

    /// Ends a claim.
    pub fn release(&self) {
        self.is_current.store(false, Ordering::Release);
    }

    /// The context itself, for the thread that has claimed it.
    pub fn gl(&self) -> *mut Context {
        self.gl.get()
    }
}

static CONTEXTS: Mutex<Contexts> = Mutex::new(Contexts { by_handle: None, last: 0 });

struct Contexts {
    by_handle: Option<HashMap<usize, Arc<GlxContext>>>,
    last: usize,
}

/// The context of a handle, which may be garbage.
pub fn get(handle: *const c_void) -> Option<Arc<GlxContext>> {
    CONTEXTS.lock().by_handle.as_ref()?.get(&(handle as usize)).cloned()
}

/// Makes a context that shares names with another one, unless that is null.
///
/// # Errors
/// If that is garbage, or there are too many contexts.
pub fn create(config: &'static Config, share: *const c_void) -> Result<Arc<GlxContext>, Fault> {
    let group = match share.is_null() {
        true => Arc::new(Group::new()),
        false => get(share).ok_or(Fault::BadContext)?.group.clone(),
    };
    let mut contexts = CONTEXTS.lock();
    let Contexts { by_handle, last } = &mut *contexts;
    let by_handle = by_handle.get_or_insert_default();
    if by_handle.len() >= MOST_CONTEXTS {
        return Err(Fault::BadAlloc);
    }
    *last += HANDLE_STEP;
    let context = Arc::new(GlxContext::new(*last, config, group));
    by_handle.insert(*last, context.clone());
    Ok(context)
}

/// Takes a context's handle away, if there is such a one; the context lives on while it is current.
pub fn destroy(handle: *const c_void) -> bool {
    // Not in the statement's temporary: dropping a context takes other locks.
    let removed = CONTEXTS.lock().by_handle.as_mut().and_then(|contexts| contexts.remove(&(handle as usize)));
    removed.is_some()
}

/// Copies groups of state, which `mask` names as glPushAttrib's does, from one context to another.
///
/// # Errors
/// If there are no such contexts, the second one is current, or the first one is current in another thread.
pub fn copy(source: *const c_void, destination: *const c_void, mask: u32) -> Result<(), Fault> {
    let (source, destination) = match (get(source), get(destination)) {
        (Some(source), Some(destination)) => (source, destination),
        _ => return Err(Fault::BadContext),
    };
    if !destination.claim() {
        return Err(Fault::BadAccess);
    }
    let is_own = current::get() == source.gl();
    let copied = if is_own || source.claim() {
        // SAFETY: both are the calling thread's alone, and differ: none can be claimed twice, or be current and claimed.
        let (from, to) = unsafe { (&mut *source.gl(), &mut *destination.gl()) };
        to.copy_state(from, mask);
        if !is_own {
            source.release();
        }
        Ok(())
    } else {
        Err(Fault::BadAccess)
    };
    destination.release();
    copied
}

#[cfg(test)]
mod tests {
    use std::ptr::{null, without_provenance};

    use afterglow_api::constants::*;

    use super::super::config::{Visual, all, keep};
    use super::*;

    #[test]
    fn handles_come_and_go() {
        let config = &keep(all(0, &[Visual { id: 0x93, depth: 24 }]))[0];
        let garbage = without_provenance(0x1235);
        assert!(get(garbage).is_none() && create(config, garbage).is_err());
        assert!(!destroy(garbage));
        let first = create(config, null()).unwrap();
        let second = create(config, without_provenance(first.handle)).unwrap();
        assert!(Arc::ptr_eq(&first.group, &second.group) && first.handle != second.handle);
        destroy(without_provenance(second.handle));
        drop(second);
        assert!(get(without_provenance(first.handle)).is_some());
        destroy(without_provenance(first.handle));
        assert!(get(without_provenance(first.handle)).is_none());
    }

    #[test]
    fn state_is_copied() {
        let config = &keep(all(0, &[Visual { id: 0x96, depth: 24 }]))[0];
        let [source, destination] = [(); 2].map(|()| create(config, null()).unwrap());
        let handle = |context: &GlxContext| without_provenance(context.handle);
        // SAFETY: no other thread knows the contexts.
        let (from, to) = unsafe { (&mut *source.gl(), &mut *destination.gl()) };
        from.line_width(3.0);
        from.point_size(5.0);
        assert_eq!(copy(handle(&source), handle(&destination), GL_LINE_BIT), Ok(()));
        assert_eq!((to.get_float(GL_LINE_WIDTH), to.get_float(GL_POINT_SIZE)), (vec![3.0], vec![1.0]));
        assert_eq!(copy(handle(&source), handle(&source), GL_LINE_BIT), Err(Fault::BadAccess));
        assert_eq!(copy(handle(&source), without_provenance(0x1239), 0), Err(Fault::BadContext));
        assert!(source.claim() && destination.claim());
        assert!(destroy(handle(&source)) && destroy(handle(&destination)));
    }

    #[test]
    fn one_thread_has_a_context() {
        let config = &keep(all(0, &[Visual { id: 0x94, depth: 24 }]))[0];
        let context = create(config, null()).unwrap();
        assert!(context.claim() && !context.claim());
        context.release();
        assert!(context.claim());
        assert!(destroy(without_provenance(context.handle)));
    }
}
