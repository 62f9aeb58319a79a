//! One recorded call.

use crate::signature::{FrameId, SignatureId};
use crate::value::Value;

/// A call of the traced program, or one that the tracer recorded on its behalf.
///
/// Meant to be refilled: a reader given the same call again reuses its memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Call {
    /// Counted from 0 in the order in which calls were entered.
    pub number: u32,
    /// Thread that made the call, counted from 0 in order of appearance.
    pub thread: u32,
    pub signature: SignatureId,
    /// By position; at least as many as the signature has names.
    pub args: Vec<Value>,
    pub ret: Option<Value>,
    /// Not made by the program: recorded by the tracer to keep data that the program's calls refer to.
    pub fake: bool,
    /// Whether the call returned. One that did not lacks its results and the arguments that the callee writes.
    pub complete: bool,
    /// Innermost frame first; empty where the tracer recorded none.
    pub backtrace: Vec<FrameId>,
    /// Bytes of memory that the call takes, roughly.
    pub(crate) weight: u64,
}

impl Call {
    /// The argument at a position, [`Value::Absent`] if there is none.
    pub fn arg(&self, index: usize) -> &Value {
        self.args.get(index).unwrap_or(&Value::Absent)
    }

    /// Makes the call a new, empty one that keeps its memory.
    pub(crate) fn reset(&mut self, number: u32, thread: u32, signature: SignatureId, arguments: usize) {
        self.number = number;
        self.thread = thread;
        self.signature = signature;
        self.args.clear();
        self.args.resize_with(arguments, Value::default);
        self.ret = None;
        self.fake = false;
        self.complete = false;
        self.backtrace.clear();
        self.weight = (size_of::<Self>() + arguments * size_of::<Value>()) as u64;
    }
}
