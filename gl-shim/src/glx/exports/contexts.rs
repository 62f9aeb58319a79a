//! Contexts, and what is current.

use std::ffi::{c_int, c_ulong, c_void};
use std::ptr::null_mut;
use std::sync::atomic::Ordering;

use afterglow_api::constants::glx::*;

use super::configs::of_visual;
use super::put;
use crate::boundary::guarded;
use crate::glx::attributes::{self, Attribute, value};
use crate::glx::binding;
use crate::glx::config::{self, Config};
use crate::glx::contexts;
use crate::glx::xlib::{self, Display, VisualInfo, Xid};
use crate::record;

/// The highest version of OpenGL that there are contexts of.
const VERSION: (i32, i32) = (1, 5);

/// glXCreateContext.
pub unsafe fn create_context(
    display: *mut Display,
    visual: *const VisualInfo,
    share: *mut c_void,
) -> *mut c_void {
    // SAFETY: the program vouches for display and visual.
    create(share, || unsafe { of_visual(display, visual) })
}

/// glXCreateNewContext.
pub fn create_new_context(config: *const c_void, render_type: c_int, share: *mut c_void) -> *mut c_void {
    create(share, || config::from_handle(config).filter(|_| render_type as u32 == GLX_RGBA_TYPE))
}

/// glXCreateContextAttribsARB. NULL, without an X error, where the version is not ours: programs ask for less then.
pub unsafe fn create_context_attribs(
    config: *const c_void,
    share: *mut c_void,
    list: *const c_int,
) -> *mut c_void {
    create(share, || {
        // SAFETY: the program vouches for its list.
        let wanted = unsafe { attributes::read(list, &[]) };
        config::from_handle(config).filter(|_| is_served(&wanted))
    })
}

/// Whether there are contexts with such attributes.
fn is_served(wanted: &[Attribute]) -> bool {
    let get = |attribute, default| value(wanted, attribute).unwrap_or(default);
    let version = (get(GLX_CONTEXT_MAJOR_VERSION_ARB, 1), get(GLX_CONTEXT_MINOR_VERSION_ARB, 0));
    let is_forward = get(GLX_CONTEXT_FLAGS_ARB, 0) & GLX_CONTEXT_FORWARD_COMPATIBLE_BIT_ARB as i32 != 0;
    version >= (1, 0)
        && version <= VERSION
        && !is_forward
        && get(GLX_RENDER_TYPE, GLX_RGBA_TYPE as i32) == GLX_RGBA_TYPE as i32
}

fn create(share: *mut c_void, config: impl FnOnce() -> Option<&'static Config>) -> *mut c_void {
    guarded(|| contexts::create(config()?, share))
        .flatten()
        .map_or(null_mut(), |context| std::ptr::without_provenance_mut(context.handle))
}

/// glXDestroyContext.
pub fn destroy_context(context: *mut c_void) {
    guarded(|| contexts::destroy(context));
}

/// glXMakeCurrent and glXMakeContextCurrent.
pub unsafe fn make_current(display: *mut Display, draw: Xid, read: Xid, context: *mut c_void) -> c_int {
    // SAFETY: the program vouches for its display.
    guarded(|| unsafe { binding::make_current(display, draw, read, context) }).unwrap_or(false).into()
}

/// Records the size of what is current for the first time with its context.
pub fn record_drawable_size() {
    if !record::is_on() {
        return;
    }
    binding::with(|binding| {
        if !binding.context.has_recorded_size.swap(true, Ordering::Relaxed) {
            let (width, height) = binding.draw.size();
            record::glx::drawable_size(width, height);
        }
    });
}

/// glXGetCurrentContext.
pub fn get_current_context() -> *mut c_void {
    binding::with(|binding| std::ptr::without_provenance_mut(binding.context.handle)).unwrap_or(null_mut())
}

/// glXGetCurrentDrawable.
pub fn get_current_drawable() -> Xid {
    binding::with(|binding| binding.draw_id).unwrap_or(0)
}

/// glXGetCurrentReadDrawable.
pub fn get_current_read_drawable() -> Xid {
    binding::with(|binding| binding.read_id).unwrap_or(0)
}

/// glXGetCurrentDisplay.
pub fn get_current_display() -> *mut Display {
    binding::with(|binding| std::ptr::with_exposed_provenance_mut(binding.display)).unwrap_or(null_mut())
}

/// glXIsDirect.
pub fn is_direct(context: *mut c_void) -> c_int {
    guarded(|| contexts::get(context).is_some()).unwrap_or(false).into()
}

/// glXCopyContext: not done.
pub fn copy_context(mask: c_ulong) {
    guarded(|| tracing::warn!("glXCopyContext({mask:#x}) copies nothing"));
}

/// glXQueryContext. The result is an error code.
pub unsafe fn query_context(context: *mut c_void, attribute: c_int, value: *mut c_int) -> c_int {
    let Some(context) = guarded(|| contexts::get(context)).flatten() else {
        return GLX_BAD_CONTEXT as c_int;
    };
    let result = match attribute as u32 {
        GLX_RENDER_TYPE => GLX_RGBA_TYPE as i32,
        GLX_FBCONFIG_ID | GLX_SCREEN | GLX_VISUAL_ID => context.config.get(attribute as u32).unwrap_or(0),
        _ => return GLX_BAD_ATTRIBUTE as c_int,
    };
    // SAFETY: the program vouches for its pointer.
    unsafe { put(value, result) };
    0
}

/// glXGetContextIDEXT.
pub fn context_id(context: *const c_void) -> Xid {
    context as usize as Xid
}

/// glXWaitGL.
pub fn wait_gl() {
    guarded(|| {
        binding::with_gl(|_, gl| {
            binding::flushed(gl);
            gl.finish();
        })
    });
}

/// glXWaitX.
pub unsafe fn wait_x() {
    guarded(|| {
        let display = binding::with(|binding| binding.display).map(std::ptr::with_exposed_provenance_mut);
        if let (Some(display), Some(xlib)) =
            (display.filter(|display: &*mut Display| !display.is_null()), xlib::get())
        {
            // SAFETY: the program keeps the display of what is current open.
            unsafe { (xlib.sync)(display, 0) };
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_above_ours_are_refused() {
        let version = |major, minor| {
            is_served(&[(GLX_CONTEXT_MAJOR_VERSION_ARB, major), (GLX_CONTEXT_MINOR_VERSION_ARB, minor)])
        };
        assert!(is_served(&[]) && version(1, 0) && version(1, 5));
        assert!(!version(1, 6) && !version(2, 1) && !version(3, 0) && !version(0, 9));
        let forward = GLX_CONTEXT_FORWARD_COMPATIBLE_BIT_ARB as i32;
        assert!(!is_served(&[(GLX_CONTEXT_FLAGS_ARB, forward)]));
    }
}
