//! Afterglow's command line.

mod bench;
mod compare;
mod doctor;
mod failure;
mod figures;
mod inspect;
mod libdir;
mod manual;
mod options;
mod output;
mod render;
mod replay;
mod run;

use std::io::IsTerminal;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

/// Path-traces old OpenGL programs: replays their traces and explains itself.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a program with its OpenGL path-traced.
    Run(run::Arguments),
    /// Play a captured trace and write its pictures.
    Replay(replay::Arguments),
    /// Say what is in a trace.
    Inspect(inspect::Arguments),
    /// Make a picture of a scene in a file.
    Render(render::Arguments),
    /// Compare two pictures.
    Compare(compare::Arguments),
    /// Measure what things cost.
    Bench(bench::Arguments),
    /// Say whether this machine can run Afterglow, and on what.
    Doctor(doctor::Arguments),
    /// Print the folder that holds libGL.so.1, to be put first on LD_LIBRARY_PATH.
    Libdir,
    /// Write the manual pages.
    Manual(manual::Arguments),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_max_level(tracing::Level::WARN)
        .without_time()
        .with_ansi(std::io::stderr().is_terminal())
        .init();
    let result = match arguments.command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Replay(arguments) => replay::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Doctor(arguments) => doctor::run(&arguments),
        Command::Libdir => libdir::run(),
        Command::Manual(arguments) => manual::run(&arguments, Arguments::command()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("afterglow: {failure}");
            failure.exit_code()
        }
    }
}
