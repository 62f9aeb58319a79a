//! The program's own Xlib, found when it is first needed: there is no dependency to link with.

use std::ffi::{CStr, c_char, c_int, c_long, c_short, c_uchar, c_uint, c_ulong, c_ushort, c_void};
use std::mem::MaybeUninit;
use std::sync::OnceLock;

use parking_lot::Mutex;

/// Of Xlib, only ever a pointer that the program gave.
pub type Display = c_void;
/// The name of anything in an X server.
pub type Xid = c_ulong;

/// XVisualInfo.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
#[allow(missing_docs, reason = "as in Xutil.h")]
pub struct VisualInfo {
    pub visual: *mut c_void,
    pub visualid: c_ulong,
    pub screen: c_int,
    pub depth: c_int,
    pub class: c_int,
    pub red_mask: c_ulong,
    pub green_mask: c_ulong,
    pub blue_mask: c_ulong,
    pub colormap_size: c_int,
    pub bits_per_rgb: c_int,
}

// SAFETY: Xlib's structures of visuals do not change while their display is open.
unsafe impl Send for VisualInfo {}
// SAFETY: as above.
unsafe impl Sync for VisualInfo {}

/// TrueColor.
pub const TRUE_COLOR: c_int = 4;
/// VisualScreenMask.
const VISUAL_SCREEN_MASK: c_long = 2;

/// XCharStruct.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
#[allow(missing_docs, reason = "as in Xlib.h")]
pub struct CharStruct {
    pub lbearing: c_short,
    pub rbearing: c_short,
    pub width: c_short,
    pub ascent: c_short,
    pub descent: c_short,
    pub attributes: c_ushort,
}

/// XFontStruct.
#[repr(C)]
#[allow(missing_docs, reason = "as in Xlib.h")]
pub struct FontStruct {
    pub ext_data: *mut c_void,
    pub fid: Xid,
    pub direction: c_uint,
    pub min_char_or_byte2: c_uint,
    pub max_char_or_byte2: c_uint,
    pub min_byte1: c_uint,
    pub max_byte1: c_uint,
    pub all_chars_exist: c_int,
    pub default_char: c_uint,
    pub n_properties: c_int,
    pub properties: *mut c_void,
    pub min_bounds: CharStruct,
    pub max_bounds: CharStruct,
    pub per_char: *const CharStruct,
    pub ascent: c_int,
    pub descent: c_int,
}

/// XChar2b.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
#[allow(missing_docs, reason = "as in Xlib.h")]
pub struct Char2b {
    pub byte1: u8,
    pub byte2: u8,
}

/// XErrorEvent.
#[repr(C)]
#[derive(Debug)]
#[allow(missing_docs, reason = "as in Xlib.h")]
pub struct ErrorEvent {
    pub kind: c_int,
    pub display: *mut Display,
    pub resource: Xid,
    pub serial: c_ulong,
    pub error_code: c_uchar,
    pub request_code: c_uchar,
    pub minor_code: c_uchar,
}

/// Called with what went wrong.
pub type ErrorHandler = unsafe extern "C" fn(*mut Display, *mut c_void) -> c_int;
/// Of a window or pixmap.
#[derive(Debug, Clone, Copy)]
pub struct Geometry {
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// Bits of a pixel.
    pub depth: c_uint,
}

/// Called when a display is closed.
pub type CloseHook = unsafe extern "C" fn(*mut Display, *mut c_void) -> c_int;

macro_rules! functions {
    ($($field:ident = $name:ident($($arg:ty),*) $(-> $result:ty)?;)*) => {
        /// Functions of Xlib.
        #[allow(missing_docs, reason = "as in Xlib's manual")]
        pub struct Xlib {
            $(pub $field: unsafe extern "C" fn($($arg),*) $(-> $result)?,)*
        }

        impl Xlib {
            fn load() -> Result<Self, libloading::Error> {
                // SAFETY: a program that calls GLX has Xlib loaded: nothing is initialized here.
                let library = unsafe { libloading::Library::new("libX11.so.6") }?;
                let functions = Xlib {
                    // SAFETY: the types are those of Xlib's headers.
                    $($field: *unsafe { library.get(concat!(stringify!($name), "\0").as_bytes()) }?,)*
                };
                std::mem::forget(library);
                Ok(functions)
            }
        }
    };
}

