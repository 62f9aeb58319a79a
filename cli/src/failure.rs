//! What can go wrong, and the exit code that says so.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use afterglow_trace::TraceEnd;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A comparison or a check failed.
    #[error("{0}")]
    Check(String),
    /// The arguments make no sense together.
    #[error("{0}")]
    Usage(String),
    /// There is no usable Vulkan device.
    #[error("{0}\n  `afterglow doctor` says more")]
    Device(#[from] afterglow_gpu::GpuError),
    /// A file is damaged or cannot be read.
    #[error("{path}: {reason}")]
    Input {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A file cannot be written.
    #[error("{path}: {source}")]
    Output {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

impl Failure {
    /// A file that is damaged or cannot be read.
    pub fn input(path: &Path, reason: impl ToString) -> Failure {
        Failure::Input { path: path.into(), reason: reason.to_string() }
    }

    /// A file that cannot be written.
    pub fn output(path: &Path, source: std::io::Error) -> Failure {
        Failure::Output { path: path.into(), source }
    }

    /// 1 a check failed, 2 wrong usage, 3 no device, 4 unreadable or damaged input.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Failure::Check(_) | Failure::Output { .. } => 1,
            Failure::Usage(_) => 2,
            Failure::Device(_) => 3,
            Failure::Input { .. } => 4,
        })
    }
}

/// A failure if a trace was cut short; what came before has been played.
pub fn trace_end(path: &Path, end: Option<TraceEnd>) -> Result<(), Failure> {
    match end {
        Some(TraceEnd::Truncated { offset, .. }) => {
            let reason = format!("cut short after {offset} bytes of calls; what comes before was done");
            Err(Failure::input(path, reason))
        }
        _ => Ok(()),
    }
}

/// A failure if the validation layer has said anything.
pub fn validation(messages: &[String]) -> Result<(), Failure> {
    match messages {
        [] => Ok(()),
        _ => Err(Failure::Check(format!("validation: {} messages\n{}", messages.len(), messages.join("\n")))),
    }
}
