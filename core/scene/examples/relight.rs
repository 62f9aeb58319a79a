//! Plays a trace without a device and prints what light sources its baked light is found to come from:
//! `cargo run --release -p afterglow-scene --example relight FILE.trace`.

use std::error::Error;
use std::time::{Duration, Instant};

use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::Frame;
use afterglow_player::{Player, TraceSummary};
use afterglow_scene::{Recovery, Relight, Relighting, Replacing, Scene};
use afterglow_trace::TraceReader;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which trace?")?;
    let factory = move |_| -> Box<dyn Backend> {
        let recovery = Recovery::new().with_relighting(Relighting::AtOnce, Replacing::WhereGood);
        Box::new(Understanding { recovery, frames: 0, last: None })
    };
    let sizes = TraceSummary::open(&path)?.sizes();
    let mut player = Player::new(TraceReader::open(&path)?, sizes, Box::new(factory));
    while player.next_frame().is_some() {}
    Ok(())
}

/// Understands every frame that is shown.
struct Understanding {
    recovery: Recovery,
    frames: u32,
    last: Option<Relight>,
}

impl Understanding {
    /// Prints what is new.
    fn print(&mut self, scene: &Scene, took: Duration) {
        if scene.relight == self.last {
            return;
        }
        self.last = scene.relight;
        println!("frame {}: {:.0} ms, {:?}", self.frames, took.as_secs_f64() * 1e3, scene.relight);
        println!("  ambient {:.3}", scene.ambient);
        for light in &scene.lights {
            println!("  {:?} {:.3}", light.shape, light.color);
        }
    }
}

impl Backend for Understanding {
    fn submit(&mut self, mut frame: Frame, end: End) {
        if end == End::Continued {
            return self.recovery.observe(&frame);
        }
        let start = Instant::now();
        let scene = self.recovery.understand(&mut frame);
        self.print(&scene, start.elapsed());
        self.frames += 1;
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.recovery.observe(&so_far);
        Reply::Unavailable
    }
}
