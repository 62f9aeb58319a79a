//! What can be wrong with an array's file.

/// Why an array cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum NpyError {
    #[error(transparent)]
    Io(#[from] std::io::Error),
    #[error("not an npy file")]
    Magic,
    #[error("npy version {0} is unknown")]
    Version(u8),
    #[error("an npy header of {0} bytes")]
    HeaderLength(usize),
    /// What is wrong, and the header.
    #[error("{reason}, but the header says {header}")]
    Header { reason: String, header: String },
    #[error("{found} bytes of numbers, not the {expected} of the array's shape")]
    Length { expected: usize, found: usize },
    #[error("an array of {found}, where {expected} are expected")]
    Kind { expected: &'static str, found: String },
    #[error("not a zip archive, or one that is damaged: {0}")]
    Archive(&'static str),
    #[error("there is no array {0:?} in it")]
    Absent(String),
    #[error("{name}: {reason}")]
    Member { name: String, reason: &'static str },
    #[error("{name} has {bytes} bytes (at most {most} are read)")]
    TooLarge { name: String, bytes: u64, most: u64 },
}
