//! A window with a current OpenGL context, by libX11 and libGL as they are found at run time.

use std::ffi::{CStr, c_char, c_int, c_uint, c_ulong, c_void};
use std::ptr::null_mut;

use libloading::Library;

use crate::failure::Failure;

/// Attributes of glXChooseVisual: RGBA, double-buffered, with depth.
const ATTRIBUTES: [c_int; 5] = [4, 5, 12, 24, 0];

type Display = *mut c_void;

/// The beginning of XVisualInfo: `visual`, `visualid`, `screen`, `depth`.
#[repr(C)]
struct VisualInfo {
    visual: *mut c_void,
    id: c_ulong,
    screen: c_int,
    depth: c_int,
}

/// Functions of a libGL whose context is current in a window.
pub struct Stage {
    gl: Library,
    swap: unsafe extern "C" fn(Display, c_ulong),
    display: Display,
    window: c_ulong,
    _x11: Library,
}

impl Stage {
    /// Opens a window of 64x64 pixels on the server that `DISPLAY` names.
    pub fn open() -> Result<Stage, Failure> {
        // SAFETY: libraries and functions are the ones that these names have had for decades.
        unsafe {
            let x11 = load("libX11.so.6")?;
            let gl = load("libGL.so.1")?;
            let open: unsafe extern "C" fn(*const c_char) -> Display = function(&x11, c"XOpenDisplay")?;
            let root: unsafe extern "C" fn(Display) -> c_ulong = function(&x11, c"XDefaultRootWindow")?;
            let create: CreateWindow = function(&x11, c"XCreateSimpleWindow")?;
            let map: unsafe extern "C" fn(Display, c_ulong) -> c_int = function(&x11, c"XMapWindow")?;
            let sync: unsafe extern "C" fn(Display, c_int) -> c_int = function(&x11, c"XSync")?;
            let choose: unsafe extern "C" fn(Display, c_int, *const c_int) -> *mut VisualInfo =
                function(&gl, c"glXChooseVisual")?;
            let context: unsafe extern "C" fn(Display, *mut VisualInfo, *mut c_void, c_int) -> *mut c_void =
                function(&gl, c"glXCreateContext")?;
            let make_current: unsafe extern "C" fn(Display, c_ulong, *mut c_void) -> c_int =
                function(&gl, c"glXMakeCurrent")?;
            let swap = function(&gl, c"glXSwapBuffers")?;

            let display = open(std::ptr::null());
            if display.is_null() {
                return Err(Failure::Check("no X server: set DISPLAY, or use xvfb-run".into()));
            }
            let visual = choose(display, 0, ATTRIBUTES.as_ptr());
            if visual.is_null() {
                return Err(Failure::Check("no visual".into()));
            }
            let window = create(display, root(display), 0, 0, 64, 64, 0, 0, 0);
            map(display, window);
            sync(display, 0);
            let context = context(display, visual, null_mut(), 1);
            if context.is_null() || make_current(display, window, context) == 0 {
                return Err(Failure::Check("no context".into()));
            }
            Ok(Stage { gl, swap, display, window, _x11: x11 })
        }
    }

    /// A function of libGL.
    ///
    /// # Safety
    /// `T` must be the function's type.
    pub unsafe fn function<T: Copy>(&self, name: &CStr) -> Result<T, Failure> {
        // SAFETY: the caller vouches for the type.
        unsafe { function(&self.gl, name) }
    }

    /// glXSwapBuffers.
    pub fn swap_buffers(&self) {
        // SAFETY: display and window are open.
        unsafe { (self.swap)(self.display, self.window) };
    }
}

type CreateWindow =
    unsafe extern "C" fn(Display, c_ulong, c_int, c_int, c_uint, c_uint, c_uint, c_ulong, c_ulong) -> c_ulong;

unsafe fn load(name: &str) -> Result<Library, Failure> {
    // SAFETY: its initialisers are those that every program with this library runs.
    unsafe { Library::new(name) }.map_err(|error| Failure::Check(error.to_string()))
}

unsafe fn function<T: Copy>(library: &Library, name: &CStr) -> Result<T, Failure> {
    // SAFETY: the caller vouches for the type.
    let symbol = unsafe { library.get::<T>(name.to_bytes_with_nul()) };
    symbol.map(|symbol| *symbol).map_err(|error| Failure::Check(error.to_string()))
}
