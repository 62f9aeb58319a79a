//! Frames that are handed over in parts.
//!
//! A program may read pixels, or ask for a query's result, amid a frame. The question is answered from the rasterized
//! picture of the operations so far. When the frame is complete, the window is put back to how it was before it, and
//! all of the frame is executed with its world traced. A question about most of the window is taken for a picture of
//! the finished frame: then the world is traced before it is answered.

use afterglow_gl::backend::{End, Reply, Request};
use afterglow_gl::frame::{Frame, Operation, PixelBuffer};

use crate::error::RenderError;
use crate::renderer::Renderer;

/// Words of vertices that are kept of a frame in parts, at most; of a larger one the rest is rasterized.
const MOST_WORDS: usize = 1 << 24;

/// What was handed over of a frame that is going on.
pub(crate) enum Parts {
    /// Nothing.
    None,
    /// These operations were rasterized, to be executed again.
    Held(Box<Held>),
    /// What there is stays as it is, and the rest is rasterized over it.
    Settled,
}

pub(crate) struct Held {
    frame: Frame,
}

impl Renderer {
    /// Executes a frame, or a part of one.
    pub(crate) fn execute_part(&mut self, frame: &mut Frame, end: End) -> Result<(), RenderError> {
        match (self.take_parts(), end) {
            (None, _) => self.execute(frame),
            (Some(Parts::None), End::Swap) => self.execute_traced(frame),
            (Some(parts @ (Parts::None | Parts::Held(_))), End::Continued) => self.hold(parts, frame),
            (Some(Parts::Held(held)), End::Swap) => self.execute_whole(*held, frame),
            (Some(parts), End::Over) => {
                self.settle_held(parts, frame);
                self.observe(frame);
                self.execute(frame)
            }
            (Some(Parts::Settled), end) => {
                self.set_parts(if end == End::Swap { Parts::None } else { Parts::Settled });
                self.observe(frame);
                self.execute(frame)
            }
        }
    }

    /// Leaves what was handed over of the frame that goes on as it is.
    pub(crate) fn settle(&mut self) -> Result<(), RenderError> {
        let Some(parts @ Parts::Held(_)) = self.take_parts() else { return Ok(()) };
        let size = (self.target.size[0], self.target.size[1]);
        let mut rest = Frame { size, ..Frame::default() };
        self.settle_held(parts, &mut rest);
        self.execute(&rest)
    }

    /// Likewise; what is still to be done comes to the end of `next`.
    fn settle_held(&mut self, parts: Parts, next: &mut Frame) {
        if let Parts::Held(mut held) = parts {
            self.observe(&held.frame);
            let is_due = |operation: &mut Operation| matches!(operation, Operation::DropImage(_));
            next.operations.extend(held.frame.operations.extract_if(.., is_due));
        }
    }

    /// Executes a part of a frame and answers a question about the result.
    pub(crate) fn answer_part(
        &mut self,
        so_far: &mut Frame,
        request: &Request,
    ) -> Result<Reply, RenderError> {
        let wants_all = self.is_about_most(so_far, request);
        match self.take_parts() {
            None => return self.execute_and_answer(so_far, request),
            // Nothing was drawn since the last frame.
            Some(Parts::None) if so_far.operations.is_empty() => {}
            Some(Parts::None) if wants_all => {
                self.set_parts(Parts::Settled);
                self.execute_traced(so_far)?;
            }
            Some(Parts::Held(held)) if wants_all => {
                self.set_parts(Parts::Settled);
                self.execute_whole(*held, so_far)?;
            }
            Some(Parts::Settled) => {
                self.set_parts(Parts::Settled);
                self.observe(so_far);
                return self.execute_and_answer(so_far, request);
            }
            Some(parts) => self.hold(parts, so_far)?,
        }
        let size = (self.target.size[0], self.target.size[1]);
        self.execute_and_answer(&Frame { size, ..Frame::default() }, request)
    }

