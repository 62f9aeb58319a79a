//! Plays a trace without a device and prints what each frame is understood as, or every draw of one frame:
//! `cargo run --release -p afterglow-scene --example classify FILE.trace [FRAME]`.

use std::collections::BTreeMap;
use std::error::Error;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_player::{Player, TraceSummary};
use afterglow_scene::{Recovery, Scene, Verdict};
use afterglow_trace::TraceReader;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("which trace?")?;
    let wanted = arguments.next().map(|frame| frame.parse()).transpose()?;
    let report = Arc::new(Mutex::new(Report { wanted, ..Report::default() }));
    let shared = report.clone();
    let factory = move |_| -> Box<dyn Backend> {
        Box::new(Understanding { recovery: Recovery::new(), report: shared.clone() })
    };
    let sizes = TraceSummary::open(&path)?.sizes();
    let mut player = Player::new(TraceReader::open(&path)?, sizes, Box::new(factory));
    while player.next_frame().is_some() {}
    report.lock().unwrap_or_else(PoisonError::into_inner).print();
    Ok(())
}

/// Understands every frame that is shown.
struct Understanding {
    recovery: Recovery,
    report: Arc<Mutex<Report>>,
}

impl Backend for Understanding {
    fn submit(&mut self, mut frame: Frame, end: End) {
        let mut report = self.report.lock().unwrap_or_else(PoisonError::into_inner);
        if end == End::Continued {
            report.continued += 1;
            return self.recovery.observe(&frame);
        }
        let start = Instant::now();
        let scene = self.recovery.understand(&mut frame);
        report.times.push(start.elapsed());
        report.add(&frame, scene);
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.recovery.observe(&so_far);
        Reply::Unavailable
    }
}

/// Sums over all frames.
#[derive(Default)]
struct Report {
    wanted: Option<u32>,
    frames: u32,
    continued: u32,
    with_camera: u32,
    baked: u32,
    times: Vec<Duration>,
    by_reason: BTreeMap<(String, &'static str), Sum>,
    last: Scene,
}

#[derive(Default)]
struct Sum {
    triangles: u64,
    draws: u64,
    baked: u64,
}

impl Report {
    fn add(&mut self, frame: &Frame, scene: Scene) {
        for verdict in &scene.verdicts {
            let sum = self.by_reason.entry((format!("{:?}", verdict.class), verdict.reason)).or_default();
            sum.triangles += u64::from(verdict.triangles);
            sum.draws += 1;
            sum.baked += if verdict.baked { u64::from(verdict.triangles) } else { 0 };
        }
        if std::env::var_os("TIMELINE").is_some() {
            let eye = scene.camera.map(|c| c.view.inverse().w_axis.truncate());
            eprintln!(
                "{} {:?} {:?}",
                self.frames,
                eye,
                scene.triangles().named().iter().filter(|n| n.1 > 0).collect::<Vec<_>>()
            );
        }
        if self.wanted == Some(self.frames) {
            print_draws(frame, &scene);
        }
        self.with_camera += u32::from(scene.camera.is_some());
        self.baked += u32::from(scene.baked);
        self.frames += 1;
        self.last = scene;
    }

    fn print(&self) {
        let frames = f64::from(self.frames.max(1));
        let mut times = self.times.clone();
        times.sort();
        println!(
            "{} frames ({} with a camera, {} baked), {} handed over early, median {:.3} ms a frame",
            self.frames,
            self.with_camera,
            self.baked,
            self.continued,
            times.get(times.len() / 2).map_or(0.0, |t| t.as_secs_f64() * 1e3)
        );
        println!("{:>12} {:>9}  of them baked   (means a frame)", "triangles", "draws");
        for ((class, reason), sum) in &self.by_reason {
            let [triangles, draws, baked] = [sum.triangles, sum.draws, sum.baked].map(|n| n as f64 / frames);
            println!("{triangles:12.1} {draws:9.1} {baked:12.1}  {class}: {reason}");
        }
        let scene = &self.last;
        println!("last frame: sky {:.3}, ambient {:.3}", scene.sky, scene.ambient);
        for light in &scene.lights {
            println!("  {light:?}");
        }
        for (name, triangles) in scene.triangles().named().iter().filter(|(_, n)| *n > 0) {
            print!("{name} {triangles}  ");
        }
        println!();
    }
}

fn print_draws(frame: &Frame, scene: &Scene) {
    if let Some(camera) = scene.camera {
        println!("view {:.4}\nprojection {:.4}", camera.view, camera.projection);
    }
    for ((_, draw), verdict) in frame.draws().zip(&scene.verdicts) {
        let Verdict { operation, class, reason, object, model, previous: _, baked, triangles, base } =
            verdict;
        let fixed = &frame.fixed[draw.fixed as usize];
        let raster = fixed.raster;
        let units = fixed.words.units.iter().filter(|unit| unit.target() != 0).count();
        println!(
            "{operation:5} {class:?} {object:016x} ({reason}) {triangles} triangles, units {units}, lit {}, baked {baked}, base {base:?}, \
             depth {:?}, blend {:?}, alpha {}, viewport {:?}, model at {:.3}",
            fixed.words.global.lighting(),
            raster.depth.map(|d| (d.compare, d.write)),
            raster.blend.map(|b| b.rgb),
            fixed.words.global.alpha_func(),
            frame.viewports[draw.viewport as usize].rect,
            model.w_axis.truncate(),
        );
    }
}
