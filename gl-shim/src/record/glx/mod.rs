//! Calls of GLX. What a function's parameters mean stands beside it, in the table of `glx::exports`; [`call`] records
//! by that.

mod kinds;
mod lists;
mod names;

use afterglow_api::{CommandId, id};
use afterglow_trace::write::Function;

pub use kinds::Kind;
pub use lists::List;

use super::recorder::Recorder;
use super::{Bits, is_on, recorder, thread};
use crate::boundary::guarded;

/// A function, with the names that tracers know its parameters by.
pub struct Signature {
    /// Which function.
    pub id: CommandId,
    /// Names of parameters.
    pub names: &'static [&'static str],
    /// What the parameters are.
    pub kinds: &'static [Kind],
    /// What is returned, if anything is.
    pub result: Option<Kind>,
}

/// Runs a function and records it. The arguments are its parameters in their order.
///
/// # Safety
/// Pointers among the arguments are what the specification of the function wants.
#[inline]
pub unsafe fn call<R: Bits>(signature: &Signature, arguments: &[u64], run: impl FnOnce() -> R) -> R {
    if !is_on() {
        return run();
    }
    // SAFETY: the contract is the same.
    let number = guarded(|| unsafe { enter(signature, arguments) }).flatten();
    let result = run();
    if let Some(number) = number {
        // SAFETY: the contract is the same; what the function writes is written.
        guarded(|| unsafe { leave(signature, number, arguments, result.bits()) });
    }
    result
}

#[cold]
unsafe fn enter(signature: &Signature, arguments: &[u64]) -> Option<u32> {
    let mut recorder = recorder()?;
    let function =
        Function { id: signature.id.index() as u32, name: signature.id.name(), arguments: signature.names };
    let number = recorder.writer.enter(thread(), &function);
    // SAFETY: the contract is the same.
    unsafe { values(&mut recorder, signature, arguments, false) };
    recorder.writer.end();
    Some(number)
}

#[cold]
unsafe fn leave(signature: &Signature, number: u32, arguments: &[u64], result: u64) {
    let Some(mut recorder) = recorder() else { return };
    recorder.writer.leave(number);
    // SAFETY: the contract is the same.
    unsafe { values(&mut recorder, signature, arguments, true) };
    if let Some(kind) = signature.result {
        recorder.writer.result();
        // SAFETY: what is returned can be read.
        unsafe { kind.write(&mut recorder.writer, result, arguments) };
    }
    recorder.writer.end();
}

/// Writes the arguments that the function reads, or those that it writes.
unsafe fn values(recorder: &mut Recorder, signature: &Signature, arguments: &[u64], written: bool) {
    for (index, (kind, bits)) in signature.kinds.iter().zip(arguments).enumerate() {
        if kind.is_written() == written {
            recorder.writer.argument(index);
            // SAFETY: the contract is the same.
            unsafe { kind.write(&mut recorder.writer, *bits, arguments) };
        }
    }
}

/// Brings the file up to date.
pub fn flush() {
    if is_on() {
        guarded(|| recorder().map(|mut recorder| recorder.flush()));
    }
}

/// Records the size of the drawable that became current with a context for the first time: as apitrace does, by calls
/// that set what OpenGL sets by itself.
pub fn drawable_size(width: u32, height: u32) {
    guarded(|| {
        let Some(mut recorder) = recorder() else { return };
        for id in [id::glViewport, id::glScissor] {
            // SAFETY: no pointers.
            unsafe { recorder.fake(id, &[0, 0, width.into(), height.into()], None) };
        }
    });
}