functions! {
    free = XFree(*mut c_void) -> c_int;
    screen_count = XScreenCount(*mut Display) -> c_int;
    display_string = XDisplayString(*mut Display) -> *const c_char;
    root_window = XRootWindow(*mut Display, c_int) -> Xid;
    sync = XSync(*mut Display, c_int) -> c_int;
    next_request = XNextRequest(*mut Display) -> c_ulong;
    default_error_handler = _XDefaultError(*mut Display, *mut c_void) -> c_int;
    set_error_handler = XSetErrorHandler(Option<ErrorHandler>) -> Option<ErrorHandler>;
    get_geometry = XGetGeometry(*mut Display, Xid, *mut Xid, *mut c_int, *mut c_int, *mut c_uint, *mut c_uint, *mut c_uint, *mut c_uint) -> c_int;
    get_visual_info = XGetVisualInfo(*mut Display, c_long, *mut VisualInfo, *mut c_int) -> *mut VisualInfo;
    query_extension = XQueryExtension(*mut Display, *const c_char, *mut c_int, *mut c_int, *mut c_int) -> c_int;
    add_extension = XAddExtension(*mut Display) -> *const c_int;
    set_close_hook = XESetCloseDisplay(*mut Display, c_int, Option<CloseHook>) -> Option<CloseHook>;
    query_font = XQueryFont(*mut Display, Xid) -> *mut FontStruct;
    free_font_info = XFreeFontInfo(*mut *mut c_char, *mut FontStruct, c_int) -> c_int;
    create_pixmap = XCreatePixmap(*mut Display, Xid, c_uint, c_uint, c_uint) -> Xid;
    free_pixmap = XFreePixmap(*mut Display, Xid) -> c_int;
    create_gc = XCreateGC(*mut Display, Xid, c_ulong, *mut c_void) -> *mut c_void;
    free_gc = XFreeGC(*mut Display, *mut c_void) -> c_int;
    set_foreground = XSetForeground(*mut Display, *mut c_void, c_ulong) -> c_int;
    set_font = XSetFont(*mut Display, *mut c_void, Xid) -> c_int;
    fill_rectangle = XFillRectangle(*mut Display, Xid, *mut c_void, c_int, c_int, c_uint, c_uint) -> c_int;
    draw_string16 = XDrawString16(*mut Display, Xid, *mut c_void, c_int, c_int, *const Char2b, c_int) -> c_int;
    create_image = XCreateImage(*mut Display, *mut c_void, c_uint, c_int, c_int, *mut c_char, c_uint, c_uint, c_int, c_int) -> *mut c_void;
    put_image = XPutImage(*mut Display, Xid, *mut c_void, *mut c_void, c_int, c_int, c_int, c_int, c_uint, c_uint) -> c_int;
    get_image = XGetImage(*mut Display, Xid, c_int, c_int, c_uint, c_uint, c_ulong, c_int) -> *mut c_void;
    get_pixel = XGetPixel(*mut c_void, c_int, c_int) -> c_ulong;
    destroy_image = XDestroyImage(*mut c_void) -> c_int;
}

/// Xlib; nothing where there is none, which is logged once.
pub fn get() -> Option<&'static Xlib> {
    static XLIB: OnceLock<Option<Xlib>> = OnceLock::new();
    XLIB.get_or_init(|| Xlib::load().map_err(|error| tracing::error!("no Xlib: {error}")).ok()).as_ref()
}

/// Ignores an error of a request.
unsafe extern "C" fn ignore(_: *mut Display, _: *mut c_void) -> c_int {
    0
}

