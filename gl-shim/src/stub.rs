//! Commands that do nothing but to be in error.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use afterglow_api::constants::GL_INVALID_OPERATION;

use crate::boundary::with_context;

static CALLS: AtomicU64 = AtomicU64::new(0);

/// How many calls of such commands the process has made.
pub fn calls() -> u64 {
    CALLS.load(Ordering::Relaxed)
}

/// Counts a call, logs the first one of the command, and records an error of the context.
#[cold]
pub fn call(name: &str, called: &AtomicBool) {
    CALLS.fetch_add(1, Ordering::Relaxed);
    if !called.swap(true, Ordering::Relaxed) {
        tracing::warn!("{name} is not supported");
    }
    with_context(|gl| gl.record_error(GL_INVALID_OPERATION));
}
