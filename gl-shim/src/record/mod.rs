//! Recording what the program calls, in apitrace's format.
//!
//! The environment's `AFTERGLOW_RECORD` names the file, which must be a new one. Every entry point asks [`is_on`], and
//! goes through [`call`] if it is; what is written follows from what `afterglow-api` knows of the command ([`plan`]).
//! Commands that read the program's memory later than they are called are recorded as apitrace does it: arrays before
//! each draw ([`arrays`]), mapped buffers when they are unmapped ([`buffers`]).

mod arrays;
mod bits;
mod buffers;
#[cfg(target_os = "linux")]
pub mod glx;
mod names;
mod number;
mod plan;
mod recorder;
mod sizes;

use std::cell::Cell;
use std::fs::File;
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::time::Duration;

use afterglow_api::CommandId;
use afterglow_gl::Context;
use parking_lot::{MappedMutexGuard, Mutex, MutexGuard};

use crate::boundary::guarded;
use crate::current;
pub(crate) use bits::Bits;
use plan::{Role, plan};
use recorder::Recorder;

/// What the environment calls the file.
const VARIABLE: &str = "AFTERGLOW_RECORD";

/// Files beside each other.
const FILES: usize = 1000;

/// How long the end of the process waits for another thread's call.
const EXIT_WAITS: Duration = Duration::from_millis(500);

/// Set until the environment has been asked, and while calls are recorded.
static ON: AtomicBool = AtomicBool::new(true);

/// The process that records; 0 before there is one. A forked process has the file and its unwritten part too, and
/// perhaps a lock that nobody opens, but none of it is its own.
static OWNER: AtomicU32 = AtomicU32::new(0);

static STATE: Mutex<State> = Mutex::new(State::Unasked);

enum State {
    Unasked,
    Off,
    On(Box<Recorder>),
}

/// Whether calls go through [`call`].
#[inline(always)]
pub fn is_on() -> bool {
    ON.load(Ordering::Relaxed)
}

/// Records into a file from now on, whatever the environment says.
///
/// # Errors
/// Those of creating the file.
pub fn start(path: &Path) -> io::Result<()> {
    let recorder = Recorder::new(File::create(path)?)?;
    OWNER.store(std::process::id(), Ordering::Relaxed);
    *STATE.lock() = State::On(Box::new(recorder));
    ON.store(true, Ordering::Relaxed);
    Ok(())
}

/// Ends the recording, and brings the file up to date.
pub fn stop() {
    end(STATE.lock());
}

fn end(mut state: MutexGuard<State>) {
    if let State::On(recorder) = &mut *state {
        recorder.flush();
    }
    *state = State::Off;
    ON.store(false, Ordering::Relaxed);
}

/// Runs a command and records it. The arguments are its parameters in their order.
///
/// # Safety
/// Pointers among the arguments are what the specification of the command wants.
#[inline(always)]
pub(crate) unsafe fn call<R: Bits>(id: CommandId, arguments: &[u64], run: impl FnOnce() -> R) -> R {
    // SAFETY: the contract is the same.
    let entered = unsafe { before(id, arguments) };
    let result = run();
    if let Some(entered) = entered {
        // SAFETY: the contract is the same; what the command writes is written.
        unsafe { after(entered, id, arguments, result.bits()) };
    }
    result
}

#[inline(never)]
unsafe fn before(id: CommandId, arguments: &[u64]) -> Option<Entered> {
    // SAFETY: the contract is the same.
    guarded(|| unsafe { enter(id, arguments) }).flatten()
}

#[inline(never)]
unsafe fn after(entered: Entered, id: CommandId, arguments: &[u64], result: u64) {
    // SAFETY: the contract is the same.
    guarded(|| unsafe { leave(entered, id, arguments, result) });
}

/// What is to be recorded when a command is left.
enum Entered {
    /// The results of the call of that number.
    Call(u32),
    /// What glInterleavedArrays made of the arrays.
    InterleavedArrays,
}

unsafe fn enter(id: CommandId, arguments: &[u64]) -> Option<Entered> {
    let mut recorder = recorder()?;
    // SAFETY: a context that is current stays alive, and only this thread uses it (see `current`).
    let mut gl = unsafe { current::get().as_mut() };
    if let Some(gl) = gl.as_deref_mut() {
        // SAFETY: the contract is the same.
        if let Some(instead) = unsafe { prepare(&mut recorder, gl, id, arguments) } {
            return instead;
        }
    }
    // SAFETY: the contract is the same.
    Some(Entered::Call(unsafe { recorder.enter(thread(), id, arguments, gl.as_deref()) }))
}

