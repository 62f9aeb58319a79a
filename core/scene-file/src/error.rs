//! What can be wrong with a file.

use std::path::{Path, PathBuf};

use afterglow_npy::NpyError;
use thiserror::Error;

/// A file that is no scene, and why.
#[derive(Debug, Error)]
#[error("{path}: {problem}")]
pub struct SceneFileError {
    /// Which file: of a view it may be the mesh that it names.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: Problem,
}

impl SceneFileError {
    pub(crate) fn new(path: &Path, problem: impl Into<Problem>) -> Self {
        Self { path: path.into(), problem: problem.into() }
    }
}

/// What is wrong, and where in the file: `place` is written as in `materials[3].base_color`.
#[derive(Debug, Error)]
pub enum Problem {
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// No JSON, or not of a scene's shape; the message has line and column.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// Of a mesh.
    #[error("{0}")]
    Archive(#[source] NpyError),
    /// An array of a mesh.
    #[error("{place}: {source}")]
    Array { place: String, source: NpyError },
    #[error("the format is {0:?}; rtgt-1 is known")]
    Format(String),
    #[error("neither .json nor .npz")]
    Extension,
    #[error("{place}: {count} are too many (at most {most})")]
    TooMany { place: String, count: u64, most: u64 },
    #[error("{place}: index {index} of {count}")]
    Index { place: String, index: u64, count: usize },
    #[error("{place}: {reason}")]
    Value { place: String, reason: String },
}

impl Problem {
    pub(crate) fn value(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Value { place: place.into(), reason: reason.into() }
    }
}
