//! What is current on a thread: a context, and what it draws to and reads from (GLX 1.4 specification, 3.3.7).

use std::cell::{Cell, RefCell};
use std::ffi::c_void;
use std::ptr::null_mut;
use std::rc::Rc;
use std::sync::Arc;

use afterglow_engine::Port;
use afterglow_gl::Context;

use super::contexts::{self, GlxContext};
use super::drawables::{self, GlxDrawable, Kind};
use super::errors::Fault;
use super::xlib::{Display, Xid};
use super::{displays, pixmaps, render};
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
    static BINDING: RefCell<Option<Rc<Binding>>> = const { RefCell::new(None) };
}

/// Calls `call` with what the calling thread has current; nothing if there is nothing.
pub fn with<T>(call: impl FnOnce(&Binding) -> T) -> Option<T> {
    // It is kept for the call: a signal handler of the program's may make another context current meanwhile.
    let binding = BINDING.try_with(|binding| binding.borrow().clone()).ok().flatten()?;
    Some(call(&binding))
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
        let buffers = draw.config.unwrap_or(context.config).buffers();
        if let Some(target) = draw.target().filter(|_| !buffers.is_double) {
            // Flushes come often, and do not wait for the screen.
            target.set_swap_interval(0);
        }
        // SAFETY: the calling thread has claimed the context.
        let gl = unsafe { &mut *context.gl() };
        gl.set_buffers(buffers);
        gl.set_drawable(width, height);
        gl.set_reads_elsewhere(context.port.as_ref().is_some_and(Port::reads_elsewhere));
        current::set(context.gl());
        Self { display, draw_id, read_id, context, draw, asked: Cell::default() }
    }

    /// What glFlush does beyond the context: drawing shows where no buffer swap will show it, and others see it.
    fn flush(&self, gl: &mut Context) {
        let shows_at_once = gl.shows_at_once();
        if let Kind::Pixmap { pixmap } = self.draw.kind {
            gl.hand_over_picture();
            self.publish(pixmap);
        } else if shows_at_once {
            gl.hand_over_picture();
            render::note_picture();
            if let Some(target) = self.draw.target() {
                target.present();
                let (width, height) = target.size();
                gl.set_drawable(width, height);
            }
        } else {
            gl.flush_so_far();
        }
    }

    /// Copies what was drawn to the pixmap of X.
    fn publish(&self, pixmap: Xid) {
        let (Some(target), Some(port)) = (self.draw.target(), &self.context.port) else { return };
        let display: *mut Display = std::ptr::with_exposed_provenance_mut(self.display);
        // A display that was closed meanwhile took the pixmap with it.
        if !displays::is_open(display) || !target.take_drawn() {
            return;
        }
        if let Some(pixels) = port.clone().colors() {
            // SAFETY: it is open.
            unsafe { pixmaps::put(display, pixmap, self.draw.size(), &pixels) };
        }
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

/// Makes a context current, or none if it is null.
///
/// # Errors
/// What is not possible; what was current stays so.
///
/// # Safety
/// `display` is null or open.
pub unsafe fn make_current(
    display: *mut Display,
    draw: Xid,
    read: Xid,
    context: *const c_void,
) -> Result<(), Fault> {
    if with(|binding| binding.is(display, draw, read, context)) == Some(true) {
        return Ok(());
    }
    if context.is_null() {
        return match (draw, read) {
            (0, 0) => replace(|| None),
            _ => Err(Fault::BadMatch),
        };
    }
    let context = contexts::get(context).ok_or(Fault::BadContext)?;
    if draw == 0 || read == 0 {
        return Err(Fault::BadMatch);
    }
    // SAFETY: the caller vouches for the display.
    let find = |id| unsafe {
        let found = drawables::get_or_window(display, id).ok_or(Fault::BadDrawable)?;
        if !found.refresh_size(display) {
            // X will give the id to another window.
            drawables::destroy(display, id);
            return Err(Fault::BadDrawable);
        }
        Ok((id, found))
    };
    let drawn = find(draw)?;
    let read = if read == draw { drawn.clone() } else { find(read)? };
    let is_own = with(|binding| Arc::ptr_eq(&binding.context, &context)) == Some(true);
    if !is_own && !context.claim() {
        return Err(Fault::BadAccess);
    }
    replace(|| {
        // The claim of a thread's own context ended with its binding.
        (!is_own || context.claim()).then(|| Binding::new(display as usize, context, drawn, read))
    })?;
    with(|_| ()).ok_or(Fault::BadAccess)
}

/// Ends what is current, and then makes and keeps another one. An error if the thread is ending.
fn replace(make: impl FnOnce() -> Option<Binding>) -> Result<(), Fault> {
    // What is no longer current is flushed (3.3.7).
    with_gl(Binding::flush);
    let replaced = BINDING.try_with(|slot| {
        let former = slot.borrow_mut().take();
        drop(former);
        let new = make().map(Rc::new);
        *slot.borrow_mut() = new;
    });
    replaced.map_err(|_| Fault::BadAccess)
}

/// Swaps the buffers of a drawable. Where there is only one, what is drawn shows all the same.
pub fn swap(display: *mut Display, drawable: Xid) {
    let own = with(|binding| binding.draw_id == drawable && binding.display == display as usize);
    if own == Some(true) {
        with_gl(|binding, gl| {
            if !binding.draw.config.unwrap_or(binding.context.config).is_double {
                return binding.flush(gl);
            }
            gl.swap_buffers();
            render::note_picture();
            if let Kind::Pixmap { pixmap } = binding.draw.kind {
                binding.publish(pixmap);
            }
            let (width, height) = binding.draw.size();
            gl.set_drawable(width, height);
        });
    } else if let Some(drawable) = drawables::get(display, drawable) {
        drawable.swap();
    }
}

/// What glFlush and glFinish of the current context, `gl`, do beyond it: what is drawn where it shows at once is shown,
/// and other contexts see what this one did.
pub fn flushed(gl: &mut Context) {
    with(|binding| binding.flush(gl));
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
    use std::ptr::{null, without_provenance, without_provenance_mut};

    use afterglow_api::constants::*;

    use super::super::config::{Config, Visual, all, keep};
    use super::*;

    const CONFIG: Config = Config {
        id: 1,
        screen: 0,
        visual: Visual { id: 1, depth: 24 },
        is_double: true,
        depth: 24,
        stencil: 8,
        accum: 0,
    };

    /// A display's address that nothing is read from: pbuffers are not asked about.
    fn display(number: usize) -> *mut Display {
        without_provenance_mut(number)
    }

    fn pbuffer(display: *mut Display, size: (u32, u32)) -> Xid {
        // SAFETY: the display of pbuffers is not used.
        unsafe { drawables::create(display, Kind::Pbuffer, &CONFIG, String::new(), size) }
    }

    fn bind(display: *mut Display, drawable: Xid, context: usize) -> bool {
        // SAFETY: as above.
        unsafe { make_current(display, drawable, drawable, without_provenance(context)) }.is_ok()
    }

    #[test]
    fn garbage_is_refused() {
        assert!(!bind(null_mut(), 1, 0x5555));
        assert!(bind(null_mut(), 0, 0));
        assert!(with(|_| ()).is_none());
        swap(null_mut(), 1);
    }

    #[test]
    fn what_is_current_follows_the_program() {
        let display = display(0x70);
        let (small, large) = (pbuffer(display, (8, 4)), pbuffer(display, (80, 40)));
        let context = contexts::create(&CONFIG, null()).unwrap();
        assert!(bind(display, small, context.handle) && bind(display, small, context.handle));
        assert_eq!(current::get(), context.gl());
        assert_eq!(with_gl(|_, gl| gl.drawable()), Some((8, 4)));
        assert!(!bind(display, 0xffff_0000, context.handle) && !bind(display, large, 0x5555));
        assert_eq!(with(|binding| binding.draw_id), Some(small));
        assert!(bind(display, large, context.handle));
        assert_eq!(with_gl(|_, gl| gl.drawable()), Some((80, 40)));
        swap(display, large);
        swap(display, small);
        assert!(bind(display, 0, 0));
        assert!(current::get().is_null() && with(|_| ()).is_none());
    }

    #[test]
    fn a_context_is_current_in_one_thread_at_a_time() {
        let address = 0x71;
        let drawable = pbuffer(display(address), (8, 4));
        let context = contexts::create(&CONFIG, null()).unwrap().handle;
        let elsewhere = move || std::thread::spawn(move || bind(display(address), drawable, context)).join();
        // Threads that end release what they have.
        assert!(elsewhere().unwrap() && elsewhere().unwrap());
        assert!(bind(display(address), drawable, context));
        assert!(!elsewhere().unwrap());
        assert!(bind(display(address), 0, 0));
        assert!(elsewhere().unwrap());
    }

    #[test]
    fn what_is_destroyed_lives_while_it_is_current() {
        let display = display(0x72);
        let drawable = pbuffer(display, (8, 4));
        let context = contexts::create(&CONFIG, null()).unwrap().handle;
        assert!(bind(display, drawable, context));
        contexts::destroy(without_provenance(context));
        drawables::destroy(display, drawable);
        assert_eq!(with_gl(|_, gl| gl.get_error()), Some(0));
        swap(display, drawable);
        assert!(bind(display, 0, 0));
        assert!(!bind(display, drawable, context));
    }

    #[test]
    fn queries_follow_the_configuration() {
        let table = keep(all(0, &[Visual { id: 0x95, depth: 24 }]));
        let display = display(0x73);
        for config in table {
            let context = contexts::create(config, null()).unwrap().handle;
            // SAFETY: as above.
            let drawable =
                unsafe { drawables::create(display, Kind::Pbuffer, config, String::new(), (1, 1)) };
            assert!(bind(display, drawable, context));
            let names = [GL_DOUBLEBUFFER, GL_DEPTH_BITS, GL_STENCIL_BITS, GL_ACCUM_RED_BITS];
            let bits = with_gl(|_, gl| names.map(|name| gl.get_integer(name)[0]));
            assert_eq!(bits, Some([config.is_double.into(), config.depth, config.stencil, config.accum]));
            let buffer = if config.is_double { GL_BACK } else { GL_FRONT };
            assert_eq!(with_gl(|_, gl| gl.get_integer(GL_DRAW_BUFFER)), Some(vec![buffer as i32]));
        }
        assert!(bind(display, 0, 0));
    }
}
