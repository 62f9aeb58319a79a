//! Reading: from a file to calls.

mod input;
mod order;
mod parser;
mod signatures;
mod values;

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::call::Call;
use crate::container::{self, Blocks, Container};
use crate::error::{Damage, Stop, TraceEnd, TraceError};
use crate::format::event;
use crate::signature::{FunctionSignature, SignatureId, Signatures};
use order::CallOrder;
use parser::{Header, Parser};

/// A stream of calls.
///
/// Memory stays bounded however long the trace is. Decompression runs on a thread of its own, a few blocks ahead.
pub struct TraceReader {
    container: Container,
    header: Header,
    parser: Parser,
    order: CallOrder,
    /// Calls entered so far, and so the number of the next.
    entered: u64,
    file_position: Arc<AtomicU64>,
    end: Option<TraceEnd>,
    /// To be returned once all calls before it have been.
    failure: Option<TraceError>,
}

impl TraceReader {
    /// Opens a file and reads its header.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, TraceError> {
        let path = path.as_ref();
        let file = File::open(path).map_err(|source| TraceError::Open { path: path.into(), source })?;
        Self::from_reader(file)
    }

    /// Reads the header of a trace that comes from anywhere; `source` needs no buffer.
    pub fn from_reader(source: impl Read + Send + 'static) -> Result<Self, TraceError> {
        let file_position = Arc::new(AtomicU64::new(0));
        let counted = Counted { source, count: file_position.clone() };
        let (container, decoder) = container::open(counted)?;
        let mut parser = Parser::new(Blocks::start(container, decoder)?);
        let header = parser.header().map_err(|stop| header_error(stop, container, &parser))?;
        Ok(Self {
            container,
            header,
            parser,
            order: CallOrder::default(),
            entered: 0,
            file_position,
            end: None,
            failure: None,
        })
    }

    /// How the file is compressed.
    pub fn container(&self) -> Container {
        self.container
    }

    /// Version of the format.
    pub fn version(&self) -> u32 {
        self.parser.version
    }

    /// Version of the meaning of the calls: how the tracer recorded them. The format's own before version 6.
    pub fn semantic_version(&self) -> u32 {
        self.header.semantic_version
    }

    /// Names and values that describe the traced process, such as `process.name`; none before version 6.
    pub fn properties(&self) -> &[(String, String)] {
        &self.header.properties
    }

    /// Replaces `call` with the next one, in the order in which calls were entered; `false` at the end of the trace.
    ///
    /// A call that is not left within the next 65536 calls (or 256 MiB of their values) no longer holds up those, but
    /// comes when it is left, or last. Calls that are never left are handed out as they were entered, before the end.
    ///
    /// # Errors
    ///
    /// One error, after all calls that precede the fault in the file; then the trace is at its end.
    pub fn next_call(&mut self, call: &mut Call) -> Result<bool, TraceError> {
        loop {
            if self.order.take(call) {
                return Ok(true);
            }
            if self.end.is_some() {
                return self.failure.take().map_or(Ok(false), Err);
            }
            if let Err(stop) = self.read_event() {
                self.finish(stop);
            }
        }
    }

    /// How the trace ended; `None` while there may be more calls.
    ///
    /// Known as soon as the last event has been read, which may be before the last call is handed out.
    pub fn end(&self) -> Option<TraceEnd> {
        self.end
    }

    /// All signatures that have appeared up to the calls handed out, and perhaps more.
    pub fn signatures(&self) -> &Signatures {
        &self.parser.signatures
    }

    pub fn signature(&self, id: SignatureId) -> &FunctionSignature {
        self.parser.signatures.function(id)
    }

    /// Decompressed bytes read so far.
    pub fn position(&self) -> u64 {
        self.parser.input.position()
    }

    /// Bytes of the file read so far, a few blocks ahead of the calls; of use for a progress bar.
    pub fn file_position(&self) -> u64 {
        self.file_position.load(Ordering::Relaxed)
    }

    /// Reads an event. The data may end before it, but not within it.
    fn read_event(&mut self) -> Result<(), Stop> {
        let event = self.parser.input.byte()?;
        let result = match event {
            event::ENTER => self.enter(),
            event::LEAVE => self.leave(),
            other => Err(Damage::Event(other).into()),
        };
        result.map_err(|stop| match stop {
            Stop::End { .. } => Stop::End { cut: true },
            other => other,
        })
    }

    fn enter(&mut self) -> Result<(), Stop> {
        let number = u32::try_from(self.entered).map_err(|_| Damage::CallCount)?;
        let mut call = self.order.spare();
        self.parser.enter(number, &mut call)?;
        self.entered += 1;
        self.order.push(call)
    }

    fn leave(&mut self) -> Result<(), Stop> {
        let number = self.parser.input.uint()?;
        if number >= self.entered {
            return Err(Damage::UnknownCall(number).into());
        }
        // Fits: smaller than the number of a call.
        self.order.leave(number as u32, |call| self.parser.details(call))
    }

    fn finish(&mut self, stop: Stop) {
        let incomplete = self.order.close();
        let offset = self.position();
        let failed = TraceEnd::Failed { incomplete };
        (self.end, self.failure) = match stop {
            Stop::End { cut: false } => (Some(TraceEnd::Clean { incomplete }), None),
            Stop::End { cut: true } => (Some(TraceEnd::Truncated { incomplete, offset }), None),
            Stop::Failed(error) => (Some(failed), Some(*error)),
            Stop::Damage(damage) => (Some(failed), Some(self.damaged(damage))),
        };
    }

    fn damaged(&self, damage: Damage) -> TraceError {
        TraceError::Damaged { offset: self.position(), calls: self.entered, damage }
    }
}

/// Why there is no header. Brotli is what nothing else is, so that data that are no trace at all end here, too.
fn header_error(stop: Stop, container: Container, parser: &Parser) -> TraceError {
    /// A future version could be as large; random data rarely begin with so small a number.
    const PLAUSIBLE_VERSION: u64 = 32;

    let guessed = container == Container::Brotli;
    match stop {
        Stop::Failed(error) => match *error {
            TraceError::UnsupportedVersion { version } if version > PLAUSIBLE_VERSION => {
                TraceError::NotATrace
            }
            TraceError::Container { .. } if guessed => TraceError::NotATrace,
            error => error,
        },
        _ if guessed => TraceError::NotATrace,
        Stop::End { .. } => TraceError::HeaderCut,
        Stop::Damage(damage) => TraceError::Damaged { offset: parser.input.position(), calls: 0, damage },
    }
}

/// Counts the bytes that pass through, and repeats reads that a signal interrupted.
struct Counted<R> {
    source: R,
    count: Arc<AtomicU64>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let result = loop {
            match self.source.read(buffer) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                result => break result,
            }
        };
        let read = result.as_ref().map_or(0, |&read| read as u64);
        self.count.fetch_add(read, Ordering::Relaxed);
        result
    }
}
