//! Windows, pixmaps and pbuffers that are drawn to, by display and id.

use std::collections::HashMap;
use std::sync::atomic::{AtomicI32, AtomicU32, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock, Weak};

use afterglow_engine::{Drawable, Port, Surface};
use afterglow_gl::backend::{Backend, End};
use afterglow_gl::frame::Frame;
use parking_lot::Mutex;

use super::config::Config;
use super::contexts::Group;
use super::xlib::{self, Display, Xid};
use super::{displays, render};

/// Drawables that exist at a time.
const MOST_DRAWABLES: usize = 4096;
/// From so many on, windows that are gone are looked for.
const PRUNED_FROM: usize = 16;
/// The first id that no X server gives: theirs have 29 bits.
const FIRST_ID: u32 = 1 << 29;

/// What a drawable is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A window that a program made current by its X id, or with glXCreateWindow.
    Window {
        /// Its X id.
        window: Xid,
    },
    /// A pixmap.
    Pixmap {
        /// Its X id.
        pixmap: Xid,
    },
    /// A pbuffer.
    Pbuffer,
}

/// Something to draw to.
pub struct GlxDrawable {
    /// What it is.
    pub kind: Kind,
    /// Its configuration; that of the context for a plain window.
    pub config: Option<&'static Config>,
    /// Mask of glXSelectEvent. No events are sent.
    pub event_mask: AtomicUsize,
    server: String,
    /// Width and height where there is no render thread.
    size: Mutex<(u32, u32)>,
    interval: AtomicI32,
    /// Made when it is first current.
    target: OnceLock<Option<Drawable>>,
    /// Whose contexts drew to it last.
    group: Mutex<Weak<Group>>,
}

impl GlxDrawable {
    fn new(kind: Kind, config: Option<&'static Config>, server: String, size: (u32, u32)) -> Self {
        Self {
            kind,
            config,
            event_mask: AtomicUsize::new(0),
            server,
            size: Mutex::new(size),
            interval: AtomicI32::new(1),
            target: OnceLock::new(),
            group: Mutex::default(),
        }
    }

    /// What the render thread knows it as.
    pub fn target(&self) -> Option<&Drawable> {
        self.target
            .get_or_init(|| {
                let surface = match self.kind {
                    Kind::Window { window } => {
                        Surface::X11 { display: self.server.clone(), window: window as u32 }
                    }
                    Kind::Pixmap { .. } | Kind::Pbuffer => Surface::None,
                };
                let target = render::engine()?.drawable(surface, *self.size.lock());
                target.set_swap_interval(self.interval());
                Some(target)
            })
            .as_ref()
    }

    /// Width and height, pixels.
    pub fn size(&self) -> (u32, u32) {
        self.target.get().and_then(Option::as_ref).map_or_else(|| *self.size.lock(), Drawable::size)
    }

    /// Asks X for a window's size; `false` if there is no such window.
    ///
    /// # Safety
    /// `display` is open.
    pub unsafe fn refresh_size(&self, display: *mut Display) -> bool {
        let Kind::Window { window } = self.kind else { return true };
        // SAFETY: the caller vouches for the display.
        let Some(size) = xlib::get().and_then(|xlib| unsafe { xlib.size(display, window) }) else {
            return false;
        };
        *self.size.lock() = size;
        if let Some(target) = self.target.get().and_then(Option::as_ref) {
            target.set_size(size);
        }
        true
    }

    /// Vertical blanks between two pictures.
    pub fn interval(&self) -> i32 {
        self.interval.load(Ordering::Relaxed)
    }

    /// Sets the vertical blanks between two pictures.
    pub fn set_interval(&self, interval: i32) {
        self.interval.store(interval, Ordering::Relaxed);
        if let Some(target) = self.target.get().and_then(Option::as_ref) {
            target.set_swap_interval(interval);
        }
    }

    /// Takes note that a context of a group draws to it.
    pub fn drawn_by(&self, group: &Arc<Group>) {
        *self.group.lock() = Arc::downgrade(group);
    }

    /// Swaps buffers where no context of the calling thread draws: shows what was handed over so far.
    pub fn swap(&self) {
        let Some(group) = self.group.lock().upgrade() else { return };
        let (Some(shared), Some(target)) = (&group.shared, self.target()) else { return };
        let mut port = Port::new(shared);
        port.bind(Some(target.clone()), None);
        let frame = Frame { size: target.size(), device: port.device(), ..Frame::default() };
        port.submit(frame, End::Swap);
    }
}

/// By display's address and id.
type Key = (usize, Xid);

struct Drawables {
    by_key: Option<HashMap<Key, Arc<GlxDrawable>>>,
    /// How many there may be before windows that are gone are looked for.
    prune_at: usize,
}

static DRAWABLES: Mutex<Drawables> = Mutex::new(Drawables { by_key: None, prune_at: PRUNED_FROM });

/// A drawable that is known.
pub fn get(display: *mut Display, id: Xid) -> Option<Arc<GlxDrawable>> {
    DRAWABLES.lock().by_key.as_ref()?.get(&(display as usize, id)).cloned()
}

