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
use crate::glx::errors::{self, Fault, Request};
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
    unsafe {
        create(display, share, Request::CreateContext, || of_visual(display, visual).ok_or(Fault::BadValue))
    }
}

/// glXCreateNewContext.
pub unsafe fn create_new_context(
    display: *mut Display,
    config: *const c_void,
    render_type: c_int,
    share: *mut c_void,
) -> *mut c_void {
    let found = || {
        let config = config::from_handle(config).ok_or(Fault::BadFBConfig)?;
        match render_type as u32 {
            GLX_RGBA_TYPE => Ok(config),
            GLX_COLOR_INDEX_TYPE => Err(Fault::BadMatch),
            _ => Err(Fault::BadValue),
        }
    };
    // SAFETY: the program vouches for its display.
    unsafe { create(display, share, Request::CreateNewContext, found) }
}

/// glXCreateContextAttribsARB. NULL where the version is not ours: programs ask for less then.
pub unsafe fn create_context_attribs(
    display: *mut Display,
    config: *const c_void,
    share: *mut c_void,
    list: *const c_int,
) -> *mut c_void {
    let found = || {
        let config = config::from_handle(config).ok_or(Fault::BadFBConfig)?;
        // SAFETY: the program vouches for its list.
        let wanted = unsafe { attributes::read(list, &[]) };
        check(&wanted).map(|()| config)
    };
    // SAFETY: the program vouches for its display.
    unsafe { create(display, share, Request::CreateContextAttribs, found) }
}

/// Whether there are contexts with such attributes.
fn check(wanted: &[Attribute]) -> Result<(), Fault> {
    const FORWARD: u32 = GLX_CONTEXT_FORWARD_COMPATIBLE_BIT_ARB;
    const FLAGS: u32 = GLX_CONTEXT_DEBUG_BIT_ARB | FORWARD;
    let is_known = |attribute| {
        matches!(
            attribute,
            GLX_CONTEXT_MAJOR_VERSION_ARB
                | GLX_CONTEXT_MINOR_VERSION_ARB
                | GLX_CONTEXT_FLAGS_ARB
                | GLX_CONTEXT_PROFILE_MASK_ARB
                | GLX_RENDER_TYPE
        )
    };
    let get = |attribute, default| value(wanted, attribute).unwrap_or(default);
    let flags = get(GLX_CONTEXT_FLAGS_ARB, 0) as u32;
    if !wanted.iter().all(|(attribute, _)| is_known(*attribute)) || flags & !FLAGS != 0 {
        return Err(Fault::BadValue);
    }
    // Which of the two is of no matter to versions before 3.2.
    let profile = get(GLX_CONTEXT_PROFILE_MASK_ARB, GLX_CONTEXT_CORE_PROFILE_BIT_ARB as i32) as u32;
    if !matches!(profile, GLX_CONTEXT_CORE_PROFILE_BIT_ARB | GLX_CONTEXT_COMPATIBILITY_PROFILE_BIT_ARB) {
        return Err(Fault::BadProfile);
    }
    let version = (get(GLX_CONTEXT_MAJOR_VERSION_ARB, 1), get(GLX_CONTEXT_MINOR_VERSION_ARB, 0));
    let is_ours = ((1, 0)..=VERSION).contains(&version) && flags & FORWARD == 0;
    let is_rgba = get(GLX_RENDER_TYPE, GLX_RGBA_TYPE as i32) == GLX_RGBA_TYPE as i32;
    if is_ours && is_rgba { Ok(()) } else { Err(Fault::BadMatch) }
}

/// A new context's handle; null, and an X error, if there is none.
///
/// # Safety
/// `display` is null or open.
unsafe fn create(
    display: *mut Display,
    share: *mut c_void,
    request: Request,
    config: impl FnOnce() -> Result<&'static Config, Fault>,
) -> *mut c_void {
    let made = guarded(|| contexts::create(config()?, share).map(|context| context.handle));
    match made.unwrap_or(Err(Fault::BadAlloc)) {
        Ok(handle) => std::ptr::without_provenance_mut(handle),
        Err(fault) => {
            // SAFETY: the caller vouches for the display.
            guarded(|| unsafe { errors::raise(display, fault, request, 0) });
            null_mut()
        }
    }
}

/// glXDestroyContext.
pub fn destroy_context(context: *mut c_void) {
    guarded(|| contexts::destroy(context));
}

/// glXMakeCurrent and glXMakeContextCurrent. An X error if the context is not current then.
pub unsafe fn make_current(
    display: *mut Display,
    (draw, read): (Xid, Xid),
    context: *mut c_void,
    request: Request,
) -> c_int {
    // SAFETY: the program vouches for its display.
    let done = guarded(|| unsafe { binding::make_current(display, draw, read, context) });
    let done = done.unwrap_or(Err(Fault::BadAlloc));
    if let Err(fault) = done {
        // SAFETY: as above.
        guarded(|| unsafe { errors::raise(display, fault, request, draw) });
    }
    done.is_ok().into()
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

/// glXCopyContext.
pub unsafe fn copy_context(
    display: *mut Display,
    source: *mut c_void,
    destination: *mut c_void,
    mask: c_ulong,
) {
    let copied = guarded(|| contexts::copy(source, destination, mask as u32)).unwrap_or(Ok(()));
    if let Err(fault) = copied {
        // SAFETY: the program vouches for its display.
        guarded(|| unsafe { errors::raise(display, fault, Request::CopyContext, 0) });
    }
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
    fn what_is_not_served_is_told_by_its_fault() {
        let version = |major, minor| {
            check(&[(GLX_CONTEXT_MAJOR_VERSION_ARB, major), (GLX_CONTEXT_MINOR_VERSION_ARB, minor)])
        };
        assert!([check(&[]), version(1, 0), version(1, 5)].iter().all(Result::is_ok));
        for (major, minor) in [(1, 6), (2, 1), (3, 0), (0, 9), (-1, 0), (1, -1)] {
            assert_eq!(version(major, minor), Err(Fault::BadMatch), "{major}.{minor}");
        }
        let flags = |flags: u32| check(&[(GLX_CONTEXT_FLAGS_ARB, flags as i32)]);
        assert_eq!(flags(GLX_CONTEXT_DEBUG_BIT_ARB), Ok(()));
        assert_eq!(flags(GLX_CONTEXT_FORWARD_COMPATIBLE_BIT_ARB), Err(Fault::BadMatch));
        assert_eq!(flags(0x80), Err(Fault::BadValue));
        let profile = |mask| check(&[(GLX_CONTEXT_PROFILE_MASK_ARB, mask)]);
        assert_eq!([profile(1), profile(2)], [Ok(()); 2]);
        assert_eq!([profile(0), profile(3), profile(4)], [Err(Fault::BadProfile); 3]);
        assert_eq!(check(&[(GLX_SAMPLE_BUFFERS, 0)]), Err(Fault::BadValue));
    }
}
