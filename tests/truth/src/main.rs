//! `afterglow-truth`: measures scene recovery on programs whose scenes are known.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use afterglow_scene::Relighting;
use afterglow_truth::Recording;
use afterglow_truth::measure::{
    Report, baked, lights_profile, measure, measure_played, play_as, play_file, write_baked, write_table,
    write_wrong,
};
use afterglow_truth::oracle::{self, ORACLES, Oracle};
use afterglow_truth::steady::{watch, write_steadiness};
use afterglow_truth::styles::{self, Entry, STYLES};
use anyhow::Context;
use clap::Parser;

/// Measures scene recovery on programs whose scenes are known
#[derive(Parser)]
struct Arguments {
    /// Styles of programs, all without any; with --oracle, trace files
    styles: Vec<String>,
    /// List the styles and what each has
    #[arg(long)]
    list: bool,
    /// Also write NAME.trace and NAME.truth.json of each style
    #[arg(long, value_name = "DIR")]
    write: Option<PathBuf>,
    /// Measure on recorded traces of a real program, which are named in place of styles
    #[arg(long, value_name = "NAME")]
    oracle: Option<String>,
    /// With --oracle: only list what it says the draws of this frame are
    #[arg(long, value_name = "FRAME", requires = "oracle")]
    draws: Option<usize>,
    /// With --oracle: only paint what --draws lists, as a PPM file
    #[arg(long, value_name = "FILE", requires = "draws")]
    picture: Option<PathBuf>,
    /// With --oracle: only count its classes in each frame
    #[arg(long, requires = "oracle")]
    counts: bool,
    /// Say how steadily the scenes of recorded traces are understood, of whatever program
    #[arg(long, conflicts_with = "oracle")]
    steady: bool,
    /// Also say for what triangles were taken, and why
    #[arg(long)]
    wrong: bool,
    /// Instead, search for the light sources of baked light, and compare them with those it was computed from; with
    /// --write, NAME.lights.toml is a profile with the latter
    #[arg(long, conflicts_with = "oracle")]
    relight: bool,
    /// Also write the figures as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

fn main() -> anyhow::Result<()> {
    let arguments = Arguments::parse();
    let mut out = std::io::stdout().lock();
    if arguments.relight {
        let mut styles = chosen(&arguments.styles)?.into_iter();
        return styles.try_for_each(|entry| relight(&mut out, entry, arguments.write.as_deref()));
    }
    if arguments.steady {
        for path in &arguments.styles {
            writeln!(out, "{path}")?;
            write_steadiness(&mut out, &mut watch(Path::new(path))?)?;
        }
        return Ok(());
    }
    let reports: Vec<Report> = match &arguments.oracle {
        Some(name) => {
            let oracle = oracle::named(name).with_context(|| format!("no oracle '{name}'"))?;
            let paths = arguments.styles.iter().map(Path::new);
            let reports = paths.map(|path| ask(&mut out, oracle, path, &arguments));
            reports.collect::<anyhow::Result<Vec<_>>>()?.into_iter().flatten().collect()
        }
        None if arguments.list => return Ok(list(&mut out, &chosen(&arguments.styles)?)?),
        None => {
            let chosen = chosen(&arguments.styles)?;
            chosen.into_iter().map(|entry| run(entry, &arguments)).collect::<anyhow::Result<_>>()?
        }
    };
    if arguments.draws.is_some() || arguments.counts {
        return Ok(());
    }
    write_table(&mut out, &reports)?;
    if arguments.wrong {
        write_wrong(&mut out, &reports)?;
    }
    if let Some(path) = &arguments.json {
        let text = serde_json::to_string_pretty(&reports)?;
        fs::write(path, text).with_context(|| path.display().to_string())?;
    }
    Ok(())
}

fn list(out: &mut impl Write, styles: &[&Entry]) -> io::Result<()> {
    for entry in styles {
        writeln!(out, "{:<18} {}", entry.name, entry.has)?;
    }
    for oracle in ORACLES {
        writeln!(out, "--oracle {:<18} {}", oracle.name, oracle.program)?;
    }
    Ok(())
}

/// Asks an oracle of a trace: nothing to measure where only its own answers are wanted.
fn ask(
    out: &mut impl Write,
    oracle: &Oracle,
    path: &Path,
    arguments: &Arguments,
) -> anyhow::Result<Option<Report>> {
    let frames = oracle::read(path)?;
    let judged = oracle.judge(&frames);
    if let Some(frame) = arguments.draws {
        let (drawn, judged) = frames.get(frame).zip(judged.get(frame)).context("no such frame")?;
        match &arguments.picture {
            Some(path) => oracle::paint(&mut BufWriter::new(File::create(path)?), drawn, judged)?,
            None => oracle::write_draws(out, drawn, judged)?,
        }
    }
    if arguments.counts {
        oracle::write_counts(out, &frames, &judged)?;
    }
    if arguments.draws.is_some() || arguments.counts {
        return Ok(None);
    }
    let truth = oracle.truth(&frames, &judged);
    drop(frames);
    let report = measure_played(&truth, &play_file(path)?);
    report.with_context(|| path.display().to_string()).map(Some)
}

fn chosen(names: &[String]) -> anyhow::Result<Vec<&'static Entry>> {
    if names.is_empty() {
        return Ok(STYLES.iter().collect());
    }
    names.iter().map(|name| styles::named(name).with_context(|| format!("no style '{name}'"))).collect()
}

fn relight(out: &mut impl Write, entry: &Entry, folder: Option<&Path>) -> anyhow::Result<()> {
    let recording = entry.record()?;
    let played = play_as(&recording.trace, Relighting::AtOnce).with_context(|| entry.name)?;
    let observed: Vec<_> = played.into_iter().map(|frame| frame.observed).collect();
    if let (Some(folder), Some(profile)) = (folder, lights_profile(&recording.truth, &observed)) {
        write_recording(folder, entry, &recording)?;
        fs::write(folder.join(format!("{}.lights.toml", entry.name)), profile)?;
    }
    Ok(write_baked(out, entry.name, baked(&recording.truth, &observed).as_ref())?)
}

fn run(entry: &Entry, arguments: &Arguments) -> anyhow::Result<Report> {
    let recording = entry.record()?;
    if let Some(folder) = &arguments.write {
        write_recording(folder, entry, &recording)?;
    }
    measure(&recording).with_context(|| entry.name)
}

fn write_recording(folder: &Path, entry: &Entry, recording: &Recording) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    fs::write(folder.join(format!("{}.trace", entry.name)), &recording.trace)?;
    let truth = serde_json::to_string(&recording.truth)?;
    Ok(fs::write(folder.join(format!("{}.truth.json", entry.name)), truth)?)
}
