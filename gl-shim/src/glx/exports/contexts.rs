//! Contexts, and what is current.

use std::ffi::{c_int, c_ulong, c_void};
use std::ptr::null_mut;

use afterglow_api::constants::glx::*;
use afterglow_api::id;

use super::configs::of_visual;
use super::put;
use crate::boundary::guarded;
use crate::glx::attributes::{self, Attribute, value};
use crate::glx::binding;
use crate::glx::config::{self, Config};
use crate::glx::contexts;
use crate::glx::errors::{self, Fault, Request};
use crate::glx::recording::{self, boolean, pointer};
use crate::glx::xlib::{self, Display, VisualInfo, Xid};
use crate::record::glx::Value;

/// The highest version of OpenGL that there are contexts of.
const VERSION: (i32, i32) = (1, 5);

/// glXCreateContext.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXCreateContext(
    display: *mut Display,
    visual: *const VisualInfo,
    share: *mut c_void,
    direct: c_int,
) -> *mut c_void {
    // SAFETY: the program vouches for display and visual.
    let context = unsafe {
        create(display, share, Request::CreateContext, || of_visual(display, visual).ok_or(Fault::BadValue))
    };
    // SAFETY: as above.
    unsafe {
        recording::with_visual(visual, |visual| {
            let arguments = [pointer(display), visual, pointer(share), boolean(direct)];
            recording::call(id::glXCreateContext, &arguments, Some(pointer(context)));
        });
    }
    context
}

/// glXCreateNewContext.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXCreateNewContext(
    display: *mut Display,
    config: *const c_void,
    render_type: c_int,
    share: *mut c_void,
    direct: c_int,
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
    let context = unsafe { create(display, share, Request::CreateNewContext, found) };
    let given = [display.cast_const().cast(), config, share.cast_const()];
    recording::new_context(id::glXCreateNewContext, given, Some(render_type), direct, context);
    context
}

/// glXCreateContextWithConfigSGIX.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXCreateContextWithConfigSGIX(
    display: *mut Display,
    config: *const c_void,
    render_type: c_int,
    share: *mut c_void,
    direct: c_int,
) -> *mut c_void {
    // SAFETY: the same function.
    unsafe { glXCreateNewContext(display, config, render_type, share, direct) }
}

/// glXCreateContextAttribsARB. NULL where the version is not ours: programs ask for less then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXCreateContextAttribsARB(
    display: *mut Display,
    config: *const c_void,
    share: *mut c_void,
    direct: c_int,
    list: *const c_int,
) -> *mut c_void {
    let found = || {
        let config = config::from_handle(config).ok_or(Fault::BadFBConfig)?;
        // SAFETY: the program vouches for its list.
        let wanted = unsafe { attributes::read(list, &[]) };
        check(&wanted).map(|()| config)
    };
    // SAFETY: the program vouches for its display.
    let context = unsafe { create(display, share, Request::CreateContextAttribs, found) };
    let given = [display.cast_const().cast(), config, share.cast_const()];
    recording::new_context(id::glXCreateContextAttribsARB, given, None, direct, context);
    context
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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXDestroyContext(display: *mut Display, context: *mut c_void) {
    guarded(|| contexts::destroy(context));
    recording::call(id::glXDestroyContext, &[pointer(display), pointer(context)], None);
}

/// glXFreeContextEXT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXFreeContextEXT(_: *mut Display, context: *mut c_void) {
    guarded(|| contexts::destroy(context));
}

/// glXMakeCurrent.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXMakeCurrent(display: *mut Display, drawable: Xid, context: *mut c_void) -> c_int {
    // SAFETY: the program vouches for its display.
    let done = unsafe { make_current(display, (drawable, drawable), context, Request::MakeCurrent) };
    let arguments = [pointer(display), Value::Id(drawable), pointer(context)];
    recording::call(id::glXMakeCurrent, &arguments, Some(Value::Bool(done)));
    recording::made_current();
    done.into()
}

/// glXMakeContextCurrent.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXMakeContextCurrent(
    display: *mut Display,
    draw: Xid,
    read: Xid,
    context: *mut c_void,
) -> c_int {
    // SAFETY: the program vouches for its display.
    let done = unsafe { make_current(display, (draw, read), context, Request::MakeContextCurrent) };
    let arguments = [pointer(display), Value::Id(draw), Value::Id(read), pointer(context)];
    recording::call(id::glXMakeContextCurrent, &arguments, Some(Value::Bool(done)));
    recording::made_current();
    done.into()
}

/// Whether a context is current now; an X error if not.
///
/// # Safety
/// `display` is null or open.
unsafe fn make_current(
    display: *mut Display,
    (draw, read): (Xid, Xid),
    context: *mut c_void,
    request: Request,
) -> bool {
    // SAFETY: the caller vouches for the display.
    let done = guarded(|| unsafe { binding::make_current(display, draw, read, context) });
    let done = done.unwrap_or(Err(Fault::BadAlloc));
    if let Err(fault) = done {
        // SAFETY: as above.
        guarded(|| unsafe { errors::raise(display, fault, request, draw) });
    }
    done.is_ok()
}

/// glXMakeCurrentReadSGI.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXMakeCurrentReadSGI(
    display: *mut Display,
    draw: Xid,
    read: Xid,
    context: *mut c_void,
) -> c_int {
    // SAFETY: the same function.
    unsafe { glXMakeContextCurrent(display, draw, read, context) }
}

/// glXGetCurrentContext.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXGetCurrentContext() -> *mut c_void {
    binding::with(|binding| std::ptr::without_provenance_mut(binding.context.handle)).unwrap_or(null_mut())
}

/// glXGetCurrentDrawable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXGetCurrentDrawable() -> Xid {
    binding::with(|binding| binding.draw_id).unwrap_or(0)
}

/// glXGetCurrentReadDrawable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXGetCurrentReadDrawable() -> Xid {
    binding::with(|binding| binding.read_id).unwrap_or(0)
}

/// glXGetCurrentReadDrawableSGI.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXGetCurrentReadDrawableSGI() -> Xid {
    // SAFETY: the same function.
    unsafe { glXGetCurrentReadDrawable() }
}

/// glXGetCurrentDisplay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXGetCurrentDisplay() -> *mut Display {
    binding::with(|binding| std::ptr::with_exposed_provenance_mut(binding.display)).unwrap_or(null_mut())
}

/// glXGetCurrentDisplayEXT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXGetCurrentDisplayEXT() -> *mut Display {
    // SAFETY: the same function.
    unsafe { glXGetCurrentDisplay() }
}

/// glXIsDirect.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXIsDirect(_: *mut Display, context: *mut c_void) -> c_int {
    guarded(|| contexts::get(context).is_some()).unwrap_or(false).into()
}

/// glXCopyContext.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXCopyContext(
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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXQueryContext(
    _: *mut Display,
    context: *mut c_void,
    attribute: c_int,
    value: *mut c_int,
) -> c_int {
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

/// glXQueryContextInfoEXT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXQueryContextInfoEXT(
    display: *mut Display,
    context: *mut c_void,
    attribute: c_int,
    value: *mut c_int,
) -> c_int {
    // SAFETY: the same function.
    unsafe { glXQueryContext(display, context, attribute, value) }
}

/// glXGetContextIDEXT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXGetContextIDEXT(context: *const c_void) -> Xid {
    context as usize as Xid
}

/// glXWaitGL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXWaitGL() {
    guarded(|| {
        binding::with_gl(|_, gl| {
            binding::flushed(gl);
            gl.finish();
        })
    });
}

/// glXWaitX.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXWaitX() {
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
