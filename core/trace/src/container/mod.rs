//! Containers: the ways in which the stream of events is compressed into a file.
//!
//! Each is a [`Decode`]r that yields the stream in blocks of about a mebibyte, so that memory stays bounded however
//! large the trace; [`Blocks`] runs it on a thread of its own.

mod blocks;
mod brotli;
mod detect;
mod inflate;
mod raw;
mod snappy;
mod snappy_prefix;

use std::fmt;
use std::io::{self, BufRead, Read};

pub(crate) use blocks::Blocks;
pub(crate) use detect::open;
pub(crate) use snappy::MAGIC as SNAPPY_MAGIC;

/// The way in which a trace is compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Container {
    /// Chunks of Snappy behind the bytes `at`: what apitrace records.
    Snappy,
    /// What old versions of apitrace recorded.
    Gzip,
    Zlib,
    /// What `apitrace repack --brotli` writes.
    Brotli,
    /// Not compressed.
    Raw,
}

impl fmt::Display for Container {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Snappy => "Snappy",
            Self::Gzip => "gzip",
            Self::Zlib => "zlib",
            Self::Brotli => "Brotli",
            Self::Raw => "uncompressed",
        })
    }
}

/// A file's bytes, as they are stored.
type Source = Box<dyn BufRead + Send>;

/// Bytes of the blocks that a stream without chunks of its own is cut into.
const BLOCK_BYTES: usize = 1 << 20;

/// Decompresses a stream block by block.
pub(crate) trait Decode: Send {
    /// Replaces `block` with the next bytes of the stream, or with nothing at the clean end.
    ///
    /// After an error, what `block` holds is still part of the stream, and nothing more follows.
    fn next_block(&mut self, block: &mut Vec<u8>) -> Result<(), DecodeError>;
}

/// Why decompression ended before the stream did.
#[derive(Debug)]
pub(crate) enum DecodeError {
    /// The file ends too early.
    Truncated,
    /// The data cannot have been written by a compressor.
    Corrupt(io::Error),
    /// The file cannot be read.
    Io(io::Error),
}

impl DecodeError {
    fn corrupt(reason: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        Self::Corrupt(io::Error::new(io::ErrorKind::InvalidData, reason))
    }
}

impl From<io::Error> for DecodeError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Self::Truncated,
            io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput => Self::Corrupt(error),
            _ => Self::Io(error),
        }
    }
}

/// Reads until `buffer` is full or the source is at its end; `filled` counts the bytes, whether or not all goes well.
fn fill(source: &mut impl Read, buffer: &mut [u8], filled: &mut usize) -> io::Result<()> {
    while *filled < buffer.len() {
        match source.read(&mut buffer[*filled..])? {
            0 => break,
            count => *filled += count,
        }
    }
    Ok(())
}