    /// Rasterizes a part, and keeps it to be executed again.
    fn hold(&mut self, parts: Parts, part: &mut Frame) -> Result<(), RenderError> {
        let before = match parts {
            Parts::Held(held) => Some(held),
            _ => None,
        };
        let words = part.words.len() + before.as_ref().map_or(0, |held| held.frame.words.len());
        if words > MOST_WORDS || !part.operations.iter().all(is_repeatable) {
            self.set_parts(Parts::Settled);
            if let Some(held) = &before {
                self.observe(&held.frame);
            }
            self.observe(part);
            return self.execute(part);
        }
        let mut held = match before {
            Some(held) => held,
            None => {
                self.resize(part)?;
                match self.keep_window() {
                    Err(error) if error.is_out_of_memory() => {
                        self.trace_no_more(&error);
                        return self.execute(part);
                    }
                    kept => kept?,
                }
                Box::new(Held { frame: Frame::default() })
            }
        };
        // Images are needed until the frame is complete.
        let dropped: Vec<_> = part
            .operations
            .extract_if(.., |operation| matches!(operation, Operation::DropImage(_)))
            .collect();
        let executed = self.execute(part);
        // What was counted is not counted again.
        part.operations
            .retain(|operation| !matches!(operation, Operation::BeginQuery(_) | Operation::EndQuery(_)));
        part.operations.extend(dropped);
        held.frame.append(part);
        self.set_parts(Parts::Held(held));
        executed
    }

    /// Executes all of a frame, of which only the last part is new, as if nothing of it had been executed.
    fn execute_whole(&mut self, mut held: Held, last: &mut Frame) -> Result<(), RenderError> {
        held.frame.append(last);
        self.restore_window()?;
        self.execute_traced(&mut held.frame)?;
        // Its memory is recycled in place of the part's.
        *last = held.frame;
        Ok(())
    }

    /// Keeps what the window shows.
    fn keep_window(&mut self) -> Result<(), RenderError> {
        let Some(tracer) = &mut self.tracer else { return Ok(()) };
        match tracer.before.take().filter(|before| before.size == self.target.size) {
            Some(mut before) => {
                before.copy_from(&self.gpu, &mut self.target)?;
                tracer.before = Some(before);
            }
            None => tracer.before = Some(self.target.resized(&self.gpu, self.target.size)?),
        }
        Ok(())
    }

    /// Puts the window back to what was kept.
    fn restore_window(&mut self) -> Result<(), RenderError> {
        if let Some(before) = self.tracer.as_mut().and_then(|tracer| tracer.before.as_mut()) {
            self.target.copy_from(&self.gpu, before)?;
        }
        Ok(())
    }

    /// What was handed over of the frame that is going on; none in `raster` mode. It is `None` from then on.
    fn take_parts(&mut self) -> Option<Parts> {
        self.tracer.as_mut().map(|tracer| std::mem::replace(&mut tracer.parts, Parts::None))
    }

    fn set_parts(&mut self, parts: Parts) {
        if let Some(tracer) = &mut self.tracer {
            tracer.parts = parts;
        }
    }

    fn observe(&mut self, frame: &Frame) {
        if let Some(tracer) = &mut self.tracer {
            tracer.recovery.observe(frame);
        }
    }

    /// Whether a question is about the colours of at least half of the window.
    fn is_about_most(&self, frame: &Frame, request: &Request) -> bool {
        let Request::Pixels { buffer: PixelBuffer::Color, rect } = request else { return false };
        let area = |width: u64, height: u64| width * height;
        let asked = area(rect.width.max(0) as u64, rect.height.max(0) as u64);
        2 * asked >= area(frame.size.0.into(), frame.size.1.into())
    }
}

/// Whether an operation can be executed twice, from the same window, with the same result.
fn is_repeatable(operation: &Operation) -> bool {
    !matches!(operation, Operation::Accumulate(..) | Operation::ClearAccumulation(_))
}

impl std::fmt::Debug for Parts {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::None => "None",
            Self::Held(_) => "Held",
            Self::Settled => "Settled",
        })
    }
}
