//! Visuals and configurations.

use std::ffi::{c_int, c_void};
use std::ptr::null_mut;

use afterglow_api::constants::glx::*;

use super::{array, put};
use crate::boundary::guarded;
use crate::glx::config::{self, Config};
use crate::glx::xlib::{Display, VisualInfo};
use crate::glx::{attributes, choose, displays};

/// glXChooseVisual.
pub unsafe fn choose_visual(display: *mut Display, screen: c_int, list: *const c_int) -> *mut VisualInfo {
    guarded(|| {
        // SAFETY: the program vouches for its display and list.
        let (known, wanted) =
            unsafe { (displays::get(display)?, attributes::read(list, choose::VISUAL_FLAGS)) };
        let config = choose::visual(known.screen(screen)?.configs, &wanted)?;
        chosen(&known, config)
    })
    .flatten()
    .unwrap_or(null_mut())
}

/// The visual of a configuration, which a context made with that visual will have.
fn chosen(known: &displays::OpenDisplay, config: &'static Config) -> Option<*mut VisualInfo> {
    let info = known.visual(config)?;
    known.choose(config);
    // SAFETY: null is allowed.
    Some(unsafe { array(&[info], null_mut()) })
}

/// glXGetConfig. The result is an error code.
pub unsafe fn get_config(
    display: *mut Display,
    visual: *const VisualInfo,
    attribute: c_int,
    value: *mut c_int,
) -> c_int {
    guarded(|| {
        if visual.is_null() {
            return GLX_BAD_VISUAL;
        }
        // SAFETY: the program vouches for its display and visual.
        let (known, info) = unsafe { (displays::get(display), visual.read_unaligned()) };
        let Some(known) = known else { return GLX_NO_EXTENSION };
        if known.screen(info.screen).is_none() {
            return GLX_BAD_SCREEN;
        }
        let result = match known.of_visual(info.screen, info.visualid as u32) {
            Some(config) => config.get(attribute as u32),
            // A visual that cannot be drawn to is told by this alone.
            None => (attribute as u32 == GLX_USE_GL).then_some(0),
        };
        match result {
            Some(result) => {
                // SAFETY: the program vouches for its pointer.
                unsafe { put(value, result) };
                0
            }
            None => GLX_BAD_ATTRIBUTE,
        }
    })
    .map_or(GLX_BAD_VISUAL as c_int, |error| error as c_int)
}

/// glXGetFBConfigs.
pub unsafe fn get_fb_configs(display: *mut Display, screen: c_int, count: *mut c_int) -> *mut *mut c_void {
    // SAFETY: the program vouches for all pointers.
    unsafe { find(display, screen, count, |table| table.iter().collect()) }
}

/// glXChooseFBConfig.
pub unsafe fn choose_fb_config(
    display: *mut Display,
    screen: c_int,
    list: *const c_int,
    count: *mut c_int,
) -> *mut *mut c_void {
    // SAFETY: the program vouches for all pointers.
    unsafe { find(display, screen, count, |table| choose::configs(table, &attributes::read(list, &[]))) }
}

/// # Safety
/// `display` is null or open; `count` is null or can be written.
unsafe fn find(
    display: *mut Display,
    screen: c_int,
    count: *mut c_int,
    choose: impl FnOnce(&'static [Config]) -> Vec<&'static Config>,
) -> *mut *mut c_void {
    let handles = guarded(|| {
        // SAFETY: the caller vouches for the display.
        let known = unsafe { displays::get(display) }?;
        Some(choose(known.screen(screen)?.configs).into_iter().map(Config::handle).collect::<Vec<_>>())
    });
    // SAFETY: the caller vouches for `count`.
    unsafe { array(&handles.flatten().unwrap_or_default(), count) }
}

/// glXGetFBConfigAttrib. The result is an error code.
pub unsafe fn get_fb_config_attrib(config: *const c_void, attribute: c_int, value: *mut c_int) -> c_int {
    let found = guarded(|| config::from_handle(config)).flatten();
    match found.and_then(|config| config.get(attribute as u32)) {
        Some(result) => {
            // SAFETY: the program vouches for its pointer.
            unsafe { put(value, result) };
            0
        }
        None => GLX_BAD_ATTRIBUTE as c_int,
    }
}

/// glXGetVisualFromFBConfig.
pub unsafe fn get_visual_from_fb_config(display: *mut Display, config: *const c_void) -> *mut VisualInfo {
    guarded(|| {
        let config = config::from_handle(config)?;
        // SAFETY: the program vouches for its display.
        let known = unsafe { displays::get(display) }?;
        chosen(&known, config)
    })
    .flatten()
    .unwrap_or(null_mut())
}

/// glXGetFBConfigFromVisualSGIX.
pub unsafe fn get_fb_config_from_visual(display: *mut Display, visual: *const VisualInfo) -> *mut c_void {
    // SAFETY: the program vouches for both pointers.
    guarded(|| unsafe { of_visual(display, visual) }).flatten().map_or(null_mut(), Config::handle)
}

/// The configuration of a visual.
///
/// # Safety
/// `display` is null or open; `visual` is null or can be read.
pub(super) unsafe fn of_visual(display: *mut Display, visual: *const VisualInfo) -> Option<&'static Config> {
    if visual.is_null() {
        return None;
    }
    // SAFETY: the caller vouches for both.
    let (known, info) = unsafe { (displays::get(display)?, visual.read_unaligned()) };
    known.of_visual(info.screen, info.visualid as u32)
}
