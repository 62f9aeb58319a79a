//! Steadiness: what can be said of recovery on a program of which nothing is known, however long it is played.
//!
//! Nobody says here what is right. But a camera that jumps away and comes back was wrong; draws that have the same content in two
//! frames tell by their matrices what stands still, and the camera should agree with most of them; a surface that stays at its
//! place should stay the same object; and a class that comes and goes was wrong half of the time.

mod motion;
mod objects;
mod report;

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_player::{Player, TraceSummary};
use afterglow_scene::{Class, Recovery, Scene};
use afterglow_trace::TraceReader;
use anyhow::Context;
use parking_lot::Mutex;

use motion::{Journey, Seen, seen};
use objects::{Histories, Switches};
pub use report::write_steadiness;

/// Frames from one look at memory to the next.
const LOOK_INTERVAL: u32 = 500;

/// What was used at a frame.
#[derive(Debug, Clone, Copy)]
pub struct Use {
    /// The frame.
    pub frame: u32,
    /// Bytes that the process has in memory.
    pub resident: u64,
    /// Bytes of the world that is remembered.
    pub remembered: u64,
}

/// What was found of a trace.
#[derive(Debug, Default)]
pub struct Steadiness {
    frames: u32,
    /// Frames that draw something solid in perspective.
    solid: u32,
    /// Of these, frames without a camera: count and the first of them.
    blind: (u32, Vec<u32>),
    journey: Journey,
    switches: Switches,
    histories: Histories,
    /// Frames in which something is undecided, and what: reason, draws and the first frame.
    undecided: u32,
    reasons: std::collections::BTreeMap<&'static str, (u64, u32)>,
    /// Frames with which a world begins.
    epochs: Vec<u32>,
    epoch: u64,
    times: Vec<(Duration, u32)>,
    triangles: u64,
    uses: Vec<Use>,
}

impl Steadiness {
    fn add(&mut self, frame: &Frame, scene: &Scene, recovery: &Recovery, time: Duration) {
        let index = self.frames;
        self.frames += 1;
        self.times.push((time, index));
        self.triangles += scene.verdicts.iter().map(|v| u64::from(v.triangles)).sum::<u64>();
        if index.is_multiple_of(LOOK_INTERVAL) {
            let remembered = recovery.memory().bytes;
            self.uses.push(Use { frame: index, resident: resident(), remembered });
        }
        if scene.epoch != self.epoch {
            self.epoch = scene.epoch;
            self.epochs.push(index);
        }
        let seen: Vec<Seen> = seen(frame, scene, recovery);
        let is_solid = seen.iter().any(|seen| seen.is_solid);
        self.solid += u32::from(is_solid);
        if is_solid && scene.camera.is_none() {
            self.blind.0 += 1;
            self.blind.1.push(index);
        }
        self.journey.add(index, scene, &seen);
        self.switches.add(index, scene.epoch, &seen);
        self.histories.add(index, &scene.verdicts);
        let undecided = || scene.verdicts.iter().filter(|v| v.class == Class::Undecided);
        self.undecided += u32::from(undecided().next().is_some());
        for verdict in undecided() {
            self.reasons.entry(verdict.reason).or_insert((0, index)).0 += 1;
        }
    }
}

/// Bytes that this process has in memory; 0 where that is not told.
fn resident() -> u64 {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    text.split(' ').nth(1).and_then(|pages| pages.parse::<u64>().ok()).unwrap_or(0) * 4096
}

/// Understands frames in place of drawing them, of all contexts together.
#[derive(Default)]
struct Watcher {
    recovery: Recovery,
    begun: Option<Frame>,
    found: Steadiness,
}

impl Watcher {
    fn part(&mut self, mut part: Frame) {
        match &mut self.begun {
            Some(begun) => begun.append(&mut part),
            None => self.begun = Some(part),
        }
    }

    fn end(&mut self, end: End) {
        if end == End::Continued {
            return;
        }
        let Some(mut frame) = self.begun.take() else { return };
        if end == End::Over {
            return self.recovery.observe(&frame);
        }
        let start = Instant::now();
        let scene = self.recovery.understand(&mut frame);
        self.found.add(&frame, &scene, &self.recovery, start.elapsed());
    }
}

/// The watcher as a context sees it.
struct Seat(Arc<Mutex<Watcher>>);

impl Backend for Seat {
    fn submit(&mut self, frame: Frame, end: End) {
        let mut watcher = self.0.lock();
        watcher.part(frame);
        watcher.end(end);
    }

    fn answer(&mut self, so_far: Frame, request: Request) -> Reply {
        self.0.lock().part(so_far);
        match request {
            Request::Finish => Reply::Done,
            _ => Reply::Unavailable,
        }
    }
}

/// Watches a trace to its end, or to where it is damaged.
///
/// # Errors
/// Where the file is no trace.
pub fn watch(path: &Path) -> anyhow::Result<Steadiness> {
    let named = || path.display().to_string();
    let sizes = TraceSummary::open(path).with_context(named)?.sizes();
    let watcher = Arc::new(Mutex::new(Watcher::default()));
    let shared = watcher.clone();
    let factory = move |_| -> Box<dyn Backend> { Box::new(Seat(shared.clone())) };
    let mut player = Player::new(TraceReader::open(path).with_context(named)?, sizes, Box::new(factory));
    while player.next_frame().is_some() {}
    drop(player);
    let found = std::mem::take(&mut watcher.lock().found);
    Ok(found)
}
