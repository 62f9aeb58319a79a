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
    let context = create(share, || unsafe { of_visual(display, visual) });
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
    let context =
        create(share, || config::from_handle(config).filter(|_| render_type as u32 == GLX_RGBA_TYPE));
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

/// glXCreateContextAttribsARB. NULL, without an X error, where the version is not ours: programs ask for less then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXCreateContextAttribsARB(
    display: *mut Display,
    config: *const c_void,
    share: *mut c_void,
    direct: c_int,
    list: *const c_int,
) -> *mut c_void {
    let context = create(share, || {
        // SAFETY: the program vouches for its list.
        let wanted = unsafe { attributes::read(list, &[]) };
        config::from_handle(config).filter(|_| is_served(&wanted))
    });
    let given = [display.cast_const().cast(), config, share.cast_const()];
    recording::new_context(id::glXCreateContextAttribsARB, given, None, direct, context);
    context
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
    let done =
        guarded(|| unsafe { binding::make_current(display, drawable, drawable, context) }).unwrap_or(false);
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
    let done = guarded(|| unsafe { binding::make_current(display, draw, read, context) }).unwrap_or(false);
    let arguments = [pointer(display), Value::Id(draw), Value::Id(read), pointer(context)];
    recording::call(id::glXMakeContextCurrent, &arguments, Some(Value::Bool(done)));
    recording::made_current();
    done.into()
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

/// glXCopyContext: not done.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXCopyContext(_: *mut Display, _: *mut c_void, _: *mut c_void, mask: c_ulong) {
    guarded(|| tracing::warn!("glXCopyContext({mask:#x}) copies nothing"));
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
