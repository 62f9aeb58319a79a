//! What the program's threads tell the render thread.

use std::sync::mpsc::SyncSender;
use std::time::Instant;

use afterglow_gl::backend::{End, Reply, Request};
use afterglow_gl::frame::Frame;

use crate::drawable::{Drawable, Surface};

/// A message; they are handled in order.
pub(crate) enum Message {
    /// There is a drawable from now on.
    Drawable { drawable: u64, surface: Surface },
    /// Nobody holds the drawable any more.
    DropDrawable { drawable: u64 },
    /// Nobody holds the share group any more.
    DropGroup { group: u64 },
    /// A frame, or a part of one. A complete one takes a place in its drawable's queue.
    Frame { group: u64, drawable: Drawable, frame: Frame, end: End, handed_over: Instant },
    /// The operations so far, and a question about the result.
    Ask { group: u64, drawable: Drawable, frame: Frame, request: Request, reply: SyncSender<Reply> },
    /// Show what is drawn.
    Present { drawable: Drawable },
    /// Wake up: the thread is to end.
    Stop,
}
