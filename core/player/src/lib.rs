//! Plays a trace into GL contexts.
//!
//! A [`Player`] takes calls from a trace, makes contexts as the traced program did, and calls their methods.
//! The way from a call's name to a method is generated (`generated`); what is left to write by hand is window
//! systems (`window`), mapped buffers, and commands whose arguments need more than conversion (`special`).
//! A call that cannot be played is skipped and counted; no trace makes it panic.

mod action;
mod args;
mod contexts;
mod generated;
mod mapped;
mod player;
#[cfg(test)]
mod random_calls;
mod report;
mod sizes;
mod special;
mod summary;
mod window;

pub use contexts::BackendFactory;
pub use player::{FrameEnd, Player, Step};
pub use report::{GlError, PlayReport};
pub use sizes::DrawableSizes;
pub use summary::TraceSummary;
pub use window::ends_frame;
