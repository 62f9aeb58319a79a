//! The render thread of this process, started when the first context is made.

use std::ffi::c_int;
use std::io::Write;
use std::sync::OnceLock;
use std::time::Duration;

use afterglow_engine::Engine;

use crate::boundary::guarded;
use crate::options;

/// How long the end of the process waits for the render thread.
const PATIENCE: Duration = Duration::from_secs(5);

unsafe extern "C" {
    fn atexit(function: extern "C" fn()) -> c_int;
}

static ENGINE: OnceLock<Option<Engine>> = OnceLock::new();

/// The render thread; nothing if there is no device, which is said once.
pub fn engine() -> Option<&'static Engine> {
    // Unit tests are about what a program sees without a device.
    if cfg!(test) || is_noop() {
        return None;
    }
    ENGINE.get_or_init(|| guarded(start).flatten()).as_ref()
}

/// Whether this process draws nothing, to measure what calls cost.
pub fn is_noop() -> bool {
    static NOOP: OnceLock<bool> = OnceLock::new();
    *NOOP.get_or_init(options::is_noop)
}

fn start() -> Option<Engine> {
    options::start_log();
    match Engine::start(options::engine()) {
        Ok(engine) => {
            tracing::info!("drawing with {}", engine.device().name);
            // Registered after the driver's own: it runs before them.
            // SAFETY: the library stays loaded (see build.rs).
            unsafe { atexit(stop) };
            Some(engine)
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "afterglow: nothing will be drawn: {error}");
            None
        }
    }
}

/// Ends the render thread before the driver is torn down under it.
extern "C" fn stop() {
    guarded(|| {
        if let Some(Some(engine)) = ENGINE.get() {
            engine.stop(PATIENCE);
        }
    });
}
