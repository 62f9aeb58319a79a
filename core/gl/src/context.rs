//! A context: all state of OpenGL 1.x, and the frame that it is filling.

use std::sync::Arc;

use afterglow_api::constants::*;

use crate::arrays::ClientState;
use crate::attrib_stack::AttribStacks;
use crate::backend::{Backend, End, Reply, Request};
use crate::drawable::Output;
use crate::emit::Emitter;
use crate::frame::Frame;
use crate::immediate::Immediate;
use crate::lists::ListBuilder;
use crate::matrices::Matrices;
use crate::pixel::PixelTransfer;
use crate::pixels::RenderMode;
use crate::query::ActiveQuery;
use crate::range_cache::RangeCache;
use crate::scene_hints::Said;
use crate::shared::SharedNames;
use crate::state::State;
use crate::tables::{Dirty, Tables};
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
    pub(crate) output: Output,
    pub(crate) frame: Frame,
    /// The device that images are on.
    pub(crate) device: u64,
    pub(crate) tables: Tables,
    pub(crate) emitter: Emitter,
    pub(crate) state: State,
    pub(crate) said: Said,
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
            output: Output::default(),
            frame: Frame { device, ..Frame::default() },
            device,
            tables: Tables::default(),
            emitter: Emitter::default(),
            state: State::default(),
            said: Said::default(),
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

    /// glGetError.
    pub fn get_error(&mut self) -> u32 {
        // Not among the commands that are allowed there (2.6.3); the error is for after glEnd.
        if self.refuses_in_begin() {
            return GL_NO_ERROR;
        }
        self.take_error()
    }

    /// The error that is recorded, for a caller that is not the program: also between Begin and End.
    pub fn take_error(&mut self) -> u32 {
        std::mem::replace(&mut self.error, GL_NO_ERROR)
    }

    /// glFlush.
    pub fn flush(&mut self) {
        self.refuses_in_begin();
    }

    /// glFinish: waits until everything that was handed over is done. A frame that goes on is not cut: programs that
    /// finish every frame can still be traced.
    pub fn finish(&mut self) {
        if self.refuses_in_begin() {
            return;
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
        self.tables.dirty |= what;
    }

    /// Whether a command that is not allowed between Begin and End comes there; an error if so.
    pub(crate) fn refuses_in_begin(&mut self) -> bool {
        let refuses = self.in_begin();
        if refuses {
            self.record_error(GL_INVALID_OPERATION);
        }
        refuses
    }

    #[inline]
    pub(crate) fn in_begin(&self) -> bool {
        self.immediate.mode.is_some()
    }

    /// Hands the frame over and starts the next.
    pub(crate) fn hand_over(&mut self, end: End) {
        self.output.note(&self.frame, end);
        let frame = self.take_frame();
        self.backend.submit(frame, end);
        if end != End::Continued {
            self.ranges.next_frame();
        }
        self.follow_device();
    }

    /// Asks the backend about the operations so far; the frame goes on.
    pub(crate) fn ask(&mut self, request: Request) -> Reply {
        self.output.note(&self.frame, End::Continued);
        let frame = self.take_frame();
        let reply = self.backend.answer(frame, request);
        self.follow_device();
        reply
    }

    /// Takes note, as a frame begins, if images are on another device now.
    pub(crate) fn follow_device(&mut self) {
        let device = self.backend.device();
        self.frame.device = device;
        if device != self.device {
            self.device = device;
            self.leave_images();
        }
    }

    /// What has been recorded; the next frame begins.
    pub(crate) fn take_frame(&mut self) -> Frame {
        let mut next = self.backend.recycle();
        next.clear();
        next.size = self.drawable();
        self.tables.start_frame();
        self.emitter.start_frame();
        std::mem::replace(&mut self.frame, next)
    }
}
