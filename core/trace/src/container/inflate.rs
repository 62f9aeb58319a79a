//! gzip and zlib streams (RFC 1952 and RFC 1950).
//!
//! The library's own [`Read`] adapters forget what they had decoded when they come upon damage; hence this use of the
//! interface below them, with gzip's few bytes around the data read here.

use std::io::{BufRead, Read};

use flate2::{Crc, Decompress, FlushDecompress, Status};

use super::{BLOCK_BYTES, Decode, DecodeError, Source};

pub(super) const GZIP_MAGIC: [u8; 2] = [0x1f, 0x8b];

/// gzip's number for the only method there is.
const DEFLATE: u8 = 8;

/// Bits that announce parts of a gzip header.
mod flag {
    pub const HEADER_CHECK: u8 = 1 << 1;
    pub const EXTRA: u8 = 1 << 2;
    pub const NAME: u8 = 1 << 3;
    pub const COMMENT: u8 = 1 << 4;
}

#[derive(Clone, Copy)]
enum State {
    /// Before a gzip member, of which there may be several.
    Member {
        first: bool,
    },
    Data,
    Finished,
}

pub(super) struct InflateDecoder {
    source: Source,
    inflate: Decompress,
    state: State,
    /// Check sum of a gzip member; that of zlib is the library's business.
    crc: Option<Crc>,
}

impl InflateDecoder {
    pub fn gzip(source: Source) -> Self {
        Self {
            source,
            inflate: Decompress::new(false),
            state: State::Member { first: true },
            crc: Some(Crc::new()),
        }
    }

    pub fn zlib(source: Source) -> Self {
        Self { source, inflate: Decompress::new(true), state: State::Data, crc: None }
    }

    /// Decodes until `output` is full or the stream ends; `filled` counts the bytes, whether or not all goes well.
    fn decode(&mut self, output: &mut [u8], filled: &mut usize) -> Result<(), DecodeError> {
        while *filled < output.len() {
            match self.state {
                State::Member { first } => self.begin_member(first)?,
                State::Data => self.inflate(output, filled)?,
                State::Finished => break,
            }
        }
        Ok(())
    }

    fn inflate(&mut self, output: &mut [u8], filled: &mut usize) -> Result<(), DecodeError> {
        let input = self.source.fill_buf()?;
        let free = &mut output[*filled..];
        let (read, written) = (self.inflate.total_in(), self.inflate.total_out());
        let result = self.inflate.decompress(input, free, FlushDecompress::None);
        let read = (self.inflate.total_in() - read) as usize;
        let written = (self.inflate.total_out() - written) as usize;
        self.source.consume(read);
        if let Some(crc) = &mut self.crc {
            crc.update(&free[..written]);
        }
        *filled += written;
        match result.map_err(DecodeError::corrupt)? {
            Status::StreamEnd => self.end_member(),
            // Only for want of input does nothing happen.
            _ if read == 0 && written == 0 => Err(DecodeError::Truncated),
            _ => Ok(()),
        }
    }

    /// Reads the header of a gzip member (RFC 1952, section 2.3), if there is one more.
    fn begin_member(&mut self, first: bool) -> Result<(), DecodeError> {
        // zlib, too, ignores what follows the last member.
        if !first && !self.source.fill_buf()?.starts_with(&GZIP_MAGIC[..1]) {
            self.state = State::Finished;
            return Ok(());
        }
        let [magic0, magic1, method, flags, _time @ .., _level, _system] = self.bytes::<10>()?;
        if [magic0, magic1] != GZIP_MAGIC || method != DEFLATE {
            return Err(DecodeError::corrupt("invalid gzip header"));
        }
        if flags & flag::EXTRA != 0 {
            let length = u16::from_le_bytes(self.bytes()?);
            self.skip(length.into())?;
        }
        for text in [flag::NAME, flag::COMMENT] {
            while flags & text != 0 && self.bytes()? != [0] {}
        }
        if flags & flag::HEADER_CHECK != 0 {
            self.skip(2)?;
        }
        self.inflate.reset(false);
        self.crc = Some(Crc::new());
        self.state = State::Data;
        Ok(())
    }

    /// Reads and checks what follows the data.
    fn end_member(&mut self) -> Result<(), DecodeError> {
        let Some(crc) = self.crc.take() else {
            self.state = State::Finished;
            return Ok(());
        };
        let (sum, length) = (crc.sum(), crc.amount());
        let recorded = [self.bytes()?, self.bytes()?].map(u32::from_le_bytes);
        if recorded != [sum, length] {
            return Err(DecodeError::corrupt("wrong gzip check sum"));
        }
        self.state = State::Member { first: false };
        Ok(())
    }

    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let mut bytes = [0; N];
        self.source.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    fn skip(&mut self, count: usize) -> Result<(), DecodeError> {
        (0..count).try_for_each(|_| self.bytes::<1>().map(|_| ()))
    }
}

impl Decode for InflateDecoder {
    fn next_block(&mut self, block: &mut Vec<u8>) -> Result<(), DecodeError> {
        block.resize(BLOCK_BYTES, 0);
        let mut filled = 0;
        let result = self.decode(block, &mut filled);
        block.truncate(filled);
        result
    }
}
