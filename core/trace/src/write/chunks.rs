//! apitrace's framing of Snappy, written: `a` `t`, then chunks, each a 32-bit little-endian length and raw Snappy data.

use std::io::{self, Write};

use crate::container::SNAPPY_MAGIC;

/// Bytes of a chunk before compression. apitrace's own reader has no room for more.
const CHUNK: usize = 1 << 20;

/// Bytes on their way to a sink, collected in chunks.
pub(super) struct Chunks<W> {
    sink: W,
    pending: Vec<u8>,
    frame: Vec<u8>,
    encoder: snap::raw::Encoder,
    error: Option<io::Error>,
}

impl<W: Write> Chunks<W> {
    pub fn new(mut sink: W) -> io::Result<Self> {
        sink.write_all(&SNAPPY_MAGIC)?;
        Ok(Self {
            sink,
            pending: Vec::with_capacity(CHUNK),
            frame: Vec::new(),
            encoder: snap::raw::Encoder::new(),
            error: None,
        })
    }

    #[inline]
    pub fn byte(&mut self, byte: u8) {
        self.pending.push(byte);
        if self.pending.len() >= CHUNK {
            self.write_chunk();
        }
    }

    #[inline]
    pub fn bytes(&mut self, bytes: &[u8]) {
        if self.pending.len() + bytes.len() < CHUNK {
            self.pending.extend_from_slice(bytes);
        } else {
            self.long_bytes(bytes);
        }
    }

    #[cold]
    fn long_bytes(&mut self, mut bytes: &[u8]) {
        while !bytes.is_empty() {
            let room = (CHUNK - self.pending.len()).min(bytes.len());
            let (now, later) = bytes.split_at(room);
            self.pending.extend_from_slice(now);
            bytes = later;
            if self.pending.len() >= CHUNK {
                self.write_chunk();
            }
        }
    }

    /// An unsigned integer: seven bits a byte, the low ones first.
    #[inline]
    pub fn uint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.byte(value as u8 | 0x80);
            value >>= 7;
        }
        self.byte(value as u8);
    }

    /// A length and so many bytes.
    #[inline]
    pub fn string(&mut self, bytes: &[u8]) {
        self.uint(bytes.len() as u64);
        self.bytes(bytes);
    }

    /// Writes what is pending.
    ///
    /// # Errors
    /// The first error of the sink, once; nothing is written after it.
    pub fn flush(&mut self) -> io::Result<()> {
        self.write_chunk();
        match self.error.take() {
            Some(error) => {
                self.error = Some(error.kind().into());
                Err(error)
            }
            None => self.sink.flush(),
        }
    }

    #[cold]
    fn write_chunk(&mut self) {
        if !self.pending.is_empty() && self.error.is_none() {
            self.error = self.try_write_chunk().err();
        }
        self.pending.clear();
    }

    /// One write a chunk, so that a process that is killed leaves whole chunks where the system allows it.
    fn try_write_chunk(&mut self) -> io::Result<()> {
        let length = u32::BITS as usize / 8;
        self.frame.resize(length + snap::raw::max_compress_len(self.pending.len()), 0);
        let written = self.encoder.compress(&self.pending, &mut self.frame[length..])?;
        self.frame[..length].copy_from_slice(&(written as u32).to_le_bytes());
        self.sink.write_all(&self.frame[..length + written])
    }
}
