//! Windows, pixmaps and pbuffers.

use std::ffi::{c_int, c_uint, c_ulong, c_void};
use std::sync::atomic::Ordering;

use afterglow_api::constants::glx::*;

use super::configs::of_visual;
use super::put;
use crate::boundary::guarded;
use crate::glx::attributes::{self, value};
use crate::glx::config::{self, Config, PBUFFER_EXTENT};
use crate::glx::displays;
use crate::glx::drawables::{self, Kind};
use crate::glx::errors::{self, Fault, Request};
use crate::glx::xlib::{self, Display, VisualInfo, Xid};

/// The greatest swap interval that glXQueryDrawable tells.
const MOST_INTERVAL: c_uint = 1;

/// glXCreateWindow.
pub unsafe fn create_window(display: *mut Display, config: *const c_void, window: Xid) -> Xid {
    let make = || {
        let config = config::from_handle(config).ok_or(Fault::BadFBConfig)?;
        // SAFETY: the program vouches for its display.
        unsafe { of_x(display, config, window, Kind::Window { window }) }.ok_or(Fault::BadXWindow)
    };
    // SAFETY: as above.
    unsafe { or_raise(display, Request::CreateWindow, window, make) }
}

/// glXCreatePixmap.
pub unsafe fn create_pixmap(display: *mut Display, config: *const c_void, pixmap: Xid) -> Xid {
    let make = || {
        let config = config::from_handle(config).ok_or(Fault::BadFBConfig)?;
        // SAFETY: the program vouches for its display.
        unsafe { of_x(display, config, pixmap, Kind::Pixmap { pixmap }) }.ok_or(Fault::BadXPixmap)
    };
    // SAFETY: as above.
    unsafe { or_raise(display, Request::CreatePixmap, pixmap, make) }
}

/// glXCreateGLXPixmap.
pub unsafe fn create_glx_pixmap(display: *mut Display, visual: *const VisualInfo, pixmap: Xid) -> Xid {
    let make = || {
        // SAFETY: the program vouches for display and visual.
        let config = unsafe { of_visual(display, visual) }.ok_or(Fault::BadValue)?;
        // SAFETY: as above.
        unsafe { of_x(display, config, pixmap, Kind::Pixmap { pixmap }) }.ok_or(Fault::BadXPixmap)
    };
    // SAFETY: as above.
    unsafe { or_raise(display, Request::CreateGlxPixmap, pixmap, make) }
}

/// What `make` makes; 0, and an X error, if it cannot.
///
/// # Safety
/// `display` is null or open.
unsafe fn or_raise(
    display: *mut Display,
    request: Request,
    resource: Xid,
    make: impl FnOnce() -> Result<Xid, Fault>,
) -> Xid {
    guarded(make).unwrap_or(Err(Fault::BadAlloc)).unwrap_or_else(|fault| {
        // SAFETY: the caller vouches for the display.
        guarded(|| unsafe { errors::raise(display, fault, request, resource) });
        0
    })
}

/// A drawable for something of X.
///
/// # Safety
/// `display` is null or open.
unsafe fn of_x(display: *mut Display, config: &'static Config, id: Xid, kind: Kind) -> Option<Xid> {
    // SAFETY: the caller vouches for the display, which is not null from here on.
    unsafe {
        let server = displays::get(display)?.server.clone();
        let size = xlib::get()?.size(display, id)?;
        Some(drawables::create(display, kind, config, server, size))
    }
}

/// glXCreatePbuffer.
pub unsafe fn create_pbuffer(display: *mut Display, config: *const c_void, list: *const c_int) -> Xid {
    let make = || {
        // SAFETY: the program vouches for its list.
        let wanted = unsafe { attributes::read(list, &[]) };
        let get = |attribute| value(&wanted, attribute).unwrap_or(0);
        let is_largest = get(GLX_LARGEST_PBUFFER) != 0;
        // SAFETY: the program vouches for its display.
        unsafe { pbuffer(display, config, get(GLX_PBUFFER_WIDTH), get(GLX_PBUFFER_HEIGHT), is_largest) }
    };
    // SAFETY: the program vouches for its display.
    unsafe { or_raise(display, Request::CreatePbuffer, 0, make) }
}

