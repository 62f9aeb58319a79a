//! `afterglow render`: makes pictures of a scene in a file.

mod destination;
mod painter;
mod report;
mod selection;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use afterglow_scene_file::{SceneFile, Stage};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use crate::failure::{self, Failure};
use crate::options::{DeviceArguments, Mode, Size, number};
use crate::output;
use destination::Destination;
use painter::{Painter, Picture};
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
    /// Samples a pixel and frame; the default is 4
    #[arg(long, value_name = "N", env = "AFTERGLOW_SPP", value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    spp: Option<u32>,
    /// Render successive frames of a still scene for so long
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frames")]
    seconds: Option<Duration>,
    /// Of a scene with a sequence: its frames A..B without B. Of a still: so many successive frames, of which the last is written
    #[arg(long, value_name = "N|A..B")]
    frames: Option<Frames>,
    /// The picture: linear EXR or .npy, or PNG as it would be shown. Of a sequence with the frame's number, as in
    /// DIR/frame-%06d.npy
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Size of the picture; the default is the scene's
    #[arg(long, value_name = "WxH", env = "AFTERGLOW_SIZE")]
    size: Option<Size>,
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
    let stage = load(arguments)?;
    let selection = Selection::new(arguments.frames.as_ref(), arguments.seconds, stage.frame_count())?;
    let destination = Destination::new(&arguments.out)?;
    let mut painter = Painter::new(arguments)?;
    let mut report = Report::new(arguments, stage.size(), painter.device());
    destination.make_folder()?;

    let progress = progress_bar(&selection);
    let started = Instant::now();
    let mut last = None;
    let mut frames = selection.frames();
    while let Some(index) = frames.next(started.elapsed()) {
        painter.paint(&stage, index)?;
        progress.set_position(selection.position(frames.count(), started.elapsed()));
        if destination.is_numbered() {
            let picture = painter.read()?;
            write(&destination, index.unwrap_or(frames.count() - 1), &picture)?;
            last = Some(picture);
        }
    }
    let last = match last {
        Some(picture) => picture,
        None => {
            let picture = painter.read()?;
            write(&destination, 0, &picture)?;
            picture
        }
    };
    progress.finish_and_clear();
    report.finish(frames.count(), &last, started.elapsed());
    conclude(arguments, &painter, &report)
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

fn write(destination: &Destination, frame: u64, picture: &Picture) -> Result<(), Failure> {
    output::write_image(&destination.of_frame(frame), &picture.image)
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

/// On a terminal only.
fn progress_bar(selection: &Selection) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {percent}%  {elapsed}  {eta} left");
    ProgressBar::new(selection.length()).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
