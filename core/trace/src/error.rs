//! How reading a trace ends: well, cut short, or with an error.

use std::io;
use std::path::PathBuf;

use crate::container::Container;
use crate::format::NEWEST_VERSION;

/// Why a trace could not be read, or not further.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    /// The file could not be opened.
    #[error("cannot be opened: {source}")]
    Open { path: PathBuf, source: io::Error },
    /// The file could not be read further.
    #[error("cannot read the trace: {0}")]
    Io(#[source] io::Error),
    /// The data are no trace in any known container.
    #[error("not an apitrace file")]
    NotATrace,
    /// The data are compressed in a way that is not supported.
    #[error("the trace is compressed with {0}, which is not supported; `apitrace repack` converts it")]
    UnsupportedContainer(&'static str),
    /// The trace is newer than this reader.
    #[error("trace format version {version} is newer than the newest known one, {NEWEST_VERSION}")]
    UnsupportedVersion { version: u64 },
    /// The trace ends before its header does.
    #[error("the trace ends within its header")]
    HeaderCut,
    /// The compressed data are damaged.
    #[error("damaged {container} data after {offset} decompressed bytes: {source}")]
    Container {
        container: Container,
        /// Decompressed bytes before the damage.
        offset: u64,
        source: io::Error,
    },
    /// The decompressed data are no sequence of events.
    #[error("damaged trace at decompressed byte {offset}, after call {calls} was begun: {damage}")]
    Damaged {
        /// Decompressed bytes before the end of what could not be understood.
        offset: u64,
        /// Calls entered before.
        calls: u64,
        damage: Damage,
    },
    /// The thread that decompresses stopped without a word, which is a bug.
    #[error("the decompression of the trace stopped unexpectedly")]
    DecoderStopped,
}

/// What in the stream of events was not as it must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Damage {
    #[error("unknown event {0:#04x}")]
    Event(u8),
    #[error("unknown detail of a call {0:#04x}")]
    Detail(u8),
    #[error("unknown type of a value {0:#04x}")]
    ValueType(u8),
    #[error("unknown detail of a stack frame {0:#04x}")]
    FrameDetail(u8),
    #[error("an enumerant is no integer but of type {0:#04x}")]
    EnumerantType(u8),
    #[error("an integer of more than 64 bits")]
    Integer,
    #[error("a string of {0} bytes")]
    StringLength(u64),
    #[error("a blob of {0} bytes")]
    BlobLength(u64),
    #[error("too many values or bytes in one event")]
    EventSize,
    #[error("values nested too deeply")]
    Depth,
    #[error("argument number {0}")]
    ArgumentNumber(u64),
    #[error("a backtrace of {0} frames")]
    BacktraceLength(u64),
    #[error("too many names, or too long ones, in signatures")]
    SignatureSize,
    #[error("leaves call {0}, which was never entered")]
    UnknownCall(u64),
    #[error("thread number {0}")]
    Thread(u64),
    #[error("too many calls")]
    CallCount,
    #[error("too many calls that are never left")]
    OpenCalls,
}

/// How the stream of calls ended, once [`next_call`](crate::TraceReader::next_call) has nothing more to give.
///
/// `incomplete` counts the calls that were delivered with the arguments of their enter event, but were never left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraceEnd {
    /// The file is whole. Calls may still be incomplete, where the program ended within them.
    Clean { incomplete: u32 },
    /// The file was cut short, after `offset` bytes of decompressed data.
    Truncated { incomplete: u32, offset: u64 },
    /// `next_call` has returned an error.
    Failed { incomplete: u32 },
}

impl TraceEnd {
    /// Whether everything that was recorded has been delivered.
    pub fn is_clean(self) -> bool {
        matches!(self, Self::Clean { .. })
    }
}

/// Why the parser cannot go on.
#[derive(Debug)]
pub(crate) enum Stop {
    /// The data are at their end. It is a clean one between two events, unless the container was cut.
    End {
        cut: bool,
    },
    Damage(Damage),
    Failed(Box<TraceError>),
}

impl From<Damage> for Stop {
    fn from(damage: Damage) -> Self {
        Self::Damage(damage)
    }
}
