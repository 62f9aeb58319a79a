//! `afterglow-truth`: measures scene recovery on programs whose scenes are known.

use std::fs;
use std::io::Write;
use std::path::PathBuf;

use afterglow_truth::measure::{Report, measure, write_table};
use afterglow_truth::styles::{self, Entry, STYLES};
use anyhow::Context;
use clap::Parser;

/// Measures scene recovery on programs whose scenes are known
#[derive(Parser)]
struct Arguments {
    /// Styles of programs; all without any
    styles: Vec<String>,
    /// List the styles and what each has
    #[arg(long)]
    list: bool,
    /// Also write NAME.trace and NAME.truth.json of each style
    #[arg(long, value_name = "DIR")]
    write: Option<PathBuf>,
    /// Also write the figures as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

fn main() -> anyhow::Result<()> {
    let arguments = Arguments::parse();
    let mut out = std::io::stdout().lock();
    let chosen = chosen(&arguments.styles)?;
    if arguments.list {
        for entry in chosen {
            writeln!(out, "{:<18} {}", entry.name, entry.has)?;
        }
        return Ok(());
    }
    let reports: Vec<Report> =
        chosen.into_iter().map(|entry| run(entry, &arguments)).collect::<anyhow::Result<_>>()?;
    write_table(&mut out, &reports)?;
    if let Some(path) = &arguments.json {
        let text = serde_json::to_string_pretty(&reports)?;
        fs::write(path, text).with_context(|| path.display().to_string())?;
    }
    Ok(())
}

fn chosen(names: &[String]) -> anyhow::Result<Vec<&'static Entry>> {
    if names.is_empty() {
        return Ok(STYLES.iter().collect());
    }
    names.iter().map(|name| styles::named(name).with_context(|| format!("no style '{name}'"))).collect()
}

fn run(entry: &Entry, arguments: &Arguments) -> anyhow::Result<Report> {
    let recording = entry.record()?;
    if let Some(folder) = &arguments.write {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        fs::write(folder.join(format!("{}.trace", entry.name)), &recording.trace)?;
        let truth = serde_json::to_string(&recording.truth)?;
        fs::write(folder.join(format!("{}.truth.json", entry.name)), truth)?;
    }
    measure(&recording).with_context(|| entry.name)
}
