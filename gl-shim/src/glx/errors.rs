//! X errors for what a program does wrong, as a server with GLX would send them.
//!
//! Only a program that has set an error handler is told: Xlib's own handler would end the process, and everybody
//! else learns enough from the call's result.

use std::ffi::{c_int, c_uchar, c_ulong};

use super::displays;
use super::xlib::{self, Display, ErrorEvent, Xid};

/// What is wrong, by its code: those of X, and those that GLX adds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, clippy::enum_variant_names, reason = "as in the X protocol and glxproto.h")]
pub enum Fault {
    BadValue,
    BadXWindow,
    BadXPixmap,
    BadMatch,
    BadAccess,
    BadAlloc,
    BadContext,
    BadDrawable,
    BadPixmap,
    BadFBConfig,
    BadPbuffer,
    BadWindow,
    BadProfile,
}

impl Fault {
    /// The code, for a server whose GLX begins its codes at `base`.
    fn code(self, base: c_int) -> c_int {
        match self {
            Self::BadValue => 2,
            Self::BadXWindow => 3,
            Self::BadXPixmap => 4,
            Self::BadMatch => 8,
            Self::BadAccess => 10,
            Self::BadAlloc => 11,
            Self::BadContext => base,
            Self::BadDrawable => base + 2,
            Self::BadPixmap => base + 3,
            Self::BadFBConfig => base + 9,
            Self::BadPbuffer => base + 10,
            Self::BadWindow => base + 12,
            Self::BadProfile => base + 13,
        }
    }
}

/// The request that is at fault, by its minor code in GLX's protocol.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "as in glxproto.h")]
pub enum Request {
    CreateContext = 3,
    MakeCurrent = 5,
    CopyContext = 10,
    CreateGlxPixmap = 13,
    DestroyGlxPixmap = 15,
    CreatePixmap = 22,
    DestroyPixmap = 23,
    CreateNewContext = 24,
    MakeContextCurrent = 26,
    CreatePbuffer = 27,
    DestroyPbuffer = 28,
    CreateWindow = 31,
    DestroyWindow = 32,
    CreateContextAttribs = 34,
}

/// Tells the program's error handler. No lock may be held: the handler may do anything, a jump out of it included.
///
/// # Safety
/// `display` is null or open.
pub unsafe fn raise(display: *mut Display, fault: Fault, request: Request, resource: Xid) {
    // SAFETY: the caller vouches for the display.
    let known = unsafe { displays::get(display) };
    let (Some(xlib), Some(known)) = (xlib::get(), known) else { return };
    let Some(handler) = xlib.program_s_error_handler() else { return };
    let codes = known.codes;
    drop(known);
    let mut event = ErrorEvent {
        kind: 0,
        display,
        resource,
        // SAFETY: the caller vouches for the display.
        serial: unsafe { (xlib.next_request)(display) } as c_ulong,
        error_code: fault.code(codes.first_error) as c_uchar,
        request_code: codes.opcode as c_uchar,
        minor_code: request as c_uchar,
    };
    // SAFETY: the program set it to be called so.
    unsafe { handler(display, (&raw mut event).cast()) };
}
