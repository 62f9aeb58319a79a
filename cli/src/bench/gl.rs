//! `afterglow bench gl`: both sides in one run, in turn, and their ratio.

use std::io::Write;
use std::path::PathBuf;
use std::process::Command;

use clap::Args;
use serde::Serialize;

use super::gl_client::{CASES, EMPTY_CALL, Figures, Yardstick};
use crate::failure::Failure;
use crate::{libdir, output};

/// Arguments of `bench gl`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Runs of each side; the least time of each case counts
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=100))]
    runs: u32,
    /// Also write the figures as JSON (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// A case: nanoseconds a call.
#[derive(Debug, Serialize)]
struct Row {
    case: &'static str,
    afterglow_ns: f64,
    mesa_ns: f64,
    /// What the bytes that must be copied cost by themselves; only of cases where there are any.
    memcpy_ns: Option<f64>,
    ratio: f64,
    ratio_to: &'static str,
    goal: f64,
}

/// Runs `bench gl`.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = libdir::find()?;
    let (mut ours, mut mesa) = (Figures::default(), Figures::default());
    // In turn, so that what else the machine does meets both.
    for _ in 0..arguments.runs {
        ours.keep_least(&measure(&[
            ("LD_LIBRARY_PATH", &folder.to_string_lossy()),
            ("AFTERGLOW_NOOP", "1"),
        ])?);
        mesa.keep_least(&measure(&[("GALLIUM_NOOP", "1"), ("LIBGL_ALWAYS_SOFTWARE", "1")])?);
    }
    let rows: Vec<Row> = CASES.iter().map(|case| row(case, &ours, &mesa)).collect();
    if arguments.json.as_deref() != Some(std::path::Path::new("-")) {
        output::print(|out| {
            writeln!(
                out,
                "{:<28} {:>12} {:>12} {:>12} {:>7} {:>7}",
                "ns a call", "afterglow", "mesa", "memcpy", "ratio", "goal"
            )?;
            for row in &rows {
                let copy = row.memcpy_ns.map_or("-".to_owned(), |ns| format!("{ns:.1}"));
                let mark = if row.ratio <= row.goal { "" } else { "  not met" };
                writeln!(
                    out,
                    "{:<28} {:>12.1} {:>12.1} {:>12} {:>7.2} {:>7.1}{mark}",
                    row.case, row.afterglow_ns, row.mesa_ns, copy, row.ratio, row.goal
                )?;
            }
            writeln!(out, "{EMPTY_CALL} takes {:.1} ns of each call", ours.of(EMPTY_CALL))
        })?;
    }
    arguments.json.as_deref().map_or(Ok(()), |path| output::write_json(path, &rows))
}

fn row(case: &super::gl_client::Case, ours: &Figures, mesa: &Figures) -> Row {
    let (afterglow_ns, mesa_ns) = (ours.of(case.name), mesa.of(case.name));
    let memcpy_ns = (case.yardstick == Yardstick::Copy).then(|| ours.of(case.copy));
    let (base, ratio_to) = match memcpy_ns {
        Some(ns) => (ns, "memcpy"),
        None => (mesa_ns, "mesa"),
    };
    Row {
        case: case.name,
        afterglow_ns,
        mesa_ns,
        memcpy_ns,
        ratio: afterglow_ns / base,
        ratio_to,
        goal: case.goal,
    }
}

/// The figures of this program run as a client, in an environment with these variables.
fn measure(variables: &[(&str, &str)]) -> Result<Figures, Failure> {
    let failed = |why: String| Failure::Check(format!("the measuring client: {why}"));
    let program = std::env::current_exe().map_err(|error| failed(error.to_string()))?;
    let mut command = Command::new(program);
    command.args(["bench", "gl-client"]).env_remove("LD_LIBRARY_PATH");
    let output =
        command.envs(variables.iter().copied()).output().map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| failed(error.to_string()))
}
