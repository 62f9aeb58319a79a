//! One renderer that all contexts of a trace draw with.

use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_gpu::{DeviceInfo, Gpu};
use afterglow_player::BackendFactory;
use afterglow_render::{RenderOptions, Renderer, Scale};
use parking_lot::Mutex;

use super::Arguments;
use super::report::Finished;
use crate::failure::Failure;
use crate::options::Size;

/// `I:X,Y,Z`: which, and how far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Which light or draw.
    pub index: u32,
    /// World units.
    pub offset: [f32; 3],
}

impl FromStr for Move {
    type Err = String;

    fn from_str(text: &str) -> Result<Move, String> {
        let parse = || {
            let (index, offset) = text.split_once(':')?;
            let offset: Vec<f32> = offset.split(',').map(|v| v.parse().ok()).collect::<Option<_>>()?;
            let offset: [f32; 3] = offset.try_into().ok()?;
            let is_finite = offset.iter().all(|along| along.is_finite());
            is_finite.then_some(Move { index: index.parse().ok()?, offset })
        };
        parse().ok_or_else(|| format!("'{text}' is not INDEX:X,Y,Z"))
    }
}

/// A device, and a renderer on it.
pub struct Session {
    gpu: Gpu,
    renderer: Arc<Mutex<Renderer>>,
    lit: Arc<AtomicBool>,
    size: Option<Size>,
}

/// The renderer as a context sees it.
struct Shared {
    renderer: Arc<Mutex<Renderer>>,
    lit: Arc<AtomicBool>,
    /// Of the pictures, if it is not the program's own.
    size: Option<Size>,
}

impl Shared {
    /// From the program's window to the picture.
    fn scale(&self, frame: &Frame) -> Scale {
        Scale { from: frame.size, to: self.size.map_or(frame.size, |Size(width, height)| (width, height)) }
    }
}

impl Backend for Shared {
    fn submit(&mut self, mut frame: Frame, end: End) {
        let is_lit = self.lit.load(Ordering::Relaxed);
        self.scale(&frame).frame(&mut frame);
        match is_lit {
            true => self.renderer.lock().submit(frame, end),
            false => self.renderer.lock().submit_unseen(frame, end),
        }
    }

    fn answer(&mut self, mut so_far: Frame, request: Request) -> Reply {
        let scale = self.scale(&so_far);
        scale.frame(&mut so_far);
        let reply = self.renderer.lock().answer(so_far, scale.request(&request));
        scale.reply(&request, reply)
    }

    fn recycle(&mut self) -> Frame {
        self.renderer.lock().recycle()
    }
}

impl Session {
    /// Opens the device.
    pub fn new(arguments: &Arguments) -> Result<Session, Failure> {
        let gpu = Gpu::new(&arguments.device.gpu_options())?;
        let mut options = RenderOptions::default();
        options.timing = arguments.wants_timing();
        let mut renderer = Renderer::new(&gpu, &options).map_err(failed)?;
        let mode = arguments.mode.of_renderer();
        renderer.set_mode(mode, &arguments.pathtrace_options()?).map_err(failed)?;
        let lit = Arc::new(AtomicBool::new(true));
        Ok(Session { renderer: Arc::new(Mutex::new(renderer)), gpu, lit, size: arguments.size })
    }

    /// The device.
    pub fn device(&self) -> DeviceInfo {
        self.gpu.info().clone()
    }

    /// Backends for contexts: they all draw with this session's renderer.
    pub fn factory(&self) -> BackendFactory {
        let (renderer, lit, size) = (self.renderer.clone(), self.lit.clone(), self.size);
        Box::new(move |_| Box::new(Shared { renderer: renderer.clone(), lit: lit.clone(), size }))
    }

    /// Whether the frame to come is drawn, or only played for the state it leaves.
    pub fn set_lit(&self, lit: bool) {
        self.lit.store(lit, Ordering::Relaxed);
    }

    /// Waits for the frame.
    pub fn finish_frame(&self) -> Result<Finished, Failure> {
        let mut renderer = self.renderer.lock();
        if let Some(error) = renderer.failure() {
            return Err(failed(error));
        }
        // The report first: reading back is a submission of its own.
        let rendered = renderer.frame_report().map_err(failed)?.clone();
        let pixels = renderer.read_color().map_err(failed)?;
        let [width, height] = renderer.size();
        Ok(Finished { size: (width, height), hash: xxhash_rust::xxh3::xxh3_64(&pixels), pixels, rendered })
    }

    /// Messages of the validation layer so far.
    pub fn validation_messages(&self) -> Vec<String> {
        self.gpu.validation_messages()
    }
}

fn failed(error: impl ToString) -> Failure {
    Failure::Check(error.to_string())
}
