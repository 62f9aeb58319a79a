//! `afterglow bench denoise`: how good the pictures of few samples are while camera, objects and lights change.
//!
//! Each denoiser plays a scene's sequence from its first frame on, with its history. Frames are held against converged
//! pictures: of a file, or made by reference mode and kept. Errors, flicker and lag are those of
//! [`figures`]; what was uncovered a short time ago, and has no history, is judged by itself as well ([`visibility`]).

mod figures;
mod judge;
mod oidn;
mod pictures;
mod player;
mod references;
mod report;
mod sequence;
mod visibility;

use std::ops::Range;
use std::path::{Path, PathBuf};

use afterglow_render::Denoiser;
use clap::Args;

use crate::failure::{self, Failure};
use crate::options::{Backend, DeviceArguments, Frames};
use crate::output;
use crate::render::progress::Progress;
use judge::{Figures, Judge};
use pictures::Album;
use player::{Pictures, Player};
use references::{Making, References};
use report::{Report, SequenceReport};
use sequence::Sequence;

/// Arguments of `bench denoise`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A scene with a sequence (JSON); the default is two that come with Afterglow, of metals and of many lamps
    #[arg(long, value_name = "FILE")]
    scene: Vec<PathBuf>,
    /// Converged pictures (.npz: `reference_of_frame`, `full_NNNN`, `se_NNNN`); the default is to make them
    #[arg(long, value_name = "FILE", requires = "scene")]
    references: Option<PathBuf>,
    /// Samples a pixel of references that are made
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(2..=65536))]
    reference_spp: u32,
    /// Of frames in which something moves, every so many get a reference that is made
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=1000))]
    reference_every: u32,
    /// Folder where references that were made are kept; the default is in the cache folder
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    /// Which denoiser, several times for several; the default is all
    #[arg(long, value_name = "NAME", value_parser = crate::options::denoiser())]
    denoiser: Vec<Denoiser>,
    /// Also Intel's Open Image Denoise on the same noise, each picture by itself, if Python has `pyoidn`
    #[arg(long)]
    oidn: bool,
    /// The Python of `--oidn`
    #[arg(long, value_name = "FILE", default_value = "python3")]
    python: PathBuf,
    /// Samples a pixel and frame
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=65536))]
    spp: u32,
    /// Bounces of light between surfaces
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(0..=63))]
    bounces: u32,
    /// Radiance that a sample brings at most; `inf` for no limit
    #[arg(long, value_name = "RADIANCE", default_value_t = 16.0, value_parser = crate::options::limit)]
    limit: f32,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// What traces rays
    #[arg(long, value_enum, value_name = "WHAT", default_value = "auto")]
    backend: Backend,
    /// Do not add up the samples of frames that show the same: what is seen then is the denoiser's own
    #[arg(long)]
    no_accumulate: bool,
    /// Frames A..B without B; the history begins at A
    #[arg(long, value_name = "A..B")]
    frames: Option<Frames>,
    /// Print the figures of each frame
    #[arg(long)]
    each: bool,
    /// Write the frames as they would be shown, and sheets of successive ones, as PNG
    #[arg(long, value_name = "DIR")]
    save: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceArguments,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Runs `bench denoise`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.references.is_some() && arguments.scene.len() > 1 {
        return Err(Failure::Usage("--references are of one scene".into()));
    }
    let sequences = match arguments.scene.as_slice() {
        [] => Sequence::own()?,
        paths => paths.iter().map(|path| Sequence::load(path)).collect::<Result<_, _>>()?,
    };
    let mut bench = Bench::new(arguments)?;
    for sequence in &sequences {
        bench.measure(sequence)?;
    }
    if let Some(path) = &arguments.json {
        output::write_json(path, &bench.report)?;
    }
    failure::validation(&bench.player.validation_messages())
}

/// What is the same for all scenes.
struct Bench<'a> {
    arguments: &'a Arguments,
    player: Player,
    denoisers: Vec<Denoiser>,
    /// Whether Open Image Denoise is asked for, and there.
    oidn: bool,
    report: Report,
}

