//! The render thread: frames of all contexts in, pictures in windows out.
//!
//! Contexts execute on the program's threads and hand their frames to a [`Port`]. One thread owns the device and
//! everything on it; it has its own connection to the window system and never touches the program's. A drawable's
//! queue holds two frames: a program that is faster waits at its buffer swap.

mod drawable;
mod flushed;
mod life;
mod message;
mod pace;
mod port;
mod queue;
mod thread;
mod window;
mod xcb;

pub use drawable::{Drawable, Surface};
pub use port::{Port, ShareGroup};
pub use thread::{Engine, EngineError, EngineOptions};