/// Records what has to come before a command, and tells if the command is not recorded itself.
unsafe fn prepare(
    recorder: &mut Recorder,
    gl: &mut Context,
    id: CommandId,
    arguments: &[u64],
) -> Option<Option<Entered>> {
    let role = plan(id).role;
    // SAFETY: the contract is the same.
    unsafe {
        match role {
            Role::Plain => return None,
            Role::ArrayPointer if !gl.has_array_buffer() => return Some(None),
            Role::InterleavedArrays if !gl.has_array_buffer() => {
                return Some(arrays::is_format(arguments).then_some(Entered::InterleavedArrays));
            }
            Role::ArrayPointer | Role::InterleavedArrays => return None,
            Role::ArrayElement if arrays::element(recorder, gl, arguments) => return Some(None),
            Role::Unmap => buffers::before_unmap(recorder, gl, arguments),
            role => arrays::before_draw(recorder, gl, role, arguments),
        }
    }
    None
}

unsafe fn leave(entered: Entered, id: CommandId, arguments: &[u64], result: u64) {
    let Some(mut recorder) = recorder() else { return };
    // SAFETY: as in `enter`.
    let gl = unsafe { current::get().as_ref() };
    match (entered, gl) {
        // SAFETY: the contract is the same.
        (Entered::Call(number), gl) => unsafe { recorder.leave(number, id, arguments, result, gl) },
        (Entered::InterleavedArrays, Some(gl)) => arrays::after_interleaved_arrays(&mut recorder, gl),
        (Entered::InterleavedArrays, None) => {}
    }
    let failed = recorder.failed;
    drop(recorder);
    if failed {
        stop();
    }
}

/// Whether what is recorded is this process's.
fn is_own() -> bool {
    let owner = OWNER.load(Ordering::Relaxed);
    owner == 0 || owner == std::process::id()
}

/// The recorder, if calls are recorded; the first call asks the environment.
fn recorder() -> Option<MappedMutexGuard<'static, Recorder>> {
    if !is_own() {
        return None;
    }
    let mut state = STATE.lock();
    if matches!(*state, State::Unasked) {
        *state = asked();
        ON.store(matches!(*state, State::On(_)), Ordering::Relaxed);
    }
    MutexGuard::try_map(state, |state| match state {
        State::On(recorder) => Some(&mut **recorder),
        _ => None,
    })
    .ok()
}

#[cold]
fn asked() -> State {
    let Some(path) = std::env::var_os(VARIABLE).filter(|path| !path.is_empty()) else { return State::Off };
    match create(path.as_ref()).and_then(Recorder::new) {
        Ok(recorder) => {
            OWNER.store(std::process::id(), Ordering::Relaxed);
            flush_at_exit();
            State::On(Box::new(recorder))
        }
        Err(error) => {
            tracing::error!("cannot record to {}: {error}", path.display());
            State::Off
        }
    }
}

/// A file of that name, or if it is there already, one of a name beside it: a program may be several processes.
fn create(path: &Path) -> io::Result<File> {
    let beside = (1..FILES).map(|number| {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        path.with_extension(format!("{number}.{extension}"))
    });
    let mut taken = io::ErrorKind::AlreadyExists.into();
    for path in std::iter::once(path.to_owned()).chain(beside) {
        match File::create_new(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => taken = error,
            created => return created.inspect(|_| tracing::info!("recording to {}", path.display())),
        }
    }
    Err(taken)
}

fn flush_at_exit() {
    unsafe extern "C" {
        fn atexit(callback: extern "C" fn()) -> std::ffi::c_int;
    }
    extern "C" fn at_exit() {
        // A program may exit in a signal handler that interrupted this very thread amid a call.
        guarded(|| is_own().then(|| STATE.try_lock_for(EXIT_WAITS).map(end)));
    }
    // SAFETY: the function stays as long as the library; it is called before the library goes.
    unsafe { atexit(at_exit) };
}

/// Number of the calling thread, in order of their first calls.
fn thread() -> u32 {
    static THREADS: AtomicU32 = AtomicU32::new(0);
    thread_local! {
        static NUMBER: Cell<Option<u32>> = const { Cell::new(None) };
    }
    NUMBER.with(|number| {
        number.get().unwrap_or_else(|| {
            let new = THREADS.fetch_add(1, Ordering::Relaxed);
            number.set(Some(new));
            new
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_there_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("game.trace");
        create(&path).unwrap();
        create(&path).unwrap();
        create(&path).unwrap();
        assert!(path.with_extension("1.trace").exists() && path.with_extension("2.trace").exists());
        assert!(create(&folder.path().join("missing/game.trace")).is_err());
    }
}
