//! The render thread: frames of all contexts in, pictures in windows out.
//!
//! Contexts execute on the program's threads and hand their frames to a [`Port`]. One thread owns the device and
//! everything on it; it has its own connection to the window system and never touches the program's. A drawable's
//! queue holds two frames: a program that is faster waits at its buffer swap.
//!
//! Where the device is lost, the thread opens it again and counts its number up; contexts see that when they begin a
//! frame, and define anew what images they need (`state`).
//!
//! What a player may change while a program plays is changed between two frames (`state/live.rs`): by keys, which a
//! thread looks at without taking them from the program (`keyboard`), and by an [`OptionsSource`].

mod blanks;
mod canvas;
mod contest;
mod drawable;
mod failures;
mod flushed;
mod hud;
mod keyboard;
mod keys;
mod life;
mod message;
mod options;
mod pace;
mod port;
mod queue;
mod screenshots;
mod slowness;
mod state;
mod thread;
mod window;
mod xcb;

pub use drawable::{Drawable, Surface};
pub use keys::{Action, Chord, Keys, UnknownKeys};
pub use options::{EngineOptions, OptionsSource};
pub use port::{Port, ShareGroup};
pub use thread::{Engine, EngineError};
