//! A backend that keeps the frames it is handed.

use std::sync::{Arc, Mutex};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_gl::{Context, SharedNames};

#[derive(Clone, Default)]
pub struct Recorder(pub Arc<Mutex<Vec<(Frame, End)>>>);

impl Backend for Recorder {
    fn submit(&mut self, frame: Frame, end: End) {
        self.0.lock().unwrap().push((frame, end));
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.submit(so_far, End::Continued);
        Reply::Unavailable
    }
}

/// A context of 64 by 48 pixels, and what it hands over.
pub fn context() -> (Context, Recorder) {
    let recorder = Recorder::default();
    let mut context = Context::new(Box::new(recorder.clone()), SharedNames::default());
    context.set_drawable(64, 48);
    (context, recorder)
}
