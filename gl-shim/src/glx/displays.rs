//! Displays that programs opened: their screens' visuals and configurations.

use std::collections::HashMap;
use std::ffi::{c_int, c_void};
use std::sync::Arc;

use parking_lot::Mutex;

use super::config::{self, Config, Visual};
use super::xlib::{self, Display, TRUE_COLOR, VisualInfo, Xlib};
use super::{choose, drawables};
use crate::boundary::guarded;

/// Screens that a display may have here.
const MOST_SCREENS: c_int = 64;

/// An open display.
pub struct OpenDisplay {
    /// The server's name.
    pub server: String,
    /// The codes of its GLX.
    pub codes: Codes,
    screens: Vec<Screen>,
    /// What glXChooseVisual found last, by visual: glXCreateContext is told only the visual.
    chosen: Mutex<HashMap<u32, &'static Config>>,
}

/// Codes of the server's GLX extension; zeros if it has none.
#[derive(Debug, Clone, Copy, Default)]
pub struct Codes {
    /// Of requests.
    pub opcode: c_int,
    /// Of the first event.
    pub first_event: c_int,
    /// Of the first error.
    pub first_error: c_int,
}

/// A screen.
pub struct Screen {
    visuals: Vec<VisualInfo>,
    /// In the order of glXGetFBConfigs.
    pub configs: &'static [Config],
}

/// By the display's address.
static DISPLAYS: Mutex<Option<HashMap<usize, Arc<OpenDisplay>>>> = Mutex::new(None);

/// What is known of a display; nothing for null or without Xlib.
///
/// # Safety
/// `display` is null or open.
pub unsafe fn get(display: *mut Display) -> Option<Arc<OpenDisplay>> {
    if display.is_null() {
        return None;
    }
    if let Some(known) = DISPLAYS.lock().as_ref().and_then(|displays| displays.get(&(display as usize))) {
        return Some(known.clone());
    }
    let xlib = xlib::get()?;
    // SAFETY: the caller vouches for the display.
    let made = Arc::new(unsafe { OpenDisplay::new(xlib, display) });
    let known = DISPLAYS.lock().get_or_insert_default().insert(display as usize, made.clone());
    if known.is_none() {
        // SAFETY: as above; the hook has the type that Xlib wants.
        unsafe {
            let codes = (xlib.add_extension)(display);
            if !codes.is_null() {
                (xlib.set_close_hook)(display, *codes, Some(closed));
            }
        }
    }
    Some(made)
}

/// Whether a display that was known is open still.
pub fn is_open(display: *mut Display) -> bool {
    DISPLAYS.lock().as_ref().is_some_and(|displays| displays.contains_key(&(display as usize)))
}

/// Forgets a display that is being closed.
unsafe extern "C" fn closed(display: *mut Display, _: *mut c_void) -> c_int {
    guarded(|| {
        drawables::forget_display(display);
        let forgotten = DISPLAYS.lock().as_mut().and_then(|displays| displays.remove(&(display as usize)));
        drop(forgotten);
    });
    0
}

impl OpenDisplay {
    /// # Safety
    /// `display` is open.
    unsafe fn new(xlib: &Xlib, display: *mut Display) -> Self {
        // SAFETY: the caller vouches for the display.
        let (server, count) = unsafe { (xlib.server(display), (xlib.screen_count)(display)) };
        let mut codes = Codes::default();
        let Codes { opcode, first_event, first_error } = &mut codes;
        // SAFETY: as above; all pointers are of variables.
        unsafe { (xlib.query_extension)(display, c"GLX".as_ptr(), opcode, first_event, first_error) };
        let screens = (0..count.min(MOST_SCREENS))
            // SAFETY: as above.
            .map(|screen| unsafe { Screen::new(xlib, display, screen) })
            .collect();
        Self { server, codes, screens, chosen: Mutex::default() }
    }

    /// A screen by its number.
    pub fn screen(&self, number: c_int) -> Option<&Screen> {
        self.screens.get(usize::try_from(number).ok()?)
    }

    /// What Xlib says of the visual of a configuration.
    pub fn visual(&self, config: &Config) -> Option<VisualInfo> {
        let is_it = |info: &&VisualInfo| info.visualid as u32 == config.visual.id;
        self.screen(config.screen)?.visuals.iter().find(is_it).copied()
    }

    /// Says that contexts for the visual of a configuration are to have that configuration.
    pub fn choose(&self, config: &'static Config) {
        self.chosen.lock().insert(config.visual.id, config);
    }

    /// The configuration that a visual stands for; without a choice, the one that has most.
    pub fn of_visual(&self, screen: c_int, visual: u32) -> Option<&'static Config> {
        let of_screen = self.screen(screen)?.configs.iter().filter(|config| config.visual.id == visual);
        let chosen = self.chosen.lock().get(&visual).copied().filter(|config| config.screen == screen);
        chosen.or_else(|| {
            of_screen.max_by_key(|config| (config.is_double, config.depth, config.stencil, config.accum))
        })
    }
}

impl Screen {
    /// # Safety
    /// `display` is open and has such a screen.
    unsafe fn new(xlib: &Xlib, display: *mut Display, number: c_int) -> Self {
        // SAFETY: the caller vouches for the display.
        let mut visuals = unsafe { xlib.visuals(display, number) };
        visuals.retain(is_drawable);
        // Windows with alpha are see-through under compositors: they come last.
        visuals.sort_by_key(|info| info.depth);
        let known: Vec<_> =
            visuals.iter().map(|info| Visual { id: info.visualid as u32, depth: info.depth }).collect();
        let mut configs = config::all(number, &known);
        choose::sort_table(&mut configs);
        Self { visuals, configs: config::keep(configs) }
    }
}

/// Whether windows of a visual can be drawn to: true colour, 8 bits a component.
fn is_drawable(info: &VisualInfo) -> bool {
    let bits = [info.red_mask, info.green_mask, info.blue_mask].map(|mask| mask.count_ones());
    info.class == TRUE_COLOR && matches!(info.depth, 24 | 32) && bits == [8; 3]
}
