//! `afterglow replay`: plays a captured trace and writes its pictures.

mod report;
pub mod session;

use std::path::{Path, PathBuf};
use std::time::Instant;

use afterglow_player::{Player, TraceSummary};
use afterglow_render::{Displaced, ImageOptions, PathtraceOptions};
use afterglow_scene::Relighting;
use afterglow_trace::TraceReader;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use crate::failure::{self, Failure};
use crate::options::{
    Baked, DeviceArguments, Frames, ImageArguments, KeepArguments, LightArguments, Mode, ProfileArguments,
    Size, Sky,
};
use crate::output;
use report::Report;
use session::Session;

/// Samples a pixel and frame where none are asked for.
const SAMPLES: u32 = 4;

/// Arguments of `replay`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The trace
    trace: PathBuf,
    /// How frames become pictures
    #[arg(long, value_enum, default_value = "pathtrace", env = "AFTERGLOW_MODE")]
    pub mode: Mode,
    /// Frames to draw: A..B without B, or one; the default is all
    #[arg(long, value_name = "A..B")]
    frames: Option<Frames>,
    /// Write only every Nth picture
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,
    /// Size of the pictures; the default is the traced window's
    #[arg(long, value_name = "WxH", env = "AFTERGLOW_SIZE")]
    size: Option<Size>,
    /// Folder for the pictures; without it none are written
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Format of the pictures
    #[arg(long, value_enum, default_value = "png")]
    format: Format,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 0, env = "AFTERGLOW_SEED")]
    pub seed: u32,
    /// Samples a pixel and frame; 4 unless it or a preset is said (pathtrace)
    #[arg(long, value_name = "N", env = "AFTERGLOW_SPP", value_parser = clap::value_parser!(u32).range(1..=65536))]
    spp: Option<u32>,
    /// Print figures: frame rate, passes, calls
    #[arg(long)]
    stats: bool,
    #[command(flatten)]
    light: LightArguments,
    /// Do not search for the light sources that baked light comes from
    #[arg(long)]
    no_relight: bool,
    /// What becomes of light that is baked into the world, where its sources are found
    #[arg(long, value_enum, value_name = "HOW", default_value = "auto", env = "AFTERGLOW_BAKED")]
    pub baked: Baked,
    /// What rays see of the sky that the program draws
    #[arg(long, value_enum, value_name = "WHAT", default_value = "cube", env = "AFTERGLOW_SKY")]
    pub sky: Sky,
    /// Remember so many MiB of the world that is not drawn, for rays to meet; 0 for none (pathtrace)
    #[arg(long, value_name = "MIB", default_value_t = 256, env = "AFTERGLOW_MEMORY")]
    pub memory: u32,
    #[command(flatten)]
    images: ImageArguments,
    #[command(flatten)]
    keep: KeepArguments,
    /// Move light I by X,Y,Z (world units), to see its shadows follow
    #[arg(long, value_name = "I:X,Y,Z", hide_short_help = true)]
    pub debug_move_light: Option<session::Move>,
    /// Move what traced draw I shows by X,Y,Z (world units) in the world that rays see
    #[arg(long, value_name = "I:X,Y,Z", hide_short_help = true)]
    pub debug_move_draw: Option<session::Move>,
    #[command(flatten)]
    pub profile: ProfileArguments,
    #[command(flatten)]
    pub device: DeviceArguments,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Formats of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// 8 bits, as shown in a window.
    Png,
    /// Linear light of what is shown.
    Exr,
}

impl Format {
    /// Of its files' names; it also says how they are written.
    fn extension(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Exr => "exr",
        }
    }
}

