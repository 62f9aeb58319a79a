//! The render thread from outside: a program draws, and pictures come back and in windows.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

mod failures;
#[cfg(target_os = "linux")]
mod live;
mod program;
#[cfg(target_os = "linux")]
mod server;
#[cfg(target_os = "linux")]
mod windows;