/// glXCreateGLXPbufferSGIX.
pub unsafe fn create_glx_pbuffer(
    display: *mut Display,
    config: *const c_void,
    width: c_uint,
    height: c_uint,
    list: *const c_int,
) -> Xid {
    let make = || {
        // SAFETY: the program vouches for its list.
        let wanted = unsafe { attributes::read(list, &[]) };
        let is_largest = value(&wanted, GLX_LARGEST_PBUFFER_SGIX).unwrap_or(0) != 0;
        let extent = |size: c_uint| i32::try_from(size).unwrap_or(i32::MAX);
        // SAFETY: the program vouches for its display.
        unsafe { pbuffer(display, config, extent(width), extent(height), is_largest) }
    };
    // SAFETY: the program vouches for its display.
    unsafe { or_raise(display, Request::CreatePbuffer, 0, make) }
}

/// # Safety
/// `display` is null or open.
unsafe fn pbuffer(
    display: *mut Display,
    config: *const c_void,
    width: i32,
    height: i32,
    is_largest: bool,
) -> Result<Xid, Fault> {
    let config = config::from_handle(config).ok_or(Fault::BadFBConfig)?;
    let is_possible = |size| (0..=PBUFFER_EXTENT).contains(&size);
    if !(is_largest || is_possible(width) && is_possible(height)) {
        return Err(Fault::BadAlloc);
    }
    let size = [width, height].map(|size| size.clamp(1, PBUFFER_EXTENT) as u32);
    // SAFETY: the caller vouches for the display, which is not null from here on.
    unsafe {
        let server = displays::get(display).ok_or(Fault::BadValue)?.server.clone();
        Ok(drawables::create(display, Kind::Pbuffer, config, server, size.into()))
    }
}

/// glXDestroyWindow and its like: takes the drawable's id away. An X error if there is none, or its window is gone.
pub unsafe fn destroy_drawable(display: *mut Display, drawable: Xid, fault: Fault, request: Request) {
    // SAFETY: the program vouches for its display.
    let was_there = guarded(|| unsafe {
        drawables::destroy(display, drawable).is_some_and(|found| found.refresh_size(display))
    });
    if was_there == Some(false) {
        // SAFETY: as above.
        guarded(|| unsafe { errors::raise(display, fault, request, drawable) });
    }
}

/// glXQueryDrawable.
pub unsafe fn query_drawable(display: *mut Display, drawable: Xid, attribute: c_int, value: *mut c_uint) {
    let result = guarded(|| {
        // SAFETY: the program vouches for its display.
        let found = unsafe { drawables::get_or_window(display, drawable) }?;
        // SAFETY: as above; a null display has no drawables.
        unsafe { found.refresh_size(display) };
        let (width, height) = found.size();
        Some(match attribute as u32 {
            GLX_WIDTH => width,
            GLX_HEIGHT => height,
            GLX_PRESERVED_CONTENTS => 1,
            GLX_LARGEST_PBUFFER => 0,
            GLX_FBCONFIG_ID => found.config.map_or(0, |config| config.id as u32),
            GLX_SWAP_INTERVAL_EXT => found.interval() as u32,
            GLX_MAX_SWAP_INTERVAL_EXT => MOST_INTERVAL,
            _ => return None,
        })
    });
    if let Some(result) = result.flatten() {
        // SAFETY: the program vouches for its pointer.
        unsafe { put(value, result) };
    }
}

/// glXSelectEvent. The mask is kept; contents are never lost, so there are no events.
pub unsafe fn select_event(display: *mut Display, drawable: Xid, mask: c_ulong) {
    guarded(|| {
        // SAFETY: the program vouches for its display.
        if let Some(found) = unsafe { drawables::get_or_window(display, drawable) } {
            found.event_mask.store(mask as usize, Ordering::Relaxed);
        }
    });
}

/// glXGetSelectedEvent.
pub unsafe fn get_selected_event(display: *mut Display, drawable: Xid, mask: *mut c_ulong) {
    let found = guarded(|| drawables::get(display, drawable)).flatten();
    let kept = found.map_or(0, |found| found.event_mask.load(Ordering::Relaxed));
    // SAFETY: the program vouches for its pointer.
    unsafe { put(mask, kept as c_ulong) };
}
