//! A context: all state of OpenGL 1.x, and the frame that it is filling.

use std::sync::Arc;

use afterglow_api::constants::*;

use crate::arrays::ClientState;
use crate::attrib_stack::AttribStacks;
use crate::backend::{Backend, End, Reply, Request};
use crate::draw_arrays::RangeCache;
use crate::emit::{Dirty, Emitter};
use crate::frame::{Frame, Rect};
use crate::immediate::Immediate;
use crate::lists::ListBuilder;
use crate::matrices::Matrices;
use crate::pixel::PixelTransfer;
use crate::pixels::RenderMode;
use crate::query::ActiveQuery;
use crate::shared::SharedNames;
use crate::state::State;
use crate::texturing::Textures;

/// Parameters of a command that has scalar and vector, float and integer forms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Params<'a> {
    /// Float forms.
    Floats(&'a [f32]),
    /// Integer forms.
    Ints(&'a [i32]),
}

/// An OpenGL context. One thread calls it at a time.
pub struct Context {
    pub(crate) backend: Box<dyn Backend>,
    pub(crate) shared: SharedNames,
    pub(crate) error: u32,
    pub(crate) size: Option<(u32, u32)>,
    pub(crate) frame: Frame,
    /// The device that images are on.
    pub(crate) device: u64,
    pub(crate) emitter: Emitter,
    pub(crate) state: State,
    pub(crate) matrices: Matrices,
    pub(crate) textures: Textures,
    pub(crate) client: ClientState,
    pub(crate) stacks: AttribStacks,
    pub(crate) transfer: PixelTransfer,
    pub(crate) immediate: Immediate,
    pub(crate) list: Option<Box<ListBuilder>>,
    pub(crate) list_depth: u32,
    /// Lists that the command at hand may still execute.
    pub(crate) lists_left: u32,
    pub(crate) queries: ActiveQuery,
    pub(crate) mode: RenderMode,
    pub(crate) ranges: RangeCache,
    pub(crate) scratch: Scratch,
}

/// Memory that draws use again and again.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub words: Vec<u32>,
    pub indices: Vec<u32>,
    pub assembled: Vec<u32>,
}

impl Context {
    /// A context in its initial state that shares names with all others of the same `shared`.
    pub fn new(backend: Box<dyn Backend>, shared: SharedNames) -> Context {
        let textures = Textures::new(&shared);
        let device = backend.device();
        let mut context = Context {
            backend,
            shared,
            error: GL_NO_ERROR,
            size: None,
            frame: Frame { device, ..Frame::default() },
            device,
            emitter: Emitter::default(),
            state: State::default(),
            matrices: Matrices::default(),
            textures,
            client: ClientState::default(),
            stacks: AttribStacks::default(),
            transfer: PixelTransfer::default(),
            immediate: Immediate::default(),
            list: None,
            list_depth: 0,
            lists_left: 0,
            queries: ActiveQuery::default(),
            mode: RenderMode::default(),
            ranges: RangeCache::default(),
            scratch: Scratch::default(),
        };
        context.leave_images();
        context
    }

    /// The names that this context shares.
    pub fn shared_names(&self) -> SharedNames {
        Arc::clone(&self.shared)
    }

    /// Says how large the drawable is. The first call sets viewport and scissor to all of it.
    pub fn set_drawable(&mut self, width: u32, height: u32) {
        if self.size.is_none() {
            let rect = Rect { x: 0, y: 0, width: width as i32, height: height as i32 };
            self.state.viewport.rect = rect;
            self.state.scissor = rect;
            self.dirty(Dirty::VIEWPORT);
        }
        self.size = Some((width, height));
        self.frame.size = (width, height);
    }

    /// Size of the drawable, pixels.
    pub fn drawable(&self) -> (u32, u32) {
        self.size.unwrap_or((0, 0))
    }

    /// glXSwapBuffers: the frame is complete.
    pub fn swap_buffers(&mut self) {
        self.hand_over(End::Swap);
    }

    /// Hands over what has been recorded of a frame that goes on: before another context or drawable becomes current,
    /// or where others must see it. Whether there was anything. Between Begin and End, nothing is handed over.
    pub fn hand_over_so_far(&mut self) -> bool {
        let has_any = !self.in_begin() && !self.frame.operations.is_empty();
        if has_any {
            self.hand_over(End::Continued);
        }
        has_any
    }

    /// glGetError.
    pub fn get_error(&mut self) -> u32 {
        if self.in_begin() {
            // Specification 2.5: between Begin and End the result is undefined and no error is recorded.
            return GL_NO_ERROR;
        }
        std::mem::replace(&mut self.error, GL_NO_ERROR)
    }

    /// glFlush.
    pub fn flush(&mut self) {
        if self.in_begin() {
            self.record_error(GL_INVALID_OPERATION);
        }
    }

    /// glFinish: waits until everything that was handed over is done. A frame that goes on is not cut: programs that
    /// finish every frame can still be traced.
    pub fn finish(&mut self) {
        if self.in_begin() {
            return self.record_error(GL_INVALID_OPERATION);
        }
        self.backend.wait();
    }

    /// Records an error unless one is recorded already.
    pub fn record_error(&mut self, error: u32) {
        if self.error == GL_NO_ERROR {
            tracing::debug!(error = format_args!("{error:#06x}"), "GL error");
            self.error = error;
        }
    }

    /// Records the error of a failed step; whether it went well.
    pub(crate) fn check(&mut self, result: Result<(), u32>) -> bool {
        if let Err(error) = result {
            self.record_error(error);
        }
        result.is_ok()
    }

    #[inline]
    pub(crate) fn dirty(&mut self, what: Dirty) {
        self.emitter.dirty |= what;
    }

    #[inline]
    pub(crate) fn in_begin(&self) -> bool {
        self.immediate.mode.is_some()
    }

    /// Hands the frame over and starts the next.
    pub(crate) fn hand_over(&mut self, end: End) {
        let next = self.next_frame();
        let frame = std::mem::replace(&mut self.frame, next);
        self.backend.submit(frame, end);
        self.follow_device();
    }

    /// Asks the backend about the operations so far; the frame goes on.
    pub(crate) fn ask(&mut self, request: Request) -> Reply {
        let next = self.next_frame();
        let frame = std::mem::replace(&mut self.frame, next);
        let reply = self.backend.answer(frame, request);
        self.follow_device();
        reply
    }

    /// Takes note, as a frame begins, if images are on another device now.
    fn follow_device(&mut self) {
        let device = self.backend.device();
        self.frame.device = device;
        if device != self.device {
            self.device = device;
            self.leave_images();
        }
    }

    fn next_frame(&mut self) -> Frame {
        let mut next = self.backend.recycle();
        next.clear();
        next.size = self.drawable();
        self.emitter.start_frame();
        next
    }
}
