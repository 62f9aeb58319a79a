//! Between a program in C and this library: no panic goes through, and no call needs a context.

use std::panic::{AssertUnwindSafe, catch_unwind};

use afterglow_api::constants::GL_INVALID_OPERATION;
use afterglow_gl::Context;

use crate::current;

/// Calls `call` with the current context; without one, or after a panic, the result is the default. A panic is logged
/// and becomes an error of the context.
#[inline]
pub fn with_context<T: Default>(call: impl FnOnce(&mut Context) -> T) -> T {
    let context = current::get();
    if context.is_null() {
        return T::default();
    }
    // SAFETY: a context that is current stays alive, and only this thread uses it (see `current`).
    let gl = unsafe { &mut *context };
    guarded(AssertUnwindSafe(|| call(gl))).unwrap_or_else(|| {
        // SAFETY: as above; the reference that the call had is gone.
        unsafe { &mut *context }.record_error(GL_INVALID_OPERATION);
        T::default()
    })
}

/// As [`with_context`], for calls that cannot panic.
#[inline(always)]
pub fn with_context_plainly(call: impl FnOnce(&mut Context)) {
    let context = current::get();
    if !context.is_null() {
        // SAFETY: as in `with_context`.
        call(unsafe { &mut *context });
    }
}

/// The result of `call`; `None` after a panic, which is logged.
pub fn guarded<T>(call: impl FnOnce() -> T) -> Option<T> {
    catch_unwind(AssertUnwindSafe(call))
        .map_err(|_| tracing::error!("a bug in Afterglow: a call was dropped"))
        .ok()
}