/// Whoever changes the error handler. Two threads at a time would take each other's handler for the program's.
static HANDLER: Mutex<()> = Mutex::new(());

impl Xlib {
    /// The error handler that the program set, if it did.
    pub fn program_s_error_handler(&self) -> Option<ErrorHandler> {
        let _alone = HANDLER.lock();
        // There is no other way to learn it than to set one.
        // SAFETY: a handler with the type that Xlib wants.
        let former = unsafe { (self.set_error_handler)(Some(ignore)) };
        // SAFETY: the handler that was set before.
        unsafe { (self.set_error_handler)(former) };
        former.filter(|handler| *handler as usize != self.default_error_handler as usize)
    }

    /// Runs requests whose errors do not count. Errors of earlier ones still reach the program's own handler.
    ///
    /// # Safety
    /// `display` is open. `requests` waits for its last request's answer.
    pub unsafe fn forgiving<T>(&self, display: *mut Display, requests: impl FnOnce() -> T) -> T {
        // SAFETY: the caller vouches for the display.
        unsafe { (self.sync)(display, 0) };
        let _alone = HANDLER.lock();
        // SAFETY: a handler with the type that Xlib wants.
        let former = unsafe { (self.set_error_handler)(Some(ignore)) };
        let result = requests();
        // SAFETY: the handler that was set before.
        unsafe { (self.set_error_handler)(former) };
        result
    }

    /// Width and height of a window or pixmap, pixels; nothing if there is no such thing.
    ///
    /// # Safety
    /// `display` is open.
    pub unsafe fn size(&self, display: *mut Display, drawable: Xid) -> Option<(u32, u32)> {
        // SAFETY: the caller vouches for the display.
        unsafe { self.geometry(display, drawable) }.map(|geometry| geometry.size)
    }

    /// The form of a window or pixmap; nothing if there is no such thing.
    ///
    /// # Safety
    /// `display` is open.
    pub unsafe fn geometry(&self, display: *mut Display, drawable: Xid) -> Option<Geometry> {
        let (mut root, mut x, mut y, mut width, mut height, mut border, mut depth) = (0, 0, 0, 0, 0, 0, 0);
        let query = || {
            // SAFETY: the caller vouches for the display; all pointers are of variables.
            unsafe {
                (self.get_geometry)(
                    display,
                    drawable,
                    &mut root,
                    &mut x,
                    &mut y,
                    &mut width,
                    &mut height,
                    &mut border,
                    &mut depth,
                )
            }
        };
        // SAFETY: as above; the query waits for its answer.
        let found = unsafe { self.forgiving(display, query) };
        (found != 0).then_some(Geometry { size: (width, height), depth })
    }

    /// The visuals of a screen.
    ///
    /// # Safety
    /// `display` is open.
    pub unsafe fn visuals(&self, display: *mut Display, screen: c_int) -> Vec<VisualInfo> {
        // SAFETY: zeros are a valid value of every field.
        let mut template: VisualInfo = unsafe { MaybeUninit::zeroed().assume_init() };
        template.screen = screen;
        let mut count = 0;
        // SAFETY: the caller vouches for the display.
        let found = unsafe { (self.get_visual_info)(display, VISUAL_SCREEN_MASK, &mut template, &mut count) };
        if found.is_null() {
            return Vec::new();
        }
        // SAFETY: Xlib's array has so many elements, and is this function's to free.
        unsafe {
            let visuals = std::slice::from_raw_parts(found, count.max(0) as usize).to_vec();
            (self.free)(found.cast());
            visuals
        }
    }

    /// The name of a display's server.
    ///
    /// # Safety
    /// `display` is open.
    pub unsafe fn server(&self, display: *mut Display) -> String {
        // SAFETY: the caller vouches for the display, which holds the string.
        let name = unsafe { (self.display_string)(display) };
        if name.is_null() {
            return String::new();
        }
        // SAFETY: a string that ends, of an open display.
        unsafe { CStr::from_ptr(name) }.to_string_lossy().into_owned()
    }
}
