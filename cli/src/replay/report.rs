//! What a replay measured, for people and as JSON.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::time::Duration;

use afterglow_gpu::DeviceInfo;
use afterglow_player::PlayReport;
use afterglow_render::{CulledReport, FrameReport, PassReport};
use serde::Serialize;

use crate::figures::{Camera, Light, Relight};
use crate::options::Mode;

/// Everything that `replay --json` writes.
#[derive(Serialize)]
pub struct Report {
    frames: Vec<Frame>,
    calls: Calls,
    device: DeviceInfo,
    seconds: f64,
    frames_per_second: f64,
    /// Hash of all frames' colours, in hexadecimal.
    checksum: String,
    #[serde(skip)]
    hash: xxhash_rust::xxh3::Xxh3,
}

#[derive(Debug, Serialize)]
struct Frame {
    index: u64,
    size: (u32, u32),
    checksum: String,
    mode: &'static str,
    camera: Camera,
    triangles: BTreeMap<&'static str, u64>,
    lights: Vec<Light>,
    /// Once the sources of baked light were searched.
    relight: Option<Relight>,
    /// What rays saw of the sky; none if the frame was not traced.
    sky: Option<&'static str>,
    /// Times that the sky was drawn for rays so far.
    sky_drawings: usize,
    passes: Vec<Pass>,
    culled: Vec<CulledReport>,
    bytes: Bytes,
    draws: usize,
}

/// Memory of the frame's resources. None is shared yet: transients take as much as without aliasing.
#[derive(Debug, Serialize)]
struct Bytes {
    transient: u64,
    transient_unaliased: u64,
    persistent: u64,
    /// Of what is as large as the window and belongs to traced frames, the window itself included.
    screen: u64,
}

#[derive(Debug, Serialize)]
struct Pass {
    name: String,
    ms: f64,
    count: usize,
}

#[derive(Debug, Default, Serialize)]
struct Calls {
    total: u64,
    unsupported: BTreeMap<String, u64>,
    malformed: BTreeMap<String, u64>,
    without_context: BTreeMap<String, u64>,
    gl_errors: BTreeMap<String, u64>,
}

/// A frame as the session delivers it.
pub struct Finished {
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// Hash of the colours.
    pub hash: u64,
    /// RGBA bytes, top row first.
    pub pixels: Vec<u8>,
    /// What the renderer says.
    pub rendered: FrameReport,
}

impl Report {
    /// An empty report.
    pub fn new(device: DeviceInfo) -> Report {
        Report {
            frames: Vec::new(),
            calls: Calls::default(),
            device,
            seconds: 0.0,
            frames_per_second: 0.0,
            checksum: String::new(),
            hash: xxhash_rust::xxh3::Xxh3::new(),
        }
    }

    /// Adds a frame that was asked for in a mode.
    pub fn frame(&mut self, index: u64, mode: Mode, finished: &Finished) {
        self.hash.update(&finished.hash.to_le_bytes());
        let rendered = &finished.rendered;
        let scene = rendered.scene.as_ref();
        self.frames.push(Frame {
            index,
            size: finished.size,
            checksum: format!("{:016x}", finished.hash),
            mode: if rendered.traced.is_some() { mode.name() } else { Mode::Raster.name() },
            camera: scene.and_then(|scene| scene.camera.as_ref()).map(Camera::from).unwrap_or_default(),
            triangles: scene.map(|scene| scene.triangles.named().into()).unwrap_or_default(),
            lights: scene.map(|scene| scene.lights.iter().map(Light::from).collect()).unwrap_or_default(),
            relight: scene.and_then(|scene| scene.relight.as_ref()).map(Relight::from),
            sky: rendered.traced.map(|traced| traced.sky.name()),
            sky_drawings: rendered.traced.map_or(0, |traced| traced.sky_drawings),
            passes: rendered.passes.iter().map(Pass::from).collect(),
            culled: rendered.culled.clone(),
            bytes: Bytes {
                transient: rendered.bytes.transient_unaliased,
                transient_unaliased: rendered.bytes.transient_unaliased,
                persistent: rendered.bytes.persistent + rendered.bytes.imported,
                screen: rendered.traced.map_or(0, |traced| traced.screen_bytes),
            },
            draws: rendered.draws,
        });
    }

    /// Whether no frame was drawn.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Adds what is known at the end. `seconds` is the time of the frames that were asked for.
    pub fn finish(&mut self, drawing: Duration, calls: &PlayReport) {
        self.seconds = drawing.as_secs_f64();
        self.frames_per_second = self.frames.len() as f64 / self.seconds.max(1e-9);
        self.checksum = format!("{:016x}", self.hash.digest());
        self.calls = Calls {
            total: calls.calls,
            unsupported: calls.unsupported.clone(),
            malformed: calls.malformed.clone(),
            without_context: calls.without_context.clone(),
            gl_errors: BTreeMap::new(),
        };
        for error in &calls.errors {
            let name = format!("{} {:#06x}", error.function, error.error);
            *self.calls.gl_errors.entry(name).or_default() += error.count;
        }
    }

    /// Writes how many frames there were, and how fast.
    pub fn write_summary(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(
            out,
            "{} frames in {:.2} s: {:.2} a second on {}; checksum {}",
            self.frames.len(),
            self.seconds,
            self.frames_per_second,
            self.device.name,
            self.checksum
        )?;
        match self.frames.last().and_then(|frame| frame.relight) {
            Some(relight) => writeln!(out, "{relight}"),
            None => Ok(()),
        }
    }

    /// Writes what passes and calls took.
    pub fn write_details(&self, out: &mut impl Write) -> io::Result<()> {
        self.write_passes(out)?;
        let groups = [
            ("unsupported", &self.calls.unsupported),
            ("malformed", &self.calls.malformed),
            ("without a context", &self.calls.without_context),
            ("GL errors", &self.calls.gl_errors),
        ];
        writeln!(out, "{} calls", self.calls.total)?;
        for (name, counts) in groups.iter().filter(|(_, counts)| !counts.is_empty()) {
            let list: Vec<_> = counts.iter().map(|(function, n)| format!("{function} x{n}")).collect();
            writeln!(out, "  {name}: {}", list.join(", "))?;
        }
        Ok(())
    }

    /// Mean time of each pass, in the order of the last frame.
    fn write_passes(&self, out: &mut impl Write) -> io::Result<()> {
        let Some(last) = self.frames.last() else { return Ok(()) };
        let mut names: Vec<&str> = Vec::new();
        for pass in &last.passes {
            if !names.contains(&pass.name.as_str()) {
                names.push(&pass.name);
            }
        }
        for name in names {
            let passes = self.frames.iter().flat_map(|frame| &frame.passes);
            let ms: f64 = passes.filter(|pass| pass.name == name).map(|pass| pass.ms).sum();
            writeln!(out, "  {:>9.3} ms  {name}", ms / self.frames.len() as f64)?;
        }
        Ok(())
    }
}

impl From<&PassReport> for Pass {
    fn from(pass: &PassReport) -> Pass {
        Pass { name: pass.name.clone(), ms: pass.milliseconds, count: pass.count }
    }
}
