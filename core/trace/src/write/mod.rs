//! Writes a trace: version 6 of the format, in the Snappy container.

mod chunks;
mod definitions;
mod values;

use std::io::{self, Write};

use crate::format::{NEWEST_VERSION, detail, event, flag};
use chunks::Chunks;
use definitions::Defined;
pub use definitions::{Bitmask, Enumeration, Function, Structure};

/// Writes events as they come.
///
/// An event is begun by [`enter`](Self::enter) or [`leave`](Self::leave), has details ([`argument`](Self::argument) and
/// [`result`](Self::result), each followed by one value), and is ended by [`end`](Self::end). Values have no memory of
/// their own: an array is begun by [`array`](Self::array), and its elements follow.
///
/// Signatures are written where they are first used, by their ids, which the caller chooses: small numbers, one
/// signature an id.
///
/// Errors of the sink are kept until [`flush`](Self::flush) reports them.
pub struct TraceWriter<W> {
    out: Chunks<W>,
    defined: Defined,
    calls: u32,
}

impl<W: Write> TraceWriter<W> {
    /// Begins a trace with properties such as `process.name`.
    ///
    /// # Errors
    /// Those of the sink.
    pub fn new(sink: W, properties: &[(&str, &str)]) -> io::Result<Self> {
        let mut out = Chunks::new(sink)?;
        out.uint(NEWEST_VERSION.into());
        // The semantic version: what the calls mean did not change since.
        out.uint(NEWEST_VERSION.into());
        for (name, value) in properties.iter().filter(|(name, _)| !name.is_empty()) {
            out.string(name.as_bytes());
            out.string(value.as_bytes());
        }
        out.string(b"");
        Ok(Self { out, defined: Defined::default(), calls: 0 })
    }

    /// Begins a call and returns its number. Threads are counted from 0.
    #[inline]
    pub fn enter(&mut self, thread: u32, function: &Function) -> u32 {
        self.out.byte(event::ENTER);
        self.out.uint(thread.into());
        self.function(function);
        let number = self.calls;
        self.calls = number.wrapping_add(1);
        number
    }

    /// Says of the call being entered that the program did not make it.
    pub fn fake(&mut self) {
        self.out.byte(detail::FLAGS);
        self.out.uint(flag::FAKE);
    }

    /// Begins the results of a call.
    #[inline]
    pub fn leave(&mut self, number: u32) {
        self.out.byte(event::LEAVE);
        self.out.uint(number.into());
    }

    /// The value that follows is that of an argument, by position.
    #[inline]
    pub fn argument(&mut self, index: usize) {
        self.out.byte(detail::ARGUMENT);
        self.out.uint(index as u64);
    }

    /// The value that follows is what the call returns.
    #[inline]
    pub fn result(&mut self) {
        self.out.byte(detail::RETURN);
    }

    /// Ends an event.
    #[inline]
    pub fn end(&mut self) {
        self.out.byte(detail::END);
    }

    /// Hands everything so far to the sink. Between two events this makes a whole trace of the file.
    ///
    /// # Errors
    /// The first error of the sink since it was last reported; nothing is written after one.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
