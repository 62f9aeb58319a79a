//! glXUseXFont.

use std::ffi::c_int;

use crate::boundary::guarded;
use crate::glx::xlib::Xid;

/// glXUseXFont.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn glXUseXFont(_: Xid, _: c_int, _: c_int, _: c_int) {
    guarded(|| tracing::warn!("glXUseXFont makes no lists"));
}
