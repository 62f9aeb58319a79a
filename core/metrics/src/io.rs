//! Pictures in files: PNG (display values), EXR and `.npy` (linear light), told apart by their extensions. An array within
//! NumPy's `.npz` is named behind a colon, as in `references.npz:full`.
//!
//! Sizes are checked against [`crate::MAX_SIDE`] and [`crate::MAX_PIXELS`] before anything of that size is allocated, so a
//! damaged or hostile file gives an error and no more.

pub mod exr;
pub mod npy;
pub mod png;

use std::fs::File;
use std::io::{BufReader, BufWriter, Write};
use std::path::Path;

use afterglow_npy::Archive;

use crate::error::{FormatError, MetricsError};
use crate::image::{Image, MAX_PIXELS};

/// Bytes of an archive, and of an array in it: those of the largest picture in f64, with some room for its header.
const MAX_FILE: u64 = 24 * MAX_PIXELS as u64 + 65_536;

#[derive(Clone, Copy)]
enum Format {
    Png,
    Exr,
    Npy,
}

impl Format {
    fn of(path: &Path) -> Result<Self, FormatError> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            Some("npy") => Ok(Self::Npy),
            _ => Err(FormatError::UnknownExtension),
        }
    }
}

/// Reads a `.png` as display values, an `.exr`, `.npy` or array of an `.npz` as linear light.
///
/// # Errors
/// If the file cannot be read, is none of these, is damaged, or is too large.
pub fn load(path: &Path) -> Result<Image, MetricsError> {
    read_file(path).map_err(|source| MetricsError::Load { path: path.to_owned(), source })
}

/// Writes a `.png` (sRGB-encoded, clamped, 8 bits) or an `.exr` or `.npy` (linear `f32`); an encoded picture is linearised
/// for the latter.
///
/// # Errors
/// If the extension is none of these or the file cannot be written.
pub fn save(image: &Image, path: &Path) -> Result<(), MetricsError> {
    write_file(image, path).map_err(|source| MetricsError::Save { path: path.to_owned(), source })
}

fn read_file(path: &Path) -> Result<Image, FormatError> {
    if let Some((archive, array)) = path.to_str().and_then(member) {
        let file = Archive::open(archive, MAX_FILE)?.file(array)?;
        return npy::read(&mut file.as_slice());
    }
    let format = Format::of(path)?;
    let mut file = BufReader::new(File::open(path)?);
    match format {
        Format::Png => png::read(&mut file),
        Format::Exr => exr::read(&mut file),
        Format::Npy => npy::read(&mut file),
    }
}

/// The archive and the array that a path names, if it does.
fn member(path: &str) -> Option<(&Path, &str)> {
    let (archive, array) = path.rsplit_once(':')?;
    archive.to_ascii_lowercase().ends_with(".npz").then(|| (Path::new(archive), array))
}

fn write_file(image: &Image, path: &Path) -> Result<(), FormatError> {
    let format = Format::of(path)?;
    let mut file = BufWriter::new(File::create(path)?);
    match format {
        Format::Png => png::write(image, &mut file)?,
        Format::Exr => exr::write(image, &mut file)?,
        Format::Npy => npy::write(image, &mut file)?,
    }
    // Dropping the buffer would lose an error of its last bytes.
    Ok(file.flush()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Encoding;
    use crate::test_images as synthetic;

    #[test]
    fn files_give_back_what_was_saved() {
        let folder = tempfile::tempdir().unwrap();
        let light = synthetic::wide();
        for name in ["light.exr", "light.npy", "LIGHT.EXR"] {
            let path = folder.path().join(name);
            save(&light, &path).unwrap();
            assert_eq!(load(&path).unwrap(), light, "{name}");
        }
        let path = folder.path().join("shown.png");
        save(&light, &path).unwrap();
        assert_eq!(load(&path).unwrap(), light.rounded_to_8_bits());
    }

    #[test]
    fn display_values_are_linearised_for_exr_and_npy() {
        let folder = tempfile::tempdir().unwrap();
        let shown = synthetic::stripes();
        for name in ["shown.exr", "shown.npy"] {
            let path = folder.path().join(name);
            save(&shown, &path).unwrap();
            let light = load(&path).unwrap();
            assert_eq!(light.encoding(), Encoding::Linear);
            assert_eq!(&light, shown.to_linear().as_ref());
        }
    }

    #[test]
    fn errors_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let message = |name: &str| load(&folder.path().join(name)).unwrap_err().to_string();
        assert!(message("absent.png").contains("absent.png"));
        assert!(message("picture.jpeg").contains("extension"));
        let path = folder.path().join("no folder").join("a.png");
        assert!(save(&synthetic::stripes(), &path).is_err());
    }
}
