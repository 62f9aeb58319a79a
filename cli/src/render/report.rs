//! What rendering took, for people and as JSON.

use std::io::{self, Write};
use std::time::Duration;

use afterglow_gpu::DeviceInfo;
use serde::Serialize;

use super::Arguments;
use super::painter::Counts;

/// Everything that `render --json` writes.
#[derive(Debug, Serialize)]
pub struct Report {
    mode: &'static str,
    target: &'static str,
    seed: u32,
    /// Width and height, pixels.
    size: [u32; 2],
    /// Frames that were rendered.
    frames: u64,
    /// Samples a pixel of the last picture.
    samples: u32,
    /// Of all frames, with what it took to write them.
    seconds: f64,
    /// Rays of all frames, where they are counted.
    rays: Option<u64>,
    /// Samples of the last frame that were no number and count as black.
    non_finite: u64,
    /// Samples of the last frame that were darkened (pathtrace).
    limited: u64,
    device: DeviceInfo,
}

impl Report {
    /// Before anything was rendered.
    pub fn new(arguments: &Arguments, size: [u32; 2], device: DeviceInfo) -> Report {
        Report {
            mode: arguments.mode.name(),
            target: arguments.target.name(),
            seed: arguments.seed,
            size,
            frames: 0,
            samples: 0,
            seconds: 0.0,
            rays: None,
            non_finite: 0,
            limited: 0,
            device,
        }
    }

    /// Takes note of the last of so many frames.
    pub fn note(&mut self, frames: u64, samples: u32, counts: Counts, taken: Duration) {
        self.frames = frames;
        self.samples = samples;
        self.seconds = taken.as_secs_f64();
        self.rays = Some(counts.rays).filter(|rays| *rays > 0);
        (self.non_finite, self.limited) = (counts.non_finite, counts.limited);
    }

    /// Writes it for people.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let [width, height] = self.size;
        writeln!(
            out,
            "{} of {width}x{height} pixels, {} samples each, {} in {:.2} s on {}",
            match self.frames {
                1 => "1 frame".into(),
                frames => format!("{frames} frames"),
            },
            self.samples,
            self.mode,
            self.seconds,
            self.device.name
        )?;
        match self.non_finite {
            0 => Ok(()),
            count => writeln!(out, "{count} samples were no number and count as black"),
        }
    }
}
