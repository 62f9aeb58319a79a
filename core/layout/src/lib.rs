//! Structures and packed words that Rust and GLSL share, declared once in Rust.
//!
//! [`shared_struct!`] declares a `repr(C)` structure whose GLSL twin uses the scalar block layout;
//! [`packed_words!`] declares bit fields in an array of `u32`, with accessors in both languages.
//! `afterglow-gen` writes the GLSL text from the descriptions that the macros record.

mod shared_struct;
mod words;

pub use bytemuck;
pub use pastey::paste;
pub use shared_struct::{GlslField, SharedStruct, StructDescription, StructField};
pub use words::{BitField, WordsDescription};
