//! A trace played into scene recovery, without a device.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_player::{Player, TraceSummary};
use afterglow_scene::{Phase, Recovery, Scene};
use afterglow_trace::TraceReader;
use parking_lot::Mutex;

use crate::failure::{self, Failure};

/// Words of vertices that parts of a frame are gathered up to. A program that never shows a frame does not fill memory.
const MOST_WORDS: usize = 1 << 27;

/// A frame that a program showed.
pub struct Judged {
    /// All of it, its images' operations included.
    pub frame: Frame,
    /// What it is understood as.
    pub scene: Scene,
    /// How long that took.
    pub time: Duration,
    /// How long each phase took, in the order of [`Phase::ALL`].
    pub phases: Phases,
}

/// Durations by phase, in the order of [`Phase::ALL`].
pub type Phases = [Duration; Phase::ALL.len()];

/// Understands a frame, and times the phases.
pub fn understand(recovery: &mut Recovery, frame: &mut Frame) -> (Scene, Phases) {
    let (mut phases, mut last) = (Phases::default(), Instant::now());
    let scene = recovery.understand_watched(frame, &mut |phase| {
        let now = Instant::now();
        phases[phase as usize] += now - std::mem::replace(&mut last, now);
    });
    (scene, phases)
}

/// What contexts handed over, in order.
pub enum Event {
    /// A frame that was shown, understood.
    Shown(Box<Judged>),
    /// Part of a frame that never was: only what it makes of images matters.
    Part(Box<Frame>),
}

/// Sees a trace frame by frame.
pub trait Visitor {
    /// Takes a frame of the trace, and what came before it since the last one; `recovery` knows its images.
    fn frame(&mut self, index: u64, events: Vec<Event>, recovery: &Recovery) -> Result<(), Failure>;
}

/// Plays a trace up to frame `end` (exclusive). All contexts' frames are understood together, as one renderer does.
///
/// # Errors
/// If the trace is unreadable or damaged (after what can be played of it), or the visitor fails.
pub fn play(path: &Path, end: u64, recovery: Recovery, visitor: &mut dyn Visitor) -> Result<u64, Failure> {
    let damaged = |error| Failure::input(path, error);
    let summary = TraceSummary::open(path).map_err(damaged)?;
    let judge = Arc::new(Mutex::new(Judge { recovery, begun: None, events: Vec::new() }));
    let shared = judge.clone();
    let factory = move |_| -> Box<dyn Backend> { Box::new(Seat(shared.clone())) };
    let mut player =
        Player::new(TraceReader::open(path).map_err(damaged)?, summary.sizes(), Box::new(factory));
    let mut frames = 0;
    while let Some(shown) = player.next_frame() {
        let mut judge = judge.lock();
        let events = std::mem::take(&mut judge.events);
        visitor.frame(shown.frame.into(), events, &judge.recovery)?;
        frames = u64::from(shown.frame) + 1;
        if frames >= end {
            break;
        }
    }
    if let Some(failure) = &summary.failure {
        return Err(Failure::input(path, format!("{failure}; what comes before was played")));
    }
    failure::trace_end(path, summary.end)?;
    Ok(frames)
}

/// Understands the frames of all contexts.
struct Judge {
    recovery: Recovery,
    /// What was handed over of the frame that goes on.
    begun: Option<Frame>,
    events: Vec<Event>,
}

impl Judge {
    fn part(&mut self, mut part: Frame) {
        match &mut self.begun {
            Some(begun) if begun.words.len() + part.words.len() < MOST_WORDS => begun.append(&mut part),
            begun => {
                if let Some(full) = begun.replace(part) {
                    self.unseen(full);
                }
            }
        }
    }

    fn unseen(&mut self, frame: Frame) {
        self.recovery.observe(&frame);
        self.events.push(Event::Part(Box::new(frame)));
    }

    fn shown(&mut self) {
        let Some(mut frame) = self.begun.take() else { return };
        let (scene, phases) = understand(&mut self.recovery, &mut frame);
        let time = phases.iter().sum();
        self.events.push(Event::Shown(Box::new(Judged { frame, scene, time, phases })));
    }
}

/// The judge as a context sees it.
struct Seat(Arc<Mutex<Judge>>);

impl Backend for Seat {
    fn submit(&mut self, frame: Frame, end: End) {
        let mut judge = self.0.lock();
        judge.part(frame);
        match end {
            End::Swap => judge.shown(),
            End::Continued => {}
            // What is drawn over a picture is no scene of its own.
            End::Over => {
                if let Some(over) = judge.begun.take() {
                    judge.unseen(over);
                }
            }
        }
    }

    fn answer(&mut self, so_far: Frame, request: Request) -> Reply {
        self.0.lock().part(so_far);
        match request {
            Request::Finish => Reply::Done,
            _ => Reply::Unavailable,
        }
    }
}
