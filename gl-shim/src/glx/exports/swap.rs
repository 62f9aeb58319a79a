//! Buffer swaps and their intervals.

use std::ffi::{c_int, c_uint};

use afterglow_api::constants::glx::*;

use crate::boundary::guarded;
use crate::glx::xlib::{Display, Xid};
use crate::glx::{binding, drawables};

/// glXSwapBuffers.
pub fn swap_buffers(display: *mut Display, drawable: Xid) {
    guarded(|| binding::swap(display, drawable));
}

/// glXSwapIntervalEXT.
pub unsafe fn swap_interval(display: *mut Display, drawable: Xid, interval: c_int) {
    if interval < 0 {
        return;
    }
    guarded(|| {
        // SAFETY: the program vouches for its display.
        if let Some(found) = unsafe { drawables::get_or_window(display, drawable) } {
            found.set_interval(interval);
        }
    });
}

/// glXSwapIntervalMESA. The result is an error code.
pub fn swap_interval_mesa(interval: c_uint) -> c_int {
    let Ok(interval) = c_int::try_from(interval) else { return GLX_BAD_VALUE as c_int };
    set_interval(interval)
}

/// glXSwapIntervalSGI. The result is an error code.
pub fn swap_interval_sgi(interval: c_int) -> c_int {
    if interval <= 0 {
        return GLX_BAD_VALUE as c_int;
    }
    set_interval(interval)
}

fn set_interval(interval: c_int) -> c_int {
    match guarded(|| binding::with(|binding| binding.draw.set_interval(interval))).flatten() {
        Some(()) => 0,
        None => GLX_BAD_CONTEXT as c_int,
    }
}

/// glXGetSwapIntervalMESA.
pub fn get_swap_interval() -> c_int {
    binding::with(|binding| binding.draw.interval()).unwrap_or(0)
}
