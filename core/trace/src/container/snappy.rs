//! apitrace's own framing of Snappy: `a` `t`, then chunks, each a 32-bit little-endian length and raw Snappy data.

use std::io::Read;

use super::snappy_prefix::decode_prefix;
use super::{Decode, DecodeError, Source, fill};
use crate::format::limits;

pub(crate) const MAGIC: [u8; 2] = *b"at";

/// Decodes the chunks that follow the magic.
pub(super) struct SnappyDecoder {
    source: Source,
    compressed: Vec<u8>,
}

impl SnappyDecoder {
    pub fn new(source: Source) -> Self {
        Self { source, compressed: Vec::new() }
    }

    /// Compressed bytes of the next chunk; `None` at the end of the file.
    fn chunk_length(&mut self) -> Result<Option<u32>, DecodeError> {
        let (mut bytes, mut read) = ([0; 4], 0);
        fill(&mut self.source, &mut bytes, &mut read)?;
        match read {
            0 => Ok(None),
            4 => match u32::from_le_bytes(bytes) {
                // A file system may have filled the tail of a file that was never written with zeros.
                0 => Err(DecodeError::Truncated),
                length if length > limits::SNAPPY_CHUNK => Err(DecodeError::corrupt("overlong chunk")),
                length => Ok(Some(length)),
            },
            _ => Err(DecodeError::Truncated),
        }
    }

    /// Reads a chunk's data, or as much as there is.
    fn read_chunk(&mut self, length: u32) -> Result<(), DecodeError> {
        self.compressed.clear();
        let mut chunk = self.source.by_ref().take(length.into());
        chunk.read_to_end(&mut self.compressed)?;
        match self.compressed.len() == length as usize {
            true => Ok(()),
            false => Err(DecodeError::Truncated),
        }
    }

    /// Replaces `block` with what the chunk decodes to, or as much of it as can be decoded.
    fn decode_chunk(&self, block: &mut Vec<u8>) -> Result<(), DecodeError> {
        let result = match snap::raw::decompress_len(&self.compressed) {
            Ok(length) if length > limits::SNAPPY_CHUNK as usize => {
                Err(DecodeError::corrupt("overlong chunk"))
            }
            Ok(length) => {
                block.resize(length, 0);
                let decoded = snap::raw::Decoder::new().decompress(&self.compressed, block);
                decoded.map(|_| ()).map_err(DecodeError::corrupt)
            }
            Err(error) => Err(DecodeError::corrupt(error)),
        };
        if result.is_err() {
            decode_prefix(&self.compressed, block);
        }
        result
    }
}

impl Decode for SnappyDecoder {
    fn next_block(&mut self, block: &mut Vec<u8>) -> Result<(), DecodeError> {
        loop {
            let length = match self.chunk_length() {
                Ok(Some(length)) => length,
                end => {
                    block.clear();
                    return end.map(|_| ());
                }
            };
            if let Err(error) = self.read_chunk(length) {
                decode_prefix(&self.compressed, block);
                return Err(error);
            }
            self.decode_chunk(block)?;
            if !block.is_empty() {
                return Ok(());
            }
        }
    }
}
