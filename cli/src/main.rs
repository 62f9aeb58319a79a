//! Afterglow's command line.

mod compare;
mod doctor;
mod failure;
mod inspect;
mod options;
mod output;
mod replay;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Path-traces old OpenGL programs: replays their traces and explains itself.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Play a captured trace and write its pictures.
    Replay(replay::Arguments),
    /// Say what is in a trace.
    Inspect(inspect::Arguments),
    /// Compare two pictures.
    Compare(compare::Arguments),
    /// Say whether this machine can run Afterglow, and on what.
    Doctor(doctor::Arguments),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_max_level(tracing::Level::WARN)
        .without_time()
        .init();
    let result = match arguments.command {
        Command::Replay(arguments) => replay::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Doctor(arguments) => doctor::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("afterglow: {failure}");
            failure.exit_code()
        }
    }
}
