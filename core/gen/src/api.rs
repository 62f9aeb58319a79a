//! Rust tables of `afterglow-api`: constants, commands, names of enumerants.

mod commands;
mod constants;
mod enum_names;

pub use commands::{commands, ids};
pub use constants::constants;
pub use enum_names::enum_names;
