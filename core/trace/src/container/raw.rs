//! The stream as it is.

use super::{BLOCK_BYTES, Decode, DecodeError, Source, fill};

pub(super) struct RawDecoder {
    source: Source,
}

impl RawDecoder {
    pub fn new(source: Source) -> Self {
        Self { source }
    }
}

impl Decode for RawDecoder {
    fn next_block(&mut self, block: &mut Vec<u8>) -> Result<(), DecodeError> {
        block.resize(BLOCK_BYTES, 0);
        let mut filled = 0;
        let result = fill(&mut self.source, block, &mut filled);
        block.truncate(filled);
        Ok(result?)
    }
}
