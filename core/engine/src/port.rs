//! The backend of a context: frames go to the drawable that is current.

use std::sync::Arc;
use std::sync::mpsc;
use std::time::Instant;

use afterglow_gl::SharedNames;
use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, PixelBuffer, Rect};
use parking_lot::Mutex;

use crate::drawable::Drawable;
use crate::flushed::Flushed;
use crate::message::Message;
use crate::thread::Engine;

/// Contexts that share names, and with them images on the device.
#[derive(Clone)]
pub struct ShareGroup {
    shared: Arc<GroupShared>,
}

struct GroupShared {
    id: u64,
    engine: Engine,
    names: SharedNames,
}

impl ShareGroup {
    pub(crate) fn new(engine: Engine, id: u64) -> Self {
        Self { shared: Arc::new(GroupShared { id, engine, names: SharedNames::default() }) }
    }

    /// The names that its contexts share.
    pub fn names(&self) -> SharedNames {
        self.shared.names.clone()
    }
}

impl Drop for GroupShared {
    fn drop(&mut self) {
        self.engine.send(Message::DropGroup { group: self.id });
    }
}

/// Where a context's frames go. A clone is the same port: one is the context's backend, the other stays with the
/// window system, which says what is current.
#[derive(Clone)]
pub struct Port {
    id: u64,
    group: ShareGroup,
    bound: Arc<Mutex<Bound>>,
}

#[derive(Default)]
struct Bound {
    draw: Option<Drawable>,
    read: Option<Drawable>,
}

impl Port {
    /// A port for one context of a group, bound to nothing.
    pub fn new(group: &ShareGroup) -> Self {
        Self { id: group.shared.engine.next_id(), group: group.clone(), bound: Arc::default() }
    }

    /// Says what the context draws to and reads from. What has been recorded must have been handed over.
    pub fn bind(&self, draw: Option<Drawable>, read: Option<Drawable>) {
        if let Some(flushed) = self.engine().flushed().and_then(|frames| frames.take(self.id)) {
            self.send_part(flushed);
        }
        *self.bound.lock() = Bound { draw, read };
    }

    /// Whether pixels are read from something else than is drawn to.
    pub fn reads_elsewhere(&self) -> bool {
        self.other_read().is_some()
    }

    /// The colours of what is drawn to: RGBA, rows from the lowest upward. What has been recorded must have been handed
    /// over. Nothing without a device.
    pub fn colors(&mut self) -> Option<Vec<u8>> {
        let drawable = self.draw()?;
        let (width, height) = drawable.size();
        let so_far = self.joined(Frame { size: (width, height), ..Frame::default() });
        let rect = Rect { x: 0, y: 0, width: width as i32, height: height as i32 };
        match self.ask(drawable, so_far, Request::Pixels { buffer: PixelBuffer::Color, rect }) {
            Reply::Color(colors) => Some(colors),
            _ => None,
        }
    }

    fn engine(&self) -> &Engine {
        &self.group.shared.engine
    }

    fn draw(&self) -> Option<Drawable> {
        self.bound.lock().draw.clone()
    }

    /// The drawable that pixels are read from, if it is not the one that is drawn to.
    fn other_read(&self) -> Option<Drawable> {
        let bound = self.bound.lock();
        let (draw, read) = (bound.draw.as_ref()?, bound.read.as_ref()?);
        (draw.shared.id != read.shared.id).then(|| read.clone())
    }

    /// A frame without operations.
    fn nothing_drawn(&self, drawable: &Drawable) -> Frame {
        Frame { size: drawable.size(), device: self.device(), ..Frame::default() }
    }

    fn ask(&self, drawable: Drawable, frame: Frame, request: Request) -> Reply {
        self.send_others(&drawable);
        drawable.note_operations(&frame, End::Continued);
        let (reply, answer) = mpsc::sync_channel(1);
        self.engine().send(Message::Ask { group: self.group.shared.id, drawable, frame, request, reply });
        answer.recv().unwrap_or(Reply::Unavailable)
    }

    /// A frame with what was flushed of it before.
    fn joined(&self, mut frame: Frame) -> Frame {
        match self.engine().flushed().and_then(|frames| frames.take(self.id)) {
            Some(mut flushed) => {
                flushed.frame.append(&mut frame);
                flushed.frame
            }
            None => frame,
        }
    }

    /// Sends what other contexts flushed that comes before anything more that happens to this drawable.
    fn send_others(&self, drawable: &Drawable) {
        if let Some(frames) = self.engine().flushed() {
            frames.send_others(self.id, self.group.shared.id, drawable, |flushed| self.send_part(flushed));
        }
    }

    fn send_part(&self, flushed: Flushed) {
        let Flushed { group, drawable, frame, .. } = flushed;
        let end = End::Continued;
        drawable.note_operations(&frame, end);
        drawable.shared.queue_of(end).enter_full();
        self.engine().send(Message::Frame { group, drawable, frame, end, handed_over: Instant::now() });
    }
}

impl Backend for Port {
    fn submit(&mut self, frame: Frame, end: End) {
        let Some(drawable) = self.draw() else { return };
        self.send_others(&drawable);
        let frame = self.joined(frame);
        drawable.note_operations(&frame, end);
        drawable.shared.queue_of(end).enter(|| self.engine().is_alive());
        let (group, handed_over) = (self.group.shared.id, Instant::now());
        self.engine().send(Message::Frame { group, drawable, frame, end, handed_over });
    }

    fn answer(&mut self, so_far: Frame, request: Request) -> Reply {
        let Some(drawable) = self.draw() else { return Reply::Unavailable };
        let so_far = self.joined(so_far);
        match (self.other_read(), request) {
            (Some(read), Request::Pixels { .. }) => {
                self.ask(drawable, so_far, Request::Finish);
                let frame = self.nothing_drawn(&read);
                self.ask(read, frame, request)
            }
            _ => self.ask(drawable, so_far, request),
        }
    }

    fn flush(&mut self, frame: Frame) {
        let (Some(drawable), Some(frames)) = (self.draw(), self.engine().flushed()) else { return };
        let flushed = Flushed { port: self.id, group: self.group.shared.id, drawable, frame };
        if let Some(too_much) = frames.keep(flushed) {
            self.send_others(&too_much.drawable);
            self.send_part(too_much);
        }
    }

    fn wait(&mut self) {
        if let Some(drawable) = self.draw() {
            let frame = self.nothing_drawn(&drawable);
            self.ask(drawable, frame, Request::Finish);
        }
    }

    fn recycle(&mut self) -> Frame {
        self.engine().recycled()
    }

    fn device(&self) -> u64 {
        self.engine().device_number()
    }
}
