//! `afterglow inspect`: what is in a trace, and what its draws are understood as.
//!
//! Calls are counted and printed from the file alone (`calls`). Whatever is asked of draws needs the trace to be played
//! into scene recovery (`play`), which no device has a part in; only pictures (`paint`) are made on one.

mod calls;
mod draws;
mod paint;
pub mod play;
mod propose;
mod rows;
mod summary;
mod textures;

use std::path::PathBuf;

use clap::Args;

use crate::failure::Failure;
use crate::options::{DeviceArguments, Frames, ProfileArguments, Size};

/// Arguments of `inspect`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The trace
    trace: PathBuf,
    /// Only these frames: A..B without B, or one
    #[arg(long, value_name = "A..B")]
    frames: Option<Frames>,
    /// Print every call
    #[arg(long)]
    calls: bool,
    /// Print every draw: what it is taken for and why
    #[arg(long, conflicts_with = "calls")]
    draws: bool,
    /// Print what draws are taken for, summed up by class and reason
    #[arg(long, conflicts_with = "calls")]
    classes: bool,
    /// Write pictures coloured by what draws are taken for to this folder
    #[arg(long, value_name = "DIR", conflicts_with = "calls")]
    paint: Option<PathBuf>,
    /// What the pictures are coloured by; all of it unless it is said
    #[arg(long, value_enum, value_delimiter = ',', value_name = "BY", requires = "paint")]
    by: Vec<paint::By>,
    /// Write each texture that is drawn with to this folder, named after its hash as replacement images are
    #[arg(long, value_name = "DIR", conflicts_with = "calls")]
    textures: Option<PathBuf>,
    /// Of the frames, only every Nth
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "calls")]
    every: u64,
    /// Write a profile to start from: what is found, texture by texture
    #[arg(long, value_name = "FILE", conflicts_with = "calls")]
    propose: Option<PathBuf>,
    /// Size of the pictures; the default is the traced window's
    #[arg(long, value_name = "WxH", requires = "paint")]
    size: Option<Size>,
    #[command(flatten)]
    profile: ProfileArguments,
    #[command(flatten)]
    device: DeviceArguments,
    /// Also write what was asked for as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

impl Arguments {
    /// Whether draws have to be understood.
    fn is_about_draws(&self) -> bool {
        self.draws
            || self.classes
            || self.paint.is_some()
            || self.propose.is_some()
            || self.textures.is_some()
    }

    /// Whether standard output is a JSON file.
    fn prints_json(&self) -> bool {
        self.json.as_deref() == Some(std::path::Path::new("-"))
    }

    fn frames(&self) -> std::ops::Range<u64> {
        self.frames.clone().map_or(0..u64::MAX, |frames| frames.0)
    }
}

/// Runs `inspect`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.is_about_draws() { draws::run(arguments) } else { calls::run(arguments) }
}
