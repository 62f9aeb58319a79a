//! Plays a trace without a device and prints what the memory of the undrawn world costs and holds:
//! `cargo run --release -p afterglow-scene --example memory FILE.trace [EVERY]`. With `EVERY`, also a line every so
//! many frames.

use std::error::Error;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_player::{Player, TraceSummary};
use afterglow_scene::{Camera, Class, Recovery};
use afterglow_trace::TraceReader;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("which trace?")?;
    let every = arguments.next().map(|every| every.parse()).transpose()?;
    let report = Arc::new(Mutex::new(Report { every, ..Report::default() }));
    let shared = report.clone();
    let factory = move |_| -> Box<dyn Backend> {
        let mut without = Recovery::new();
        without.set_memory(0);
        Box::new(Understanding { with: Recovery::new(), without, camera: None, report: shared.clone() })
    };
    let sizes = TraceSummary::open(&path)?.sizes();
    let mut player = Player::new(TraceReader::open(&path)?, sizes, Box::new(factory));
    while player.next_frame().is_some() {}
    report.lock().unwrap_or_else(PoisonError::into_inner).print();
    Ok(())
}

/// Understands every frame that is shown, with a memory and without.
struct Understanding {
    with: Recovery,
    without: Recovery,
    camera: Option<Camera>,
    report: Arc<Mutex<Report>>,
}

impl Backend for Understanding {
    fn submit(&mut self, mut frame: Frame, end: End) {
        let mut report = self.report.lock().unwrap_or_else(PoisonError::into_inner);
        if end == End::Continued {
            self.without.observe(&frame);
            return self.with.observe(&frame);
        }
        self.without.understand(&mut frame);
        let start = Instant::now();
        self.without.understand(&mut frame);
        let without = start.elapsed();
        let start = Instant::now();
        let scene = self.with.understand(&mut frame);
        let memory = start.elapsed().saturating_sub(without);
        report.frames += 1;
        if scene.camera.is_none() {
            return;
        }
        let is_static = |verdict: &&afterglow_scene::Verdict| verdict.class == Class::Static;
        let triangles: u32 = scene.verdicts.iter().filter(is_static).map(|verdict| verdict.triangles).sum();
        let unseen: u32 = scene.unseen.iter().map(|unseen| unseen.passes[0].index_count / 3).sum();
        let frame = Figures { triangles, memory, unseen, parts: scene.unseen.len() };
        match scene.camera == self.camera {
            true => report.standing.push(frame),
            false => report.moving.push(frame),
        }
        self.camera = scene.camera;
        if report.every.is_some_and(|every| report.frames.is_multiple_of(every)) {
            println!("frame {}: {frame:?}, {:?}", report.frames, self.with.memory());
        }
        report.counts = self.with.memory();
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.without.observe(&so_far);
        self.with.observe(&so_far);
        Reply::Unavailable
    }
}

#[derive(Default)]
struct Report {
    every: Option<u32>,
    frames: u32,
    standing: Vec<Figures>,
    moving: Vec<Figures>,
    counts: afterglow_scene::MemoryCounts,
}

/// Of a frame.
#[derive(Debug, Clone, Copy)]
struct Figures {
    /// Static ones that were drawn.
    triangles: u32,
    memory: Duration,
    unseen: u32,
    parts: usize,
}

impl Report {
    fn print(&self) {
        println!("{} frames; at the end {:?}", self.frames, self.counts);
        for (name, figures) in [("standing", &self.standing), ("moving", &self.moving)] {
            let mut sorted: Vec<f64> = figures.iter().map(|f| f.memory.as_secs_f64() * 1e3).collect();
            sorted.sort_by(f64::total_cmp);
            let at = |share: f64| sorted.get((sorted.len() as f64 * share) as usize).copied().unwrap_or(0.0);
            let sum = |of: fn(&Figures) -> f64| figures.iter().map(of).sum::<f64>();
            let count = figures.len().max(1) as f64;
            println!(
                "{name:>8}: {} frames, {:.0} static triangles, {:.0} unseen in {:.0} parts; median {:.3} ms, \
                 99 % {:.3} ms, worst {:.3} ms, {:.1} ns a triangle",
                figures.len(),
                sum(|f| f.triangles.into()) / count,
                sum(|f| f.unseen.into()) / count,
                sum(|f| f.parts as f64) / count,
                at(0.5),
                at(0.99),
                sorted.last().copied().unwrap_or(0.0),
                1e9 * sum(|f| f.memory.as_secs_f64()) / sum(|f| f.triangles.into()).max(1.0),
            );
        }
    }
}
