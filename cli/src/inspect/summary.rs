//! What draws are taken for, summed up over the frames asked for.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::time::Duration;

use afterglow_scene::{Class, Scene};
use serde::Serialize;

use crate::figures::Light;

/// Sums over all frames.
#[derive(Debug, Default, Serialize)]
pub struct Summary {
    frames: u32,
    /// Frames with a camera.
    with_camera: u32,
    /// Frames whose world shows baked light.
    baked: u32,
    /// Of understanding a frame.
    median_ms: f64,
    reasons: Vec<Reason>,
    /// Of the last frame.
    lights: Vec<Light>,
    /// Of the last frame, linear.
    sky: [f32; 3],
    /// Of the last frame, linear.
    ambient: [f32; 3],
    #[serde(skip)]
    times: Vec<Duration>,
    #[serde(skip)]
    sums: BTreeMap<(usize, &'static str), Sum>,
}

/// What was found for one reason, means a frame.
#[derive(Debug, Serialize)]
struct Reason {
    class: &'static str,
    reason: &'static str,
    triangles: f64,
    draws: f64,
    baked: f64,
}

#[derive(Debug, Default)]
struct Sum {
    triangles: u64,
    draws: u64,
    baked: u64,
}

impl Summary {
    /// Adds a frame.
    pub fn add(&mut self, scene: &Scene, time: Duration) {
        for verdict in &scene.verdicts {
            let class = Class::ALL.iter().position(|&class| class == verdict.class).unwrap_or_default();
            let sum = self.sums.entry((class, verdict.reason)).or_default();
            let triangles = u64::from(verdict.triangles);
            sum.triangles += triangles;
            sum.draws += 1;
            sum.baked += if verdict.baked { triangles } else { 0 };
        }
        self.frames += 1;
        self.with_camera += u32::from(scene.camera.is_some());
        self.baked += u32::from(scene.baked);
        self.lights = scene.lights.iter().map(Light::from).collect();
        (self.sky, self.ambient) = (scene.sky.into(), scene.ambient.into());
        self.times.push(time);
    }

    /// Reckons means and median.
    pub fn finish(&mut self) {
        let frames = f64::from(self.frames.max(1));
        self.times.sort();
        self.median_ms = self.times.get(self.times.len() / 2).map_or(0.0, |t| t.as_secs_f64() * 1e3);
        let reason = |(&(class, reason), sum): (&(usize, &'static str), &Sum)| {
            let [triangles, draws, baked] =
                [sum.triangles, sum.draws, sum.baked].map(|count| count as f64 / frames);
            Reason { class: Class::ALL[class].name(), reason, triangles, draws, baked }
        };
        self.reasons = self.sums.iter().map(reason).collect();
    }

    /// Writes it for people.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(
            out,
            "{} frames ({} with a camera, {} baked), median {:.3} ms a frame",
            self.frames, self.with_camera, self.baked, self.median_ms
        )?;
        writeln!(out, "{:>12} {:>9} {:>10}  means a frame", "triangles", "draws", "baked")?;
        for Reason { class, reason, triangles, draws, baked } in &self.reasons {
            writeln!(out, "{triangles:12.1} {draws:9.1} {baked:10.1}  {class}: {reason}")?;
        }
        let [sky, ambient] = [self.sky, self.ambient].map(|[r, g, b]| format!("{r:.3} {g:.3} {b:.3}"));
        writeln!(out, "last frame: sky {sky}, ambient {ambient}")?;
        for light in &self.lights {
            writeln!(out, "  {light}")?;
        }
        Ok(())
    }
}
