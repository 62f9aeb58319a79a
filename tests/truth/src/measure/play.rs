//! Plays a trace, and lets recovery understand its frames.

use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, Topology};
use afterglow_player::{DrawableSizes, PlayReport, Player, TraceSummary};
use afterglow_scene::{Recovery, Relighting, Replacing};
use afterglow_trace::TraceReader;
use anyhow::{Context, ensure};
use parking_lot::Mutex;

use super::Observed;
use super::stability::{Samples, sample};
use crate::client::WINDOW;

/// A frame as it was played.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Played {
    /// Triangles that were drawn.
    pub triangles: u64,
    /// What recovery said.
    pub observed: Observed,
    /// Where some of the vertices were.
    pub samples: Samples,
}

/// Understands frames in place of drawing them.
#[derive(Default)]
struct Watcher {
    recovery: Recovery,
    /// What was handed over of a frame that goes on.
    part: Played,
    frames: Arc<Mutex<Vec<Played>>>,
}

impl Watcher {
    fn watch(&mut self, mut frame: Frame) {
        let scene = self.recovery.understand(&mut frame);
        sample(&frame, self.part.triangles, &mut self.part.samples);
        let triangles = frame.draws().filter(|(_, draw)| draw.topology == Topology::Triangles);
        self.part.triangles += triangles.map(|(_, draw)| u64::from(draw.index_count / 3)).sum::<u64>();
        let observed = Observed::of(&scene);
        self.part.observed.camera = observed.camera.or(self.part.observed.camera);
        self.part.observed.lights.extend(observed.lights);
        self.part.observed.recovered.extend(observed.recovered);
        self.part.observed.relight = observed.relight.or(self.part.observed.relight);
        self.part.observed.runs.extend(observed.runs);
    }
}

impl Backend for Watcher {
    fn submit(&mut self, frame: Frame, end: End) {
        self.watch(frame);
        if end != End::Continued {
            self.frames.lock().push(std::mem::take(&mut self.part));
        }
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.watch(so_far);
        Reply::Unavailable
    }
}

/// Plays a trace to its end.
///
/// # Errors
/// Where a call cannot be played, or is an error of OpenGL.
pub fn play(trace: &[u8]) -> anyhow::Result<Vec<Played>> {
    play_as(trace, Relighting::Off)
}

/// The same; `relighting` says whether the sources of baked light are searched, which takes seconds.
///
/// # Errors
/// Where a call cannot be played, or is an error of OpenGL.
pub fn play_as(trace: &[u8], relighting: Relighting) -> anyhow::Result<Vec<Played>> {
    let reader = TraceReader::from_reader(Cursor::new(trace.to_vec()))?;
    let sizes = DrawableSizes::all(WINDOW.0 as u32, WINDOW.1 as u32);
    let (played, report) = play_all(reader, sizes, relighting);
    let skipped = [&report.unsupported, &report.malformed, &report.without_context];
    ensure!(skipped.iter().all(|calls| calls.is_empty()), "calls were not played: {skipped:?}");
    ensure!(report.errors.is_empty(), "OpenGL errors: {:?}", report.errors);
    ensure!(report.failure.is_none(), "{:?}", report.failure);
    Ok(played)
}

/// Plays a recorded trace to its end. Real programs make errors; they are played as they are.
///
/// # Errors
/// Where the file is no trace or is damaged.
pub fn play_file(path: &Path) -> anyhow::Result<Vec<Played>> {
    let named = || path.display().to_string();
    let sizes = TraceSummary::open(path).with_context(named)?.sizes();
    let (played, report) = play_all(TraceReader::open(path).with_context(named)?, sizes, Relighting::Off);
    ensure!(report.failure.is_none(), "{:?}", report.failure);
    Ok(played)
}

fn play_all(reader: TraceReader, sizes: DrawableSizes, relighting: Relighting) -> (Vec<Played>, PlayReport) {
    let frames = Arc::new(Mutex::new(Vec::new()));
    let shared = frames.clone();
    let factory = Box::new(move |_| {
        let recovery = Recovery::new().with_relighting(relighting, Replacing::WhereGood);
        Box::new(Watcher { recovery, frames: shared.clone(), ..Watcher::default() }) as Box<dyn Backend>
    });
    let mut player = Player::new(reader, sizes, factory);
    while player.next_frame().is_some() {}
    let report = player.report();
    drop(player);
    let played = std::mem::take(&mut *frames.lock());
    (played, report)
}
