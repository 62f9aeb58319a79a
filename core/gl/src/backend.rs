//! The one channel between a context and what executes its frames: frames go out, replies come back.

use crate::frame::{Frame, ImageKey, PixelBuffer, Rect, Region};

/// Why a frame is handed over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The program swapped buffers, or flushed a whole picture in a single buffer: the frame is complete.
    Swap,
    /// The program flushed what it drew over the picture that a single buffer shows.
    Over,
    /// The frame goes on: what has been recorded is handed over early (too many bytes, a flush of
    /// single-buffered drawing, another context's turn).
    Continued,
}

/// A question that needs the result of the operations so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Request {
    /// Pixels of the window, lower left corner first.
    Pixels {
        /// Which buffer.
        buffer: PixelBuffer,
        /// Which pixels; those outside the window come back as zero.
        rect: Rect,
    },
    /// Texels of an image.
    Texels {
        /// Which image.
        image: ImageKey,
        /// Which texels.
        region: Region,
    },
    /// Result of an occlusion query.
    Query(u32),
    /// Nothing but to have finished.
    Finish,
}

/// The answer to a [`Request`].
#[derive(Debug, Clone, PartialEq)]
pub enum Reply {
    /// RGBA bytes, rows from the lowest upward (colour pixels, texels).
    Color(Vec<u8>),
    /// Depth, 0 to 1, rows from the lowest upward.
    Depth(Vec<f32>),
    /// Stencil values, rows from the lowest upward.
    Stencil(Vec<u8>),
    /// Samples that passed.
    Samples(u32),
    /// Finished.
    Done,
    /// There is no device, or it failed: the context answers with zeros.
    Unavailable,
}

/// Executes frames.
pub trait Backend: Send {
    /// Takes a frame. Frames arrive in order.
    fn submit(&mut self, frame: Frame, end: End);

    /// Takes the operations so far of a frame that goes on, and answers a question about them.
    fn answer(&mut self, so_far: Frame, request: Request) -> Reply;

    /// Takes the operations so far of a frame that goes on, which other contexts are to see from now on.
    fn flush(&mut self, so_far: Frame) {
        self.submit(so_far, End::Continued);
    }

    /// Waits until all that was handed over is done.
    fn wait(&mut self) {}

    /// An empty frame, with the memory of an earlier one where possible.
    fn recycle(&mut self) -> Frame {
        Frame::default()
    }

    /// The number of the device that images are on. It changes when the device was lost with all of them: a context
    /// then defines anew what it needs.
    fn device(&self) -> u64 {
        0
    }
}

/// Executes nothing, and gives frames back at once as an infinitely fast device would: what is left is the cost of a
/// context.
#[derive(Debug, Default)]
pub struct Discard {
    kept: Option<Frame>,
}

impl Backend for Discard {
    fn submit(&mut self, frame: Frame, _: End) {
        self.kept = Some(frame);
    }

    fn answer(&mut self, so_far: Frame, request: Request) -> Reply {
        self.kept = Some(so_far);
        match request {
            Request::Finish => Reply::Done,
            _ => Reply::Unavailable,
        }
    }

    fn recycle(&mut self) -> Frame {
        self.kept.take().unwrap_or_default()
    }
}

/// Executes nothing and answers that it cannot: a context without a device.
#[derive(Debug, Default)]
pub struct NullBackend;

impl Backend for NullBackend {
    fn submit(&mut self, _: Frame, _: End) {}

    fn answer(&mut self, _: Frame, _: Request) -> Reply {
        Reply::Unavailable
    }
}
