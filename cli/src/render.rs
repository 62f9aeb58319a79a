//! `afterglow render`: makes pictures of a scene in a file.

mod destination;
pub mod pace;
mod painter;
pub mod progress;
mod report;
mod selection;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use afterglow_scene_file::{SceneFile, Stage};
use clap::{Args, ValueEnum};

use crate::failure::{self, Failure};
use crate::options::{DeviceArguments, LightArguments, Mode, Size, number};
use crate::output;
use destination::Destination;
use painter::{Painter, Picture};
use progress::Progress;
use report::Report;
use selection::{Frames, Selection};

/// Arguments of `render`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The scene: JSON (a scene, or a view of a mesh) or .npz (a mesh)
    scene: PathBuf,
    /// How the picture is made
    #[arg(long, value_enum, default_value = "pathtrace", env = "AFTERGLOW_MODE")]
    mode: Mode,
    /// Which light is in it
    #[arg(long, value_enum, default_value = "full", env = "AFTERGLOW_TARGET")]
    target: Target,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 0, env = "AFTERGLOW_SEED")]
    seed: u32,
    /// Samples a pixel and frame; 4 unless it or a preset is said, and in reference mode 64
    #[arg(long, value_name = "N", env = "AFTERGLOW_SPP", value_parser = clap::value_parser!(u32).range(1..=65536))]
    spp: Option<u32>,
    /// Render for so long: in reference mode each frame, unless it has its samples earlier, else successive frames of a still
    #[arg(long, value_name = "S", value_parser = seconds)]
    seconds: Option<Duration>,
    /// Of a scene with a sequence: its frames A..B without B. Of a still: so many successive frames, of which the last is written
    #[arg(long, value_name = "N|A..B")]
    frames: Option<Frames>,
    /// The picture: linear EXR or .npy, or PNG as it would be shown. Of a sequence with the frame's number, as in
    /// DIR/frame-%06d.npy
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Also write the standard error of each pixel and channel, named like the picture (reference)
    #[arg(long, value_name = "FILE")]
    standard_error: Option<PathBuf>,
    /// Size of the picture; the default is the scene's
    #[arg(long, value_name = "WxH", env = "AFTERGLOW_SIZE")]
    size: Option<Size>,
    #[command(flatten)]
    light: LightArguments,
    #[command(flatten)]
    device: DeviceArguments,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Which light a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Target {
    /// What surfaces give off, and scatter of it once
    Direct,
    /// That, and what they have scattered twice
    Bounce1,
    /// However often it was scattered
    Full,
}

impl Target {
    /// As it is written on the command line.
    fn name(self) -> &'static str {
        match self {
            Target::Direct => "direct",
            Target::Bounce1 => "bounce1",
            Target::Full => "full",
        }
    }
}

/// Runs `render`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let destination = Destination::new(&arguments.out)?;
    let of_errors = arguments.standard_error()?;
    let stage = load(arguments)?;
    let selection = arguments.selection(stage.frame_count())?;
    let mut painter = Painter::new(arguments)?;
    let mut report = Report::new(arguments, stage.size(), painter.device());
    destination.make_folder()?;

    let progress = Progress::new();
    let started = Instant::now();
    let mut frames = selection.frames();
    while let Some(index) = frames.next(started.elapsed()) {
        let done = frames.count() - 1;
        painter.paint(&stage, index, |share| {
            progress.show(selection.share(done as f64 + share, started.elapsed()));
        })?;
        let is_last = frames.is_last(started.elapsed());
        if is_last || destination.is_numbered() {
            let picture = painter.read()?;
            write(&destination, of_errors.as_ref(), index.unwrap_or(done), &picture)?;
            report.note(frames.count(), picture.samples, painter.counts(), started.elapsed());
        }
        if is_last {
            break;
        }
    }
    progress.finish();
    conclude(arguments, &painter, &report)
}

impl Arguments {
    /// Which frames are rendered, of a scene whose sequence has so many.
    fn selection(&self, length: usize) -> Result<Selection, Failure> {
        // In reference mode it is the time of each frame.
        let time = self.seconds.filter(|_| self.mode != Mode::Reference);
        Selection::new(self.frames.as_ref(), time, length)
    }

    /// Where standard errors are written, if they are.
    fn standard_error(&self) -> Result<Option<Destination>, Failure> {
        match &self.standard_error {
            Some(_) if self.mode != Mode::Reference => {
                Err(Failure::Usage("only pictures of reference mode have a standard error".into()))
            }
            path => path.as_deref().map(Destination::new).transpose(),
        }
    }
}

fn load(arguments: &Arguments) -> Result<Stage, Failure> {
    let path = &arguments.scene;
    let scene: SceneFile =
        afterglow_scene_file::load(path).map_err(|error| Failure::input(&error.path, error.problem))?;
    let stage = Stage::new(scene).map_err(|problem| Failure::input(path, problem))?;
    Ok(match arguments.size {
        Some(Size(width, height)) => stage.with_size([width, height]),
        None => stage,
    })
}

fn write(
    destination: &Destination,
    of_errors: Option<&Destination>,
    frame: u64,
    picture: &Picture,
) -> Result<(), Failure> {
    output::write_image(&destination.of_frame(frame), &picture.image)?;
    if of_errors.is_some() && picture.samples < 2 {
        return Err(Failure::Usage("one sample has no standard error: ask for more with --spp".into()));
    }
    match (of_errors, &picture.standard_error) {
        (Some(path), Some(error)) => output::write_image(&path.of_frame(frame), error),
        _ => Ok(()),
    }
}

fn conclude(arguments: &Arguments, painter: &Painter, report: &Report) -> Result<(), Failure> {
    if arguments.json.as_deref() != Some(Path::new("-")) {
        output::print(|out| report.write(out))?;
    }
    if let Some(path) = &arguments.json {
        output::write_json(path, report)?;
    }
    failure::validation(&painter.validation_messages())
}

/// A time in seconds, more than 0 and no more than 12 days.
fn seconds(text: &str) -> Result<Duration, String> {
    match number(text)? {
        seconds if seconds > 0.0 && seconds <= 1e6 => Ok(Duration::from_secs_f64(seconds)),
        _ => Err(format!("'{text}' is not from 0 to 1000000")),
    }
}
