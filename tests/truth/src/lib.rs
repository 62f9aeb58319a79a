//! The truth to measure scene recovery against.
//!
//! A *style* ([`styles`]) is a small program that draws as a kind of engine does: it calls OpenGL through a [`Client`],
//! which writes the calls into a trace and, beside it, the [`Truth`]: the camera, the lights, and what each
//! triangle is. [`measure`] plays the trace and compares what scene recovery says with that.
//!
//! An *oracle* ([`oracle`]) says the same of a real program, whose trace was recorded: `--oracle NAME TRACE`.
//!
//! `cargo run --release -p afterglow-truth` prints the figures of all styles; `--write DIR` leaves traces and truths, which
//! `afterglow replay` shows.
//!
//! Nothing here needs OpenGL or a device, and the same style gives the same bytes each time.

mod client;
pub mod kit;
pub mod measure;
pub mod oracle;
pub mod steady;
pub mod styles;
mod truth;

pub use client::{Arg, Attributes, Calls, Client, List, Recording, Texture, Thing, WINDOW, thing};
pub use truth::*;
