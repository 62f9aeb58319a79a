//! The render thread of this process, started when the first context is made.

use std::ffi::c_int;
use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use afterglow_engine::Engine;

use crate::boundary::guarded;
use crate::options::{self, Options};

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
    let options = Options::read();
    match Engine::start_with(options.engine(), Some(Box::new(options))) {
        Ok(engine) => {
            tracing::info!("drawing with {}", engine.device().name);
            stop_at_exit();
            Some(engine)
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "afterglow: nothing will be drawn: {error}");
            None
        }
    }
}

/// Has the render thread ended at exit, before all that was registered so far.
fn stop_at_exit() {
    // SAFETY: the library stays loaded (see build.rs).
    unsafe { atexit(stop) };
}

/// Takes note of a picture. Drivers and layers also make things at a first use that may come late, and take them down
/// at exit before what was registered earlier: so the render thread's end is registered again, ever more seldom.
pub fn note_picture() {
    static PICTURES: AtomicU32 = AtomicU32::new(0);
    let pictures = PICTURES.fetch_add(1, Ordering::Relaxed).wrapping_add(1);
    if pictures.is_power_of_two() && matches!(ENGINE.get(), Some(Some(_))) {
        stop_at_exit();
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
