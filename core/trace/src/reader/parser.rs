//! The grammar's outer half: the header, and the details of an event.

use super::input::Input;
use crate::call::Call;
use crate::container::Blocks;
use crate::error::{Damage, Stop, TraceError};
use crate::format::{self, NEWEST_VERSION, detail, flag, frame, limits};
use crate::signature::{FrameId, Signatures, StackFrame};
use crate::value::Value;

/// What one event may still ask of memory.
pub(super) struct Budget {
    pub values: u64,
    pub bytes: u64,
}

impl Budget {
    const WHOLE: Self = Self { values: limits::EVENT_VALUES, bytes: limits::BLOB_BYTES };

    #[inline]
    pub fn take_values(&mut self, count: u64) -> Result<(), Stop> {
        self.values = self.values.checked_sub(count).ok_or(Damage::EventSize)?;
        Ok(())
    }

    pub fn take_bytes(&mut self, count: u64) -> Result<(), Stop> {
        self.bytes = self.bytes.checked_sub(count).ok_or(Damage::EventSize)?;
        Ok(())
    }

    /// Bytes of memory that were taken.
    fn used(&self) -> u64 {
        let values = Self::WHOLE.values - self.values;
        values * size_of::<Value>() as u64 + (Self::WHOLE.bytes - self.bytes)
    }
}

/// What the header says.
#[derive(Default)]
pub(super) struct Header {
    pub semantic_version: u32,
    pub properties: Vec<(String, String)>,
}

/// Reads the stream's parts, and keeps the signatures that they define on the way.
pub(super) struct Parser {
    pub input: Input,
    pub version: u32,
    pub signatures: Signatures,
    pub(super) budget: Budget,
    /// Names, and bytes of them, that signatures may still hold.
    pub(super) names_left: u64,
    pub(super) name_bytes_left: u64,
}

impl Parser {
    pub fn new(blocks: Blocks) -> Self {
        Self {
            input: Input::new(blocks),
            version: 0,
            signatures: Signatures::default(),
            budget: Budget::WHOLE,
            names_left: limits::SIGNATURE_NAMES,
            name_bytes_left: limits::SIGNATURE_BYTES,
        }
    }

    pub fn header(&mut self) -> Result<Header, Stop> {
        self.version = self.known_version()?;
        let mut header = Header { semantic_version: self.version, properties: Vec::new() };
        if self.version >= format::VERSION_PROPERTIES {
            header.semantic_version = self.known_version()?;
            loop {
                let name = self.name()?;
                if name.is_empty() {
                    break;
                }
                let value = self.name()?;
                header.properties.push((name.into(), value.into()));
            }
        }
        Ok(header)
    }

    fn known_version(&mut self) -> Result<u32, Stop> {
        match self.input.uint()? {
            version if version <= NEWEST_VERSION.into() => Ok(version as u32),
            version => Err(Stop::Failed(TraceError::UnsupportedVersion { version }.into())),
        }
    }

    /// What follows the tag of an enter event.
    pub fn enter(&mut self, number: u32, call: &mut Call) -> Result<(), Stop> {
        let thread = match self.version {
            format::VERSION_THREAD_IN_ENTER.. => self.thread()?,
            _ => 0,
        };
        let signature = self.function()?;
        let arguments = self.signatures.function(signature).arg_names.len();
        call.reset(number, thread, signature, arguments);
        self.details(call)
    }

    fn thread(&mut self) -> Result<u32, Stop> {
        let thread = self.input.uint()?;
        u32::try_from(thread).map_err(|_| Damage::Thread(thread).into())
    }

    /// The details of an event, up to and including their end.
    ///
    /// After an error the call holds every detail that was read whole.
    pub fn details(&mut self, call: &mut Call) -> Result<(), Stop> {
        self.budget = Budget::WHOLE;
        loop {
            match self.input.byte()? {
                detail::END => break,
                detail::ARGUMENT => self.argument(call)?,
                detail::RETURN => {
                    let mut value = Value::Absent;
                    self.value(&mut value)?;
                    call.ret = Some(value);
                }
                detail::THREAD if self.version < format::VERSION_THREAD_IN_ENTER => {
                    call.thread = self.thread()?;
                }
                detail::BACKTRACE => self.backtrace(call)?,
                detail::FLAGS => call.fake |= self.input.uint()? & flag::FAKE != 0,
                other => return Err(Damage::Detail(other).into()),
            }
        }
        call.weight += self.budget.used();
        Ok(())
    }

    #[inline]
    fn argument(&mut self, call: &mut Call) -> Result<(), Stop> {
        let number = self.input.uint()?;
        if number >= limits::ARGUMENTS {
            return Err(Damage::ArgumentNumber(number).into());
        }
        let index = number as usize;
        if index >= call.args.len() {
            call.args.resize_with(index + 1, Value::default);
        }
        self.value(&mut call.args[index])
    }

    fn backtrace(&mut self, call: &mut Call) -> Result<(), Stop> {
        let count = self.input.uint()?;
        if count > limits::BACKTRACE {
            return Err(Damage::BacktraceLength(count).into());
        }
        self.budget.take_values(count)?;
        let mut frames = Vec::new();
        for _ in 0..count {
            frames.push(self.stack_frame()?);
        }
        call.backtrace = frames;
        Ok(())
    }

    fn stack_frame(&mut self) -> Result<FrameId, Stop> {
        let id = self.input.uint()?;
        if let Some(index) = self.signatures.frames.find(id) {
            return Ok(index.into());
        }
        self.claim_names(1)?;
        let mut place = StackFrame::default();
        loop {
            match self.input.byte()? {
                frame::END => break,
                frame::MODULE => place.module = Some(self.name()?),
                frame::FUNCTION => place.function = Some(self.name()?),
                frame::FILE => place.file = Some(self.name()?),
                frame::LINE => place.line = Some(self.input.uint()?),
                frame::OFFSET => place.offset = Some(self.input.uint()?),
                other => return Err(Damage::FrameDetail(other).into()),
            }
        }
        Ok(self.signatures.frames.insert(id, place).into())
    }
}
