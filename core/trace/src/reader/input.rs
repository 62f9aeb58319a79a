//! Primitive types, read across the borders of blocks.

use std::sync::Arc;

use crate::container::Blocks;
use crate::error::{Damage, Stop};

/// Bytes reserved on the word of a length alone.
const TRUSTED_BYTES: usize = 1 << 16;

/// The decompressed stream.
pub(super) struct Input {
    blocks: Blocks,
    block: Vec<u8>,
    /// Position in `block`.
    at: usize,
    /// Position of `block` in the stream.
    start: u64,
}

impl Input {
    pub fn new(blocks: Blocks) -> Self {
        Self { blocks, block: Vec::new(), at: 0, start: 0 }
    }

    /// Decompressed bytes read so far.
    pub fn position(&self) -> u64 {
        self.start + self.at as u64
    }

    #[inline]
    pub fn byte(&mut self) -> Result<u8, Stop> {
        if self.at == self.block.len() {
            self.refill()?;
        }
        let byte = self.block[self.at];
        self.at += 1;
        Ok(byte)
    }

    /// Replaces the block, which is used up, by the next.
    #[cold]
    fn refill(&mut self) -> Result<(), Stop> {
        self.start += self.block.len() as u64;
        self.at = 0;
        self.block = self.blocks.next(std::mem::take(&mut self.block))?;
        Ok(())
    }

    /// An integer of 7 bits a byte, the lowest first.
    #[inline]
    pub fn uint(&mut self) -> Result<u64, Stop> {
        match self.block.get(self.at) {
            Some(&byte) if byte < 0x80 => {
                self.at += 1;
                Ok(byte.into())
            }
            _ => self.long_uint(),
        }
    }

    fn long_uint(&mut self) -> Result<u64, Stop> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            let bits = u64::from(byte & 0x7f);
            if bits << shift >> shift != bits {
                return Err(Damage::Integer.into());
            }
            value |= bits << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err(Damage::Integer.into())
    }

    pub fn f32(&mut self) -> Result<f32, Stop> {
        Ok(f32::from_le_bytes(self.array()?))
    }

    pub fn f64(&mut self) -> Result<f64, Stop> {
        Ok(f64::from_le_bytes(self.array()?))
    }

    #[inline]
    fn array<const N: usize>(&mut self) -> Result<[u8; N], Stop> {
        if let Some(&bytes) = self.block[self.at..].first_chunk() {
            self.at += N;
            return Ok(bytes);
        }
        let mut bytes = [0; N];
        for byte in &mut bytes {
            *byte = self.byte()?;
        }
        Ok(bytes)
    }

    pub fn bytes(&mut self, length: usize) -> Result<Vec<u8>, Stop> {
        let mut bytes = Vec::with_capacity(length.min(TRUSTED_BYTES));
        while bytes.len() < length {
            if self.at == self.block.len() {
                self.refill()?;
            }
            let rest = &self.block[self.at..];
            let part = &rest[..rest.len().min(length - bytes.len())];
            bytes.extend_from_slice(part);
            self.at += part.len();
        }
        Ok(bytes)
    }

    pub fn shared_bytes(&mut self, length: usize) -> Result<Arc<[u8]>, Stop> {
        match self.block[self.at..].get(..length) {
            Some(bytes) => {
                let shared = bytes.into();
                self.at += length;
                Ok(shared)
            }
            None => self.bytes(length).map(Into::into),
        }
    }
}