/// A drawable that is known, or a window of X. Nothing if there is neither.
///
/// # Safety
/// `display` is null or open.
pub unsafe fn get_or_window(display: *mut Display, id: Xid) -> Option<Arc<GlxDrawable>> {
    if let Some(known) = get(display, id) {
        return Some(known);
    }
    if id == 0 || id >= Xid::from(FIRST_ID) {
        return None;
    }
    // SAFETY: the caller vouches for the display.
    let server = unsafe { displays::get(display) }?.server.clone();
    // SAFETY: as above, and it is not null.
    let size = xlib::get().and_then(|xlib| unsafe { xlib.size(display, id) })?;
    let made = Arc::new(GlxDrawable::new(Kind::Window { window: id }, None, server, size));
    // SAFETY: as above.
    unsafe { insert(display, id, made) }
}

/// Makes a drawable with an id of its own; 0 if there are too many.
///
/// # Safety
/// `display` is open.
pub unsafe fn create(
    display: *mut Display,
    kind: Kind,
    config: &'static Config,
    server: String,
    size: (u32, u32),
) -> Xid {
    static LAST: AtomicU32 = AtomicU32::new(FIRST_ID);
    let id = Xid::from(LAST.fetch_add(1, Ordering::Relaxed).max(FIRST_ID) + 1);
    let made = Arc::new(GlxDrawable::new(kind, Some(config), server, size));
    // SAFETY: the caller vouches for the display.
    unsafe { insert(display, id, made) }.map_or(0, |_| id)
}

/// # Safety
/// `display` is open.
unsafe fn insert(display: *mut Display, id: Xid, made: Arc<GlxDrawable>) -> Option<Arc<GlxDrawable>> {
    if DRAWABLES.lock().is_full() {
        // SAFETY: the caller vouches for the display.
        unsafe { prune(display) };
    }
    let mut drawables = DRAWABLES.lock();
    let by_key = drawables.by_key.get_or_insert_default();
    if by_key.len() >= MOST_DRAWABLES {
        return None;
    }
    Some(by_key.entry((display as usize, id)).or_insert(made).clone())
}

impl Drawables {
    fn is_full(&self) -> bool {
        self.by_key.as_ref().map_or(0, HashMap::len) >= self.prune_at
    }
}

/// Forgets windows of a display that X does not have any more.
///
/// # Safety
/// `display` is open.
unsafe fn prune(display: *mut Display) {
    let Some(xlib) = xlib::get() else { return };
    let candidates: Vec<(Key, Xid)> = {
        let drawables = DRAWABLES.lock();
        let of_display = drawables.by_key.iter().flatten().filter(|((of, _), _)| *of == display as usize);
        of_display
            .filter(|(_, drawable)| Arc::strong_count(drawable) == 1)
            .filter_map(|(key, drawable)| match drawable.kind {
                Kind::Window { window } => Some((*key, window)),
                Kind::Pixmap { .. } | Kind::Pbuffer => None,
            })
            .collect()
    };
    // SAFETY: the caller vouches for the display.
    let is_gone = |window| unsafe { xlib.size(display, window) }.is_none();
    let gone: Vec<Key> =
        candidates.into_iter().filter(|(_, window)| is_gone(*window)).map(|(key, _)| key).collect();
    let mut drawables = DRAWABLES.lock();
    let by_key = drawables.by_key.get_or_insert_default();
    let removed: Vec<_> = gone.iter().filter_map(|key| by_key.remove(key)).collect();
    let left = by_key.len();
    drawables.prune_at = PRUNED_FROM.max(left + PRUNED_FROM);
    drop(drawables);
    drop(removed);
}

/// Forgets a drawable, and returns it if it was known; it lives on while it is current.
pub fn destroy(display: *mut Display, id: Xid) -> Option<Arc<GlxDrawable>> {
    DRAWABLES.lock().by_key.as_mut().and_then(|drawables| drawables.remove(&(display as usize, id)))
}

/// Forgets all drawables of a display.
pub fn forget_display(display: *mut Display) {
    let of_display = |key: &Key| key.0 == display as usize;
    let removed: Vec<_> = match &mut DRAWABLES.lock().by_key {
        Some(drawables) => drawables.extract_if(|key, _| of_display(key)).collect(),
        None => return,
    };
    drop(removed);
}

#[cfg(test)]
mod tests {
    use super::super::config::{Visual, all, keep};
    use super::*;

    #[test]
    fn drawables_come_and_go() {
        let config = &keep(all(0, &[Visual { id: 0x91, depth: 24 }]))[0];
        let display = std::ptr::without_provenance_mut(0x1230);
        // SAFETY: with so few drawables, the display is not used.
        let make = || unsafe { create(display, Kind::Pbuffer, config, String::new(), (8, 4)) };
        let (first, second) = (make(), make());
        assert!(first >= Xid::from(FIRST_ID) && second != first);
        assert_eq!(get(display, first).unwrap().size(), (8, 4));
        assert!(get(std::ptr::null_mut(), first).is_none() && get(display, 77).is_none());
        assert!(destroy(display, first).is_some() && destroy(display, first).is_none());
        assert!(get(display, first).is_none() && get(display, second).is_some());
        forget_display(display);
        assert!(get(display, second).is_none());
    }
}
