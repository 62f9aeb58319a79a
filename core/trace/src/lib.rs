//! apitrace's file format, as a stream of calls.
//!
//! A trace is a compressed stream ([`Container`]) of events: a call is entered with its arguments and left with its
//! results. [`TraceReader`] pairs the events and hands out whole [`Call`]s in the order in which they were entered.
//! [`dump`] prints a call as a line of text; [`mod@write`] writes traces.
//!
//! The format is that of apitrace's `docs/FORMAT.markdown`, versions 0 to [`format::NEWEST_VERSION`]. A trace is
//! untrusted input: every count and length is bounded ([`format::limits`]), and whatever precedes a fault is delivered
//! before the fault is reported.
//!
//! ```no_run
//! use afterglow_trace::{Call, TraceReader};
//!
//! let mut reader = TraceReader::open("game.trace")?;
//! let mut call = Call::default();
//! while reader.next_call(&mut call)? {
//!     println!("{}", reader.signature(call.signature).name);
//! }
//! # Ok::<(), afterglow_trace::TraceError>(())
//! ```

mod call;
mod container;
pub mod dump;
mod error;
pub mod format;
mod reader;
mod signature;
mod value;
pub mod write;

pub use call::Call;
pub use container::Container;
pub use error::{Damage, TraceEnd, TraceError};
pub use reader::TraceReader;
pub use signature::{
    BitmaskId, BitmaskSignature, EnumId, EnumSignature, FrameId, FunctionSignature, SignatureId, Signatures,
    StackFrame, StructId, StructSignature,
};
pub use value::{StructValue, Value};
pub use write::TraceWriter;
