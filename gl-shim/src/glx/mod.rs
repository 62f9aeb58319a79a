//! GLX 1.4 on X11.
//!
//! The program's `Display` is used only on the thread that calls, and only through Xlib as the program has it; windows
//! are shown by the render thread over a connection of its own. Nothing depends on the server's GLX extension. What a
//! program does wrong ends in False, NULL or 0, and in an X error where the program listens for them (`errors`).
//!
//! `exports` has the entry points; the other modules know what exists: `displays` with their `config`urations, `contexts`
//! and `drawables` by handle, and the `binding` of each thread.

mod attributes;
mod binding;
mod choose;
mod config;
mod contexts;
mod displays;
mod drawables;
mod errors;
pub mod exports;
mod glyphs;
mod pixmaps;
pub mod proc_address;
mod render;
mod xlib;

pub use binding::{flushed, viewport_set};
pub(crate) use xlib::VisualInfo;
