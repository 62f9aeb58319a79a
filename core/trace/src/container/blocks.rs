//! Decompression on a thread of its own, a few blocks ahead of the parser.

use std::sync::mpsc::{self, Receiver, Sender, SyncSender};
use std::thread;

use super::{Container, Decode, DecodeError};
use crate::error::{Stop, TraceError};

/// Blocks that may lie ready; bounds memory, and evens out blocks that take longer than others.
const BLOCKS_AHEAD: usize = 4;

/// What the decoder's thread says.
enum Message {
    Block(Vec<u8>),
    End(Result<(), DecodeError>),
}

/// The decompressed stream, a block at a time.
pub(crate) struct Blocks {
    container: Container,
    messages: Receiver<Message>,
    used: Sender<Vec<u8>>,
    /// Bytes in the blocks received so far.
    received: u64,
}

impl Blocks {
    /// Starts the decoder's thread. It ends by itself when the blocks are dropped.
    pub fn start(container: Container, decoder: Box<dyn Decode>) -> Result<Self, TraceError> {
        let (sender, messages) = mpsc::sync_channel(BLOCKS_AHEAD);
        let (used, reusable) = mpsc::channel();
        thread::Builder::new()
            .name("trace-decoder".into())
            .spawn(move || decode(decoder, &sender, &reusable))
            .map_err(TraceError::Io)?;
        Ok(Self { container, messages, used, received: 0 })
    }

    /// The next block, which is not empty, in exchange for the one parsed before.
    pub fn next(&mut self, parsed: Vec<u8>) -> Result<Vec<u8>, Stop> {
        // The decoder may be done already; then nobody wants the memory.
        let _ = self.used.send(parsed);
        match self.messages.recv() {
            Ok(Message::Block(block)) => {
                self.received += block.len() as u64;
                Ok(block)
            }
            Ok(Message::End(end)) => Err(self.stop(end)),
            Err(mpsc::RecvError) => Err(Stop::Failed(TraceError::DecoderStopped.into())),
        }
    }

    fn stop(&self, end: Result<(), DecodeError>) -> Stop {
        match end {
            Ok(()) => Stop::End { cut: false },
            Err(DecodeError::Truncated) => Stop::End { cut: true },
            Err(DecodeError::Io(error)) => Stop::Failed(TraceError::Io(error).into()),
            Err(DecodeError::Corrupt(source)) => {
                let (container, offset) = (self.container, self.received);
                let error = TraceError::Container { container, offset, source };
                Stop::Failed(error.into())
            }
        }
    }
}

/// Sends all blocks, then how the stream ended; gives up when nobody listens any more.
fn decode(mut decoder: Box<dyn Decode>, sender: &SyncSender<Message>, reusable: &Receiver<Vec<u8>>) {
    loop {
        let mut block = reusable.try_recv().unwrap_or_default();
        let result = decoder.next_block(&mut block);
        let ended = result.is_err() || block.is_empty();
        if !block.is_empty() && sender.send(Message::Block(block)).is_err() {
            return;
        }
        if ended {
            // If nobody listens, nobody wants to know.
            let _ = sender.send(Message::End(result));
            return;
        }
    }
}
