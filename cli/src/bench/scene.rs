//! `afterglow bench scene`: what scene recovery costs a program's frames.
//!
//! Traces are played without a device (`traces`): a frame's cost beside what playing it costs, by phases. Worlds made
//! up here (`worlds`) grow from a thousand triangles to a million (`growth`): a triangle must cost the same in all of
//! them, and next to nothing where it is in a range that stays.

mod growth;
mod traces;
mod worlds;

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::failure::Failure;
use crate::output;

/// Arguments of `bench scene`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Traces, or folders of them; none: only worlds that grow
    traces: Vec<PathBuf>,
    /// Runs of each trace; the least time of each frame counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=100))]
    runs: u32,
    /// The largest world that is made up, in triangles; 0 for none
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    most: u32,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// All figures.
#[derive(Debug, Serialize)]
struct Report {
    traces: Vec<traces::Row>,
    growth: Vec<growth::Row>,
}

/// Runs `bench scene`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let prints = arguments.json.as_deref() != Some(std::path::Path::new("-"));
    let traces = traces::measure(&arguments.traces, arguments.runs, prints)?;
    let growth = growth::measure(arguments.most, prints)?;
    let report = Report { traces, growth };
    arguments.json.as_deref().map_or(Ok(()), |path| output::write_json(path, &report))
}

/// Adds a row to a table, and prints it, after the table's head if it is the first.
fn add<T>(
    rows: &mut Vec<T>,
    row: T,
    prints: bool,
    head: fn(&mut dyn Write) -> io::Result<()>,
    line: fn(&T, &mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    if prints {
        output::print(|out| {
            if rows.is_empty() {
                head(out)?;
            }
            line(&row, out)
        })?;
    }
    rows.push(row);
    Ok(())
}

/// The value below which a share of sorted values lie; 0 without any.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = (sorted.len() as f64 * share) as usize;
    sorted.get(at.min(sorted.len().saturating_sub(1))).copied().unwrap_or(0.0)
}
