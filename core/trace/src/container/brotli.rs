//! Brotli streams.
//!
//! The library's own [`Read`](std::io::Read) adapter reports a stream that was cut and one that is damaged in the same
//! way, and forgets what it had decoded; hence this use of the interface below it.

use std::io::BufRead;

use brotli::enc::StandardAlloc;
use brotli::{BrotliDecompressStream, BrotliResult, BrotliState};

use super::{BLOCK_BYTES, Decode, DecodeError, Source};

/// Bytes of compressed data handed over at once. Whatever these decode to is lost if they are damaged, so: few.
const INPUT_BYTES: usize = 1 << 14;

pub(super) struct BrotliDecoder {
    source: Source,
    state: BrotliState<StandardAlloc, StandardAlloc, StandardAlloc>,
    finished: bool,
}

impl BrotliDecoder {
    pub fn new(source: Source) -> Self {
        let alloc = StandardAlloc::default;
        Self {
            source,
            // Strict: with windows of at most 16 MiB, and apitrace writes no larger ones.
            state: BrotliState::new_strict(alloc(), alloc(), alloc()),
            finished: false,
        }
    }

    /// Decodes until `output` is full or the stream ends; `filled` counts the bytes, whether or not all goes well.
    fn decode(&mut self, output: &mut [u8], filled: &mut usize) -> Result<(), DecodeError> {
        while *filled < output.len() && !self.finished {
            let input = self.source.fill_buf()?;
            let mut available = input.len().min(INPUT_BYTES);
            let at_end = available == 0;
            let (mut used, mut free, mut total) = (0, output.len() - *filled, 0);
            let result = BrotliDecompressStream(
                &mut available,
                &mut used,
                input,
                &mut free,
                filled,
                output,
                &mut total,
                &mut self.state,
            );
            self.source.consume(used);
            match result {
                BrotliResult::NeedsMoreInput if at_end => return Err(DecodeError::Truncated),
                BrotliResult::NeedsMoreInput | BrotliResult::NeedsMoreOutput => {}
                BrotliResult::ResultSuccess => self.finished = true,
                BrotliResult::ResultFailure => {
                    return Err(DecodeError::corrupt("invalid Brotli data"));
                }
            }
        }
        Ok(())
    }
}

impl Decode for BrotliDecoder {
    fn next_block(&mut self, block: &mut Vec<u8>) -> Result<(), DecodeError> {
        block.resize(BLOCK_BYTES, 0);
        let mut filled = 0;
        let result = self.decode(block, &mut filled);
        block.truncate(filled);
        result
    }
}
