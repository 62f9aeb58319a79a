//! `libGL.so.1`: the C ABI over `afterglow-gl`, and GLX over `afterglow-engine`.
//!
//! The entry points of OpenGL are generated (`generated/`); what they share is hand-written: finding the current context
//! (`current`), the panic boundary (`boundary`), reading the program's memory (`memory`), and commands whose
//! arguments need more than that (`special`). `record` writes what is called into a trace. `glx` is the window system. No Vulkan here.

#![allow(non_snake_case, reason = "the library is called libGL")]
#![allow(
    clippy::missing_safety_doc,
    reason = "the contract of an exported name is the OpenGL specification's"
)]

pub mod boundary;
pub mod current;
mod export;
mod generated;
#[cfg(target_os = "linux")]
pub mod glx;
mod memory;
mod number;
pub mod options;
pub mod proc_address;
pub mod record;
mod special;
pub mod stub;
#[cfg(test)]
mod tests;
