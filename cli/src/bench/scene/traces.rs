//! What understanding a trace's frames costs.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use afterglow_gl::frame::Frame;
use afterglow_scene::{Phase, Recovery};
use serde::Serialize;

use super::{add, quantile};
use crate::failure::Failure;
use crate::inspect::play::{self, Event, Judged, Phases, Visitor};

/// A trace's figures. The second half of its frames counts as steady: what it loads is loaded then.
#[derive(Debug, Serialize)]
pub struct Row {
    trace: String,
    frames: usize,
    /// Draws and vertices (as indices name them) of a steady frame, means.
    draws: f64,
    vertices: f64,
    /// Microseconds a frame, of all frames.
    median_us: f64,
    p95_us: f64,
    /// Steady: nanoseconds a vertex and a draw.
    ns_a_vertex: f64,
    ns_a_draw: f64,
    /// Steady, of playing the frames' calls into contexts and understanding them: the share of the latter, 0 to 1.
    share: f64,
    /// Steady, in units of copying the vertices and indices that the frames themselves hold.
    copies: f64,
    /// Steady, microseconds a frame by phase.
    phases_us: BTreeMap<&'static str, f64>,
}

/// Measures traces, and prints a table unless standard output is for JSON.
pub fn measure(paths: &[PathBuf], runs: u32, prints: bool) -> Result<Vec<Row>, Failure> {
    let mut rows = Vec::new();
    for path in files(paths)? {
        let row = row(&path, runs)?;
        add(&mut rows, row, prints, write_head, Row::write)?;
    }
    Ok(rows)
}

/// The traces among files and folders, each folder's by name.
fn files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let entries = std::fs::read_dir(path).map_err(|error| Failure::input(path, error))?;
        let within = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let is_trace = |file: &PathBuf| file.extension().is_some_and(|extension| extension == "trace");
        let mut within: Vec<PathBuf> = within.filter(is_trace).collect();
        within.sort();
        files.append(&mut within);
    }
    Ok(files)
}

/// What a frame took.
#[derive(Debug, Clone, Copy)]
struct Times {
    phases: Phases,
    /// Playing the calls, from the end of the frame before.
    playing: Duration,
    copying: Duration,
    draws: usize,
    vertices: u64,
}

impl Times {
    fn understanding(&self) -> f64 {
        self.phases.iter().sum::<Duration>().as_secs_f64()
    }

    /// Of two runs of the same frame.
    fn keep_least(&mut self, other: &Times) {
        for (least, time) in self.phases.iter_mut().zip(other.phases) {
            *least = time.min(*least);
        }
        self.playing = self.playing.min(other.playing);
        self.copying = self.copying.min(other.copying);
    }
}

fn row(path: &Path, runs: u32) -> Result<Row, Failure> {
    let mut least: Vec<Times> = Vec::new();
    for _ in 0..runs {
        let mut watch = Watch { ended: Instant::now(), frames: Vec::new() };
        play::play(path, u64::MAX, Recovery::new(), &mut watch)?;
        match least.is_empty() {
            true => least = watch.frames,
            false => least.iter_mut().zip(&watch.frames).for_each(|(least, times)| least.keep_least(times)),
        }
    }
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Row::of(name, &least))
}

struct Watch {
    ended: Instant,
    frames: Vec<Times>,
}

impl Visitor for Watch {
    fn frame(&mut self, _: u64, events: Vec<Event>, _: &Recovery) -> Result<(), Failure> {
        let playing = self.ended.elapsed();
        for event in events {
            let Event::Shown(judged) = event else { continue };
            let Judged { frame, time, phases, .. } = *judged;
            self.frames.push(Times {
                phases,
                playing: playing.saturating_sub(time),
                copying: copying(&frame),
                draws: frame.draws().count(),
                vertices: frame.draws().map(|(_, draw)| u64::from(draw.index_count)).sum(),
            });
        }
        self.ended = Instant::now();
        Ok(())
    }
}

/// How long it takes to copy what a frame holds of vertices and indices.
pub fn copying(frame: &Frame) -> Duration {
    let start = Instant::now();
    black_box((black_box(frame).words.clone(), black_box(frame).indices.clone()));
    start.elapsed()
}

impl Row {
    fn of(trace: String, frames: &[Times]) -> Row {
        let mut sorted: Vec<f64> = frames.iter().map(|times| 1e6 * times.understanding()).collect();
        sorted.sort_by(f64::total_cmp);
        let steady = &frames[frames.len() / 2..];
        let count = steady.len().max(1) as f64;
        let sum = |of: &dyn Fn(&Times) -> f64| steady.iter().map(of).sum::<f64>();
        let seconds = sum(&Times::understanding);
        let (draws, vertices) = (sum(&|times| times.draws as f64), sum(&|times| times.vertices as f64));
        let by_phase = |phase: Phase| 1e6 * sum(&|times| times.phases[phase as usize].as_secs_f64()) / count;
        Row {
            trace,
            frames: frames.len(),
            draws: draws / count,
            vertices: vertices / count,
            median_us: quantile(&sorted, 0.5),
            p95_us: quantile(&sorted, 0.95),
            ns_a_vertex: 1e9 * seconds / vertices.max(1.0),
            ns_a_draw: 1e9 * seconds / draws.max(1.0),
            share: seconds / (seconds + sum(&|times| times.playing.as_secs_f64())).max(f64::MIN_POSITIVE),
            copies: seconds / sum(&|times| times.copying.as_secs_f64()).max(f64::MIN_POSITIVE),
            phases_us: Phase::ALL.map(|phase| (phase.name(), by_phase(phase))).into(),
        }
    }

    fn write(&self, out: &mut dyn Write) -> std::io::Result<()> {
        write!(
            out,
            "{:<18} {:>6} {:>6.0} {:>8.0} {:>9.0} {:>9.0} {:>9.1} {:>7.0} {:>5.0} % {:>7.1} ",
            self.trace,
            self.frames,
            self.draws,
            self.vertices,
            self.median_us,
            self.p95_us,
            self.ns_a_vertex,
            self.ns_a_draw,
            100.0 * self.share,
            self.copies,
        )?;
        Phase::ALL.iter().try_for_each(|phase| write!(out, " {:>8.0}", self.phases_us[phase.name()]))?;
        writeln!(out)
    }
}

fn write_head(out: &mut dyn Write) -> std::io::Result<()> {
    writeln!(
        out,
        "share: of the time on the processor, playing the calls included; copies: in units of copying the vertices; \
         phases: us a frame"
    )?;
    write!(
        out,
        "{:<18} {:>6} {:>6} {:>8} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7} ",
        "trace",
        "frames",
        "draws",
        "vertices",
        "median us",
        "p95 us",
        "ns/vertex",
        "ns/draw",
        "share",
        "copies"
    )?;
    Phase::ALL.iter().try_for_each(|phase| write!(out, " {:>8}", phase.name()))?;
    writeln!(out)
}
