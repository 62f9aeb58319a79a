//! The numbers of the format, shared by whoever reads or writes it.
//!
//! Source: apitrace's `docs/FORMAT.markdown`; the call flags are described only by its `trace_format.hpp`.

/// Newest version of the format that is understood.
pub const NEWEST_VERSION: u32 = 6;

/// First version whose enumerations carry all their names; before it a signature was one name and its value.
pub(crate) const VERSION_WHOLE_ENUMS: u32 = 3;

/// First version whose enter events carry the thread; before it the thread was a detail of the call.
pub(crate) const VERSION_THREAD_IN_ENTER: u32 = 4;

/// First version with a semantic version and properties in its header.
pub(crate) const VERSION_PROPERTIES: u32 = 6;

/// What begins an event.
pub(crate) mod event {
    pub const ENTER: u8 = 0;
    pub const LEAVE: u8 = 1;
}

/// What begins a detail of an event.
pub(crate) mod detail {
    pub const END: u8 = 0;
    pub const ARGUMENT: u8 = 1;
    pub const RETURN: u8 = 2;
    pub const THREAD: u8 = 3;
    pub const BACKTRACE: u8 = 4;
    pub const FLAGS: u8 = 5;
}

/// What begins a value.
pub(crate) mod tag {
    pub const NULL: u8 = 0;
    pub const FALSE: u8 = 1;
    pub const TRUE: u8 = 2;
    pub const SINT: u8 = 3;
    pub const UINT: u8 = 4;
    pub const FLOAT: u8 = 5;
    pub const DOUBLE: u8 = 6;
    pub const STRING: u8 = 7;
    pub const BLOB: u8 = 8;
    pub const ENUM: u8 = 9;
    pub const BITMASK: u8 = 10;
    pub const ARRAY: u8 = 11;
    pub const STRUCT: u8 = 12;
    pub const OPAQUE: u8 = 13;
    pub const REPR: u8 = 14;
    pub const WSTRING: u8 = 15;
}

/// What begins a detail of a stack frame.
pub(crate) mod frame {
    pub const END: u8 = 0;
    pub const MODULE: u8 = 1;
    pub const FUNCTION: u8 = 2;
    pub const FILE: u8 = 3;
    pub const LINE: u8 = 4;
    pub const OFFSET: u8 = 5;
}

/// Bits of a call's flags.
pub(crate) mod flag {
    /// The program did not make this call; the tracer recorded it to keep data that the program's calls refer to.
    pub const FAKE: u64 = 1;
}

/// Bounds on what a trace may ask of memory; a trace that exceeds one is damaged.
///
/// They are far above what real traces hold. Memory is moreover taken as data arrive, never by a length alone.
pub mod limits {
    /// Bytes of one blob, and of all blobs and strings of one event together.
    pub const BLOB_BYTES: u64 = 1 << 30;
    /// Bytes (or wide characters) of one string value.
    pub const STRING_BYTES: u64 = 1 << 26;
    /// Values in one event, nested ones included.
    pub const EVENT_VALUES: u64 = 1 << 22;
    /// Depth of arrays within structures within arrays.
    pub const DEPTH: u32 = 64;
    /// Arguments of a function.
    pub const ARGUMENTS: u64 = 1024;
    /// Frames of one backtrace.
    pub const BACKTRACE: u64 = 4096;
    /// Bytes of a name (of a function, argument, enumerant, file), or of a property's value.
    pub const NAME_BYTES: u64 = 1 << 16;
    /// Names, and bytes of names, in all signatures of the trace together.
    pub const SIGNATURE_NAMES: u64 = 1 << 22;
    /// See [`SIGNATURE_NAMES`].
    pub const SIGNATURE_BYTES: u64 = 1 << 28;
    /// Calls that wait behind an earlier one that has not been left yet, before that one is set aside.
    pub const WINDOW_CALLS: usize = 1 << 16;
    /// As [`WINDOW_CALLS`], in bytes of their values.
    pub const WINDOW_BYTES: u64 = 1 << 28;
    /// Calls set aside: about one a thread in real traces.
    pub const CALLS_ASIDE: usize = 1024;
    /// Bytes of values of the calls set aside.
    pub const BYTES_ASIDE: u64 = 1 << 31;
    /// Bytes of a Snappy chunk, compressed or not; apitrace writes chunks of 1 MiB.
    pub const SNAPPY_CHUNK: u32 = 1 << 26;
}
