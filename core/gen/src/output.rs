//! Generated files and their place in the repository.

use std::path::{Path, PathBuf};
use std::{fs, io};

/// A generated file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// Place in the repository, with forward slashes.
    pub path: &'static str,
    /// All of its text.
    pub text: String,
}

impl Output {
    /// A file with that text.
    pub fn new(path: &'static str, text: String) -> Output {
        Output { path, text }
    }

    fn place(&self, root: &Path) -> PathBuf {
        root.join(self.path)
    }

    fn is_current(&self, root: &Path) -> bool {
        fs::read(self.place(root)).is_ok_and(|bytes| bytes == self.text.as_bytes())
    }
}

/// The outputs that the repository at `root` lacks or holds with another text.
pub fn differing<'a>(root: &Path, outputs: &'a [Output]) -> Vec<&'a Output> {
    outputs.iter().filter(|output| !output.is_current(root)).collect()
}

/// Writes an output into the repository at `root`.
///
/// # Errors
/// Those of the file system.
pub fn write(root: &Path, output: &Output) -> io::Result<()> {
    let place = output.place(root);
    if let Some(folder) = place.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(place, &output.text)
}