impl Arguments {
    /// How to trace.
    fn pathtrace_options(&self) -> Result<PathtraceOptions, Failure> {
        let mut options = PathtraceOptions::default();
        (options.spp, options.seed) = (SAMPLES, self.seed);
        self.light.apply(self.spp, &mut options);
        // Frames wait for it, so that a trace always gives the same pictures.
        options.relighting = if self.no_relight { Relighting::Off } else { Relighting::AtOnce };
        options.replacing = self.baked.replacing();
        options.sky = self.sky.choice();
        options.profile = self.profile.load_for_trace(&self.trace)?;
        let folder = self.images.folder(options.profile.as_deref())?;
        options.images = folder.map(|folder| ImageOptions { folder, waits: true });
        options.memory_bytes = u64::from(self.memory) << 20;
        options.cache = self.keep.cache_for_trace(&self.trace)?;
        options.move_light = self.debug_move_light.map(|m| (m.index as usize, m.offset.into()));
        options.move_draw = self.debug_move_draw.map(|m| (Displaced::Draw(m.index), m.offset.into()));
        Ok(options)
    }

    /// Whether anybody will read how long the passes took.
    fn wants_timing(&self) -> bool {
        self.stats || self.json.is_some()
    }
}

/// Runs `replay`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.trace;
    let damaged = |error| Failure::input(path, error);
    let summary = TraceSummary::open(path).map_err(damaged)?;
    if summary.calls == 0 {
        return Err(Failure::input(path, summary.failure.as_deref().unwrap_or("there are no calls in it")));
    }
    if let Some(folder) = &arguments.out {
        std::fs::create_dir_all(folder).map_err(|error| Failure::output(folder, error))?;
    }
    let frames = arguments.frames.clone().map_or(0..u64::MAX, |frames| frames.0);
    let session = Session::new(arguments)?;
    let mut player =
        Player::new(TraceReader::open(path).map_err(damaged)?, summary.sizes(), session.factory());
    let progress = progress_bar(u64::from(summary.swaps).min(frames.end));
    let mut report = Report::new(session.device());
    let mut started = Instant::now();
    session.set_lit(frames.start <= 1);
    while let Some(end) = player.next_frame() {
        let frame = u64::from(end.frame);
        if frames.contains(&frame) {
            let wanted = (frame - frames.start).is_multiple_of(arguments.every);
            let finished = session.finish_frame()?;
            report.frame(frame, arguments.mode, &finished);
            if let Some(folder) = arguments.out.as_ref().filter(|_| wanted) {
                let path = folder.join(format!("frame-{frame:06}.{}", arguments.format.extension()));
                output::write_picture(&path, finished.size, &finished.pixels)?;
            }
        }
        progress.inc(1);
        if frame + 1 >= frames.end {
            break;
        }
        // The frame before the first is drawn too: a program may draw over what it left.
        session.set_lit(frame + 2 >= frames.start);
        if frame + 1 == frames.start {
            started = Instant::now();
        }
    }
    progress.finish_and_clear();
    report.finish(started.elapsed(), &player.report());
    conclude(arguments, &summary, &session, &report)
}

fn conclude(
    arguments: &Arguments,
    summary: &TraceSummary,
    session: &Session,
    report: &Report,
) -> Result<(), Failure> {
    // Figures as JSON on standard output are to be read by a program.
    if arguments.json.as_deref() != Some(Path::new("-")) {
        output::print(|out| {
            report.write_summary(out)?;
            if arguments.stats { report.write_details(out) } else { Ok(()) }
        })?;
    }
    if let Some(path) = &arguments.json {
        output::write_json(path, report)?;
    }
    failure::validation(&session.validation_messages())?;
    if let Some(failure) = &summary.failure {
        return Err(Failure::input(&arguments.trace, format!("{failure}; what comes before was played")));
    }
    failure::trace_end(&arguments.trace, summary.end)?;
    if report.is_empty() {
        return Err(Failure::Usage(format!(
            "the trace has {} frames, none of those asked for",
            summary.swaps
        )));
    }
    Ok(())
}

/// On a terminal only.
fn progress_bar(frames: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} frames  {per_sec}  {eta}");
    ProgressBar::new(frames).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
