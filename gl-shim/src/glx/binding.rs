//! What is current on a thread: a context, and what it draws to and reads from (GLX 1.4 specification, 3.3.7).

use std::cell::{Cell, RefCell};
use std::ffi::c_void;
use std::ptr::null_mut;
use std::sync::Arc;

use afterglow_gl::Context;

use super::contexts::{self, GlxContext};
use super::drawables::{self, GlxDrawable};
use super::xlib::{Display, Xid};
use crate::boundary::guarded;
use crate::current;

/// What a thread has current. It ends when it is dropped, with the thread at the latest.
pub struct Binding {
    /// The display, as the program gave it.
    pub display: usize,
    /// The id of what is drawn to.
    pub draw_id: Xid,
    /// The id of what is read from.
    pub read_id: Xid,
    /// The context.
    pub context: Arc<GlxContext>,
    /// What is drawn to.
    pub draw: Arc<GlxDrawable>,
    /// The viewport for which the window's size was asked last.
    asked: Cell<(i32, i32)>,
}

thread_local! {
    static BINDING: RefCell<Option<Binding>> = const { RefCell::new(None) };
}

/// Calls `call` with what the calling thread has current; nothing if there is nothing.
pub fn with<T>(call: impl FnOnce(&Binding) -> T) -> Option<T> {
    BINDING.try_with(|binding| binding.borrow().as_ref().map(call)).ok().flatten()
}

/// As [`with`], with the context itself.
pub fn with_gl<T>(call: impl FnOnce(&Binding, &mut Context) -> T) -> Option<T> {
    with(|binding| {
        // SAFETY: the calling thread has claimed the context, and no call of the program is under way.
        call(binding, unsafe { &mut *binding.context.gl() })
    })
}

impl Binding {
    fn is(&self, display: *mut Display, draw: Xid, read: Xid, context: *const c_void) -> bool {
        self.context.handle == context as usize
            && self.draw_id == draw
            && self.read_id == read
            && self.display == display as usize
    }

    fn new(
        display: usize,
        context: Arc<GlxContext>,
        (draw_id, draw): (Xid, Arc<GlxDrawable>),
        (read_id, read): (Xid, Arc<GlxDrawable>),
    ) -> Self {
        let (width, height) = draw.size();
        if let Some(port) = &context.port {
            port.bind(draw.target().cloned(), read.target().cloned());
        }
        draw.drawn_by(&context.group);
        // SAFETY: the calling thread has claimed the context.
        unsafe { &mut *context.gl() }.set_drawable(width, height);
        current::set(context.gl());
        Self { display, draw_id, read_id, context, draw, asked: Cell::default() }
    }

    /// Whether what is drawn shows without a buffer swap.
    pub fn is_single(&self) -> bool {
        !self.draw.config.unwrap_or(self.context.config).is_double
    }
}

impl Drop for Binding {
    fn drop(&mut self) {
        guarded(|| {
            current::set(null_mut());
            // SAFETY: the calling thread has claimed the context; its pointer is not current any more.
            unsafe { &mut *self.context.gl() }.hand_over_so_far();
            if let Some(port) = &self.context.port {
                port.bind(None, None);
            }
        });
        self.context.release();
    }
}

/// Makes a context current, or none if it is null. `false` if that is not possible: what was current stays so.
///
/// # Safety
/// `display` is null or open.
pub unsafe fn make_current(display: *mut Display, draw: Xid, read: Xid, context: *const c_void) -> bool {
    if with(|binding| binding.is(display, draw, read, context)) == Some(true) {
        return true;
    }
    if context.is_null() {
        return replace(|| None);
    }
    let Some(context) = contexts::get(context) else { return false };
    // SAFETY: the caller vouches for the display.
    let find = |id| unsafe {
        let found = drawables::get_or_window(display, id)?;
        if !found.refresh_size(display) {
            // X will give the id to another window.
            drawables::destroy(display, id);
            return None;
        }
        Some((id, found))
    };
    let Some(drawn) = find(draw) else { return false };
    let Some(read) = (if read == draw { Some(drawn.clone()) } else { find(read) }) else { return false };
    let is_own = with(|binding| Arc::ptr_eq(&binding.context, &context)) == Some(true);
    if !is_own && !context.claim() {
        return false;
    }
    replace(|| {
        // The claim of a thread's own context ended with its binding.
        (!is_own || context.claim()).then(|| Binding::new(display as usize, context, drawn, read))
    }) && with(|_| ()).is_some()
}

/// Ends what is current, and then makes and keeps another one. `false` if the thread is ending.
fn replace(make: impl FnOnce() -> Option<Binding>) -> bool {
    let replaced = BINDING.try_with(|slot| {
        let former = slot.borrow_mut().take();
        drop(former);
        *slot.borrow_mut() = make();
    });
    replaced.is_ok()
}

/// Swaps the buffers of a drawable.
pub fn swap(display: *mut Display, drawable: Xid) {
    let own = with(|binding| binding.draw_id == drawable && binding.display == display as usize);
    if own == Some(true) {
        with_gl(|binding, gl| {
            gl.swap_buffers();
            binding.draw.shown();
            let (width, height) = binding.draw.size();
            gl.set_drawable(width, height);
        });
    } else if let Some(drawable) = drawables::get(display, drawable) {
        drawable.swap();
    }
}

/// What glFlush and glFinish of the current context, `gl`, do beyond it: single-buffered drawing shows, and contexts
/// that share its names see what it did.
pub fn flushed(gl: &mut Context) {
    with(|binding| {
        if binding.is_single() {
            if gl.hand_over_so_far()
                && let Some(target) = binding.draw.target()
            {
                target.present();
                binding.draw.shown();
                let (width, height) = target.size();
                gl.set_drawable(width, height);
            }
        } else if binding.context.is_shared() {
            gl.hand_over_so_far();
        }
    });
}

/// What glViewport of the current context, `gl`, does beyond it. A program that was told of its window's new size comes
/// here before the render thread has seen that size.
pub fn viewport_set(gl: &mut Context, width: i32, height: i32) {
    let wanted = (width, height);
    let (known_width, known_height) = gl.drawable();
    if (known_width as i32, known_height as i32) == wanted {
        return;
    }
    with(|binding| {
        // Viewports that are smaller for another reason come again and again.
        if binding.asked.replace(wanted) != wanted
            && let Some(target) = binding.draw.target()
        {
            let (width, height) = target.ask_size();
            gl.set_drawable(width, height);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn garbage_is_refused() {
        let garbage = std::ptr::without_provenance(0x5555);
        // SAFETY: without a context, the display is not used.
        assert!(!unsafe { make_current(null_mut(), 1, 1, garbage) });
        // SAFETY: as above.
        assert!(unsafe { make_current(null_mut(), 0, 0, std::ptr::null()) });
        assert!(with(|_| ()).is_none());
        swap(null_mut(), 1);
    }
}
