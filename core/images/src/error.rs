//! What can be wrong with a file.

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The file cannot be read or written.
    #[error(transparent)]
    Unreadable(#[from] std::io::Error),
    /// The file is larger than any picture that is taken.
    #[error("more than {} MiB", crate::MOST_FILE_BYTES >> 20)]
    LargeFile,
    /// It is no PNG, KTX2 or DDS file.
    #[error("no PNG, KTX2 or DDS file")]
    Unknown,
    /// The file is damaged.
    #[error("damaged: {0}")]
    Damaged(String),
    /// A picture of this size is not taken.
    #[error("{width}x{height} texels: 1 to {} a side, {} in all", crate::MOST_SIDE, crate::MOST_TEXELS)]
    Size {
        /// Width in texels.
        width: u32,
        /// Height in texels.
        height: u32,
    },
    /// Texels are stored in a way that is not read.
    #[error("texels of the format {0} are not read")]
    Format(String),
    /// The file is no plain two-dimensional picture.
    #[error("{0} are not read")]
    Kind(&'static str),
}

impl ImageError {
    /// A damaged file, by what a reader says of it.
    pub(crate) fn damaged(reason: impl std::fmt::Display) -> Self {
        Self::Damaged(reason.to_string())
    }
}
