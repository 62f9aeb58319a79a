//! Where pictures are written.

use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// A file, or a file a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Destination {
    /// Up to the frame's number.
    before: String,
    /// Digits of the number at least, and what comes after it; none where names have no number.
    after: Option<(usize, String)>,
}

impl Destination {
    /// Of a path that may have the number of a frame in it, as printf writes it: `%d`, `%06d`.
    pub fn new(path: &Path) -> Result<Destination, Failure> {
        let text = path.to_str().ok_or_else(|| usage(path, "is no text"))?;
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("exr" | "npy" | "png") => {}
            _ => return Err(usage(path, "ends in none of .exr, .npy and .png")),
        }
        let Some((before, number)) = text.split_once('%') else {
            return Ok(Destination { before: text.into(), after: None });
        };
        let parse = || {
            let (digits, after) = number.split_once('d')?;
            let digits = match digits.strip_prefix('0') {
                Some(digits) => digits.parse().ok().filter(|digits| (1..=20).contains(digits))?,
                None if digits.is_empty() => 1,
                None => return None,
            };
            (!after.contains('%')).then(|| (digits, after.to_owned()))
        };
        let after = parse().ok_or_else(|| usage(path, "has no number of a frame as in frame-%06d.npy"))?;
        Ok(Destination { before: before.into(), after: Some(after) })
    }

    /// Whether each frame has a file of its own.
    pub fn is_numbered(&self) -> bool {
        self.after.is_some()
    }

    /// The file of a frame.
    pub fn of_frame(&self, frame: u64) -> PathBuf {
        match &self.after {
            Some((digits, after)) => format!("{}{frame:0digits$}{after}", self.before).into(),
            None => self.before.clone().into(),
        }
    }

    /// Makes the folder of the files, so that what took long to render can be written.
    pub fn make_folder(&self) -> Result<(), Failure> {
        match self.of_frame(0).parent() {
            Some(folder) if folder != Path::new("") => {
                std::fs::create_dir_all(folder).map_err(|error| Failure::output(folder, error))
            }
            _ => Ok(()),
        }
    }
}

fn usage(path: &Path, why: &str) -> Failure {
    Failure::Usage(format!("{} {why}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_printf_writes_them() {
        let destination = |text: &str| Destination::new(Path::new(text));
        let numbered = destination("a/frame-%06d.npy").unwrap();
        assert_eq!(numbered.of_frame(17), Path::new("a/frame-000017.npy"));
        assert_eq!(destination("%d.exr").unwrap().of_frame(17), Path::new("17.exr"));
        let single = destination("a.npy").unwrap();
        assert_eq!((single.is_numbered(), single.of_frame(3)), (false, "a.npy".into()));
        for refused in ["a.jpeg", "a", "%s.npy", "%06d%d.npy", "%999d.npy", "%6d.npy", "a%.npy"] {
            assert!(destination(refused).is_err(), "{refused}");
        }
    }
}