impl<'a> Bench<'a> {
    fn new(arguments: &'a Arguments) -> Result<Self, Failure> {
        let player = Player::new(arguments)?;
        let report = Report::new(arguments, player.device());
        let denoisers = match arguments.denoiser.as_slice() {
            [] => Denoiser::ALL.to_vec(),
            asked => asked.to_vec(),
        };
        let mut bench = Bench { arguments, player, denoisers, oidn: false, report };
        bench.print(|bench, out| bench.report.write_head(out))?;
        if arguments.oidn {
            match oidn::check(&arguments.python) {
                Ok(()) => bench.oidn = true,
                Err(reason) => {
                    eprintln!("afterglow: without Open Image Denoise, which is not there: {reason}")
                }
            }
        }
        Ok(bench)
    }

    fn measure(&mut self, sequence: &Sequence) -> Result<(), Failure> {
        let arguments = self.arguments;
        let played = sequence.played(arguments.frames.as_ref().map(|Frames(range)| range))?;
        let references = self.references(sequence, &played)?;
        let judge = Judge::new(sequence, &played, &references)?;
        let folder = arguments.save.as_ref().map(|folder| folder.join(file_name(&sequence.name)));
        let mut album = folder.map(|folder| Album::new(folder, &played, &references)).transpose()?;
        let mut denoisers = Vec::new();
        for number in 0..self.denoisers.len() + usize::from(self.oidn) {
            let (name, pictures) = self.play(sequence, &played, number)?;
            let failed = |error: afterglow_metrics::MetricsError| Failure::Check(error.to_string());
            let figures = judge.judge(name, &pictures).map_err(failed)?;
            if arguments.each {
                self.print(|_, out| figures.write_frames(out))?;
            }
            denoisers.push(figures);
            if let Some(album) = &mut album {
                album.add(name, pictures.into_iter().map(Some).collect())?;
            }
        }
        album.map_or(Ok(()), |album| album.write_sheets(&judge))?;
        self.conclude(sequence, &played, denoisers)
    }

    /// The pictures of a denoiser by its number, Open Image Denoise being the last.
    fn play(
        &self,
        sequence: &Sequence,
        played: &Range<usize>,
        number: usize,
    ) -> Result<(&'static str, Pictures), Failure> {
        let bar = Progress::new();
        let mut done = 0;
        let progress = || {
            done += 1;
            bar.show(f64::from(done) / played.len() as f64);
        };
        let found = match self.denoisers.get(number) {
            Some(&denoiser) => {
                let pictures = self.player.play(&sequence.stage, played, denoiser, progress)?;
                (denoiser.name(), pictures)
            }
            None => ("oidn", oidn::play(&self.player, sequence, played, &self.arguments.python, progress)?),
        };
        bar.finish();
        Ok(found)
    }

    fn references(&self, sequence: &Sequence, played: &Range<usize>) -> Result<References, Failure> {
        if let Some(path) = &self.arguments.references {
            return References::load(path, sequence, played);
        }
        let own_folder = || Some(afterglow_gpu::lavapipe::cache_folder()?.join("references"));
        let cache = self.arguments.cache.clone().or_else(own_folder).ok_or_else(|| {
            Failure::Usage("there is no cache folder: --cache says where references are kept".into())
        })?;
        let how = Making {
            samples: self.arguments.reference_spp,
            every: self.arguments.reference_every as usize,
            cache,
        };
        let bar = Progress::new();
        let references = References::make(&self.player, sequence, played, &how, |share| bar.show(share));
        bar.finish();
        references
    }

    fn conclude(
        &mut self,
        sequence: &Sequence,
        played: &Range<usize>,
        denoisers: Vec<Figures>,
    ) -> Result<(), Failure> {
        let made = self.arguments.references.is_none();
        let report = SequenceReport {
            name: sequence.name.clone(),
            size: sequence.scene.size,
            frames: [played.start, played.end],
            reference_spp: made.then_some(self.arguments.reference_spp),
            denoisers,
        };
        self.print(|_, out| report.write(out))?;
        self.report.sequences.push(report);
        Ok(())
    }

    /// Prints for people, unless standard output is for JSON.
    fn print(
        &self,
        write: impl FnOnce(&Self, &mut std::io::BufWriter<std::io::Stdout>) -> std::io::Result<()>,
    ) -> Result<(), Failure> {
        match self.arguments.json.as_deref() == Some(Path::new("-")) {
            true => Ok(()),
            false => output::print(|out| write(self, out)),
        }
    }
}

/// A scene's name as that of a folder.
fn file_name(name: &str) -> String {
    let kept = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '_' };
    name.chars().map(kept).collect()
}
