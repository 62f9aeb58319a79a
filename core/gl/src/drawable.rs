//! What a context draws to, as far as it knows it: size and buffers, and when a picture in it is complete.
//!
//! A buffer swap ends a frame. Where nothing is swapped, in a drawable with one buffer or in the front one of two, what
//! is drawn shows with the next glFlush or glFinish. It is a picture of its own if the colours of the whole window were
//! cleared for it; else it was drawn over the picture before.

use afterglow_api::constants::*;

use crate::backend::End;
use crate::context::Context;
use crate::frame::{Frame, Operation, Rect};
use crate::tables::Dirty;

/// The buffers of a drawable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Buffers {
    /// There is a back buffer.
    pub is_double: bool,
    /// Bits of depth.
    pub depth: u8,
    /// Bits of stencil.
    pub stencil: u8,
    /// Bits of each component of the accumulation buffer.
    pub accumulation: u8,
}

impl Default for Buffers {
    fn default() -> Self {
        Self { is_double: true, depth: 24, stencil: 8, accumulation: 16 }
    }
}

/// The drawable, and what went to it.
#[derive(Debug, Default)]
pub(crate) struct Output {
    size: Option<(u32, u32)>,
    pub(crate) buffers: Buffers,
    /// Pixels are read from another drawable.
    pub(crate) reads_elsewhere: bool,
    /// The colours were cleared since the last picture was complete, in what was handed over.
    is_cleared: bool,
    /// Something may have been drawn to the front buffer since it was shown last.
    has_drawn_front: bool,
    /// The program swaps buffers: what it draws to the front one is no picture of its own.
    is_swapped: bool,
}

impl Output {
    /// Takes note of what is handed over.
    pub(crate) fn note(&mut self, frame: &Frame, end: End) {
        self.is_cleared = end == End::Continued && (self.is_cleared || is_cleared(frame));
    }
}

/// Whether a frame clears the colours of the whole drawable.
fn is_cleared(frame: &Frame) -> bool {
    let (width, height) = (frame.size.0 as i32, frame.size.1 as i32);
    let covers = |scissor: &Rect| {
        let (right, top) =
            (scissor.x.saturating_add(scissor.width), scissor.y.saturating_add(scissor.height));
        scissor.x <= 0 && scissor.y <= 0 && right >= width && top >= height
    };
    frame.operations.iter().any(|operation| match operation {
        Operation::Clear(clear) => clear.color.is_some() && clear.scissor.as_ref().is_none_or(covers),
        _ => false,
    })
}

/// Whether drawing to this buffer shows at once.
fn is_front(buffer: u32) -> bool {
    matches!(buffer, GL_FRONT | GL_FRONT_LEFT | GL_LEFT | GL_FRONT_AND_BACK)
}

impl Context {
    /// Says how large the drawable is. The first call sets viewport and scissor to all of it.
    pub fn set_drawable(&mut self, width: u32, height: u32) {
        if self.output.size.is_none() {
            let rect = Rect { x: 0, y: 0, width: width as i32, height: height as i32 };
            self.state.viewport.rect = rect;
            self.state.scissor = rect;
            self.dirty(Dirty::VIEWPORT);
        }
        self.output.size = Some((width, height));
        self.frame.size = (width, height);
    }

    /// Size of the drawable, pixels.
    pub fn drawable(&self) -> (u32, u32) {
        self.output.size.unwrap_or((0, 0))
    }

    /// Says what buffers the drawable has. Before the first drawable, they decide what is drawn to and read from.
    pub fn set_buffers(&mut self, buffers: Buffers) {
        if self.output.size.is_none() {
            let initial = if buffers.is_double { GL_BACK } else { GL_FRONT };
            self.state.color.draw_buffer = initial;
            self.state.pixel.read_buffer = initial;
        }
        self.output.buffers = buffers;
    }

    /// Whether the drawable has a buffer; an error if not.
    pub(crate) fn has_buffer(&mut self, buffer: u32) -> bool {
        let exists = match buffer {
            GL_BACK | GL_BACK_LEFT => self.output.buffers.is_double,
            // No stereo and no auxiliary buffers.
            GL_FRONT_RIGHT | GL_BACK_RIGHT | GL_RIGHT | GL_AUX0..=GL_AUX3 => false,
            _ => true,
        };
        if !exists {
            self.record_error(GL_INVALID_OPERATION);
        }
        exists
    }

    /// Takes note that another buffer may be drawn to from now on.
    pub(crate) fn note_draw_buffer(&mut self) {
        self.output.has_drawn_front |=
            is_front(self.state.color.draw_buffer) && !self.frame.operations.is_empty();
    }

    /// Whether what is drawn shows without a buffer swap: with one buffer, or drawn to the front one of two. What was
    /// drawn to that before does not count again.
    pub fn shows_at_once(&mut self) -> bool {
        let has_drawn_front = std::mem::take(&mut self.output.has_drawn_front);
        !self.output.buffers.is_double || has_drawn_front || is_front(self.state.color.draw_buffer)
    }

    /// glXSwapBuffers: the frame is complete.
    pub fn swap_buffers(&mut self) {
        self.output.is_swapped = true;
        self.hand_over(End::Swap);
    }

    /// Hands over what has been recorded of a frame that goes on: before another context or drawable becomes current.
    /// Whether there was anything. Between Begin and End, nothing is handed over.
    pub fn hand_over_so_far(&mut self) -> bool {
        let has_any = self.has_something();
        if has_any {
            self.hand_over(End::Continued);
        }
        has_any
    }

    /// glFlush where a buffer swap will show the picture: other contexts are to see what has been recorded.
    pub fn flush_so_far(&mut self) {
        if self.has_something() {
            self.output.note(&self.frame, End::Continued);
            let so_far = self.take_frame();
            self.backend.flush(so_far);
            self.follow_device();
        }
    }

    /// glFlush where what is drawn shows at once. The picture is complete if the window was cleared for it.
    pub fn hand_over_picture(&mut self) {
        if !self.has_something() {
            return;
        }
        let is_cleared = self.output.is_cleared || is_cleared(&self.frame);
        let draws = |operation: &Operation| {
            matches!(operation, Operation::Draw(_) | Operation::Pixels(_) | Operation::CopyPixels(_))
        };
        let end = match self.frame.operations.iter().any(draws) {
            _ if self.output.is_swapped => End::Continued,
            true if is_cleared => End::Swap,
            false if is_cleared => End::Continued,
            _ => End::Over,
        };
        self.hand_over(end);
    }

    fn has_something(&self) -> bool {
        !self.in_begin() && !self.frame.operations.is_empty()
    }
}
