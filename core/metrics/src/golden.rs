//! Goldens: stored pictures that new ones must look like, judged by mean FLIP.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use crate::error::{FormatError, GoldenFailure, MetricsError};
use crate::flip::{FlipMap, flip};
use crate::image::Image;
use crate::io;

/// Environment variable that makes [`Mode::from_environment`] bless when it is `1`.
pub const BLESS_VARIABLE: &str = "AFTERGLOW_BLESS";

/// What to do with a picture and its golden.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Check,
    /// Make the picture the golden.
    Bless,
}

impl Mode {
    /// [`Mode::Bless`] if [`BLESS_VARIABLE`] is `1`.
    pub fn from_environment() -> Self {
        Self::from_value(std::env::var_os(BLESS_VARIABLE).as_deref())
    }

    fn from_value(value: Option<&OsStr>) -> Self {
        match value {
            Some(value) if value == "1" => Self::Bless,
            _ => Self::Check,
        }
    }
}

/// What a failed check leaves: `actual.png`, `expected.png` and `difference.png` (FLIP's error in magma colours).
struct Evidence {
    actual: PathBuf,
    expected: PathBuf,
    difference: PathBuf,
}

impl Evidence {
    fn within(folder: &Path) -> Self {
        Self {
            actual: folder.join("actual.png"),
            expected: folder.join("expected.png"),
            difference: folder.join("difference.png"),
        }
    }

    /// Evidence of an earlier failure would mislead.
    fn clear(&self) -> Result<(), MetricsError> {
        for path in [&self.actual, &self.expected, &self.difference] {
            match fs::remove_file(path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(save_error(path, error));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// [`check_as`] in the mode that the environment asks for.
///
/// # Errors
/// As [`check_as`].
pub fn check(
    actual: &Image,
    golden: &Path,
    failure_folder: &Path,
    max_mean_flip: f64,
) -> Result<f64, MetricsError> {
    check_as(Mode::from_environment(), actual, golden, failure_folder, max_mean_flip)
}

/// Mean FLIP of a picture against its golden, if that is at most `max_mean_flip`.
///
/// The golden is a PNG (the picture is then rounded to 8 bits first, as it would be stored) or an EXR or `.npy` (linear, HDR-FLIP).
/// In [`Mode::Bless`] the golden is written instead and 0 returned. `failure_folder` should be the check's own: a failure leaves its
/// pictures there, and any other outcome removes those that an earlier one left.
///
/// # Errors
/// [`MetricsError::Golden`] if there is no golden, the picture has NaN or infinite pixels (these are never blessed), another size, or
/// differs by more; other errors if files cannot be read or written.
pub fn check_as(
    mode: Mode,
    actual: &Image,
    golden: &Path,
    failure_folder: &Path,
    max_mean_flip: f64,
) -> Result<f64, MetricsError> {
    let evidence = Evidence::within(failure_folder);
    evidence.clear()?;
    let count = actual.non_finite_count();
    if count > 0 {
        save_in_folder(actual, &evidence.actual)?;
        let actual = evidence.actual;
        return Err(GoldenFailure::NonFinite { count, actual }.into());
    }
    if mode == Mode::Bless {
        save_in_folder(actual, golden)?;
        return Ok(0.0);
    }
    if !golden.exists() {
        save_in_folder(actual, &evidence.actual)?;
        let (golden, actual) = (golden.to_owned(), evidence.actual);
        return Err(GoldenFailure::Missing { golden, actual }.into());
    }
    let expected = io::load(golden)?;
    if as_stored(actual, golden) == expected {
        return Ok(0.0);
    }
    judge(&as_stored(actual, golden), &expected, evidence, max_mean_flip)
}

fn judge(actual: &Image, expected: &Image, evidence: Evidence, threshold: f64) -> Result<f64, MetricsError> {
    let actual_size = (actual.width(), actual.height());
    let expected_size = (expected.width(), expected.height());
    if actual_size != expected_size {
        save_in_folder(actual, &evidence.actual)?;
        io::save(expected, &evidence.expected)?;
        return Err(GoldenFailure::Size {
            actual_size,
            expected_size,
            actual: evidence.actual,
            expected: evidence.expected,
        }
        .into());
    }
    let map = flip(actual, expected)?;
    let mean_flip = map.mean();
    if mean_flip <= threshold {
        return Ok(mean_flip);
    }
    leave(actual, expected, &map, &evidence)?;
    Err(GoldenFailure::Differs {
        mean_flip,
        max_flip: f64::from(map.max()),
        threshold,
        actual: evidence.actual,
        expected: evidence.expected,
        difference: evidence.difference,
    }
    .into())
}

fn leave(actual: &Image, expected: &Image, map: &FlipMap, evidence: &Evidence) -> Result<(), MetricsError> {
    save_in_folder(actual, &evidence.actual)?;
    io::save(expected, &evidence.expected)?;
    io::save(&map.to_image(), &evidence.difference)
}

/// The picture as its golden's format would give it back.
fn as_stored(actual: &Image, golden: &Path) -> Image {
    let png = golden.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if png { actual.rounded_to_8_bits() } else { actual.to_linear().into_owned() }
}

/// Saves a picture, making the folder first.
fn save_in_folder(image: &Image, path: &Path) -> Result<(), MetricsError> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|error| save_error(path, error))?;
    }
    io::save(image, path)
}

fn save_error(path: &Path, error: std::io::Error) -> MetricsError {
    MetricsError::Save { path: path.to_owned(), source: FormatError::Io(error) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Encoding;
    use crate::test_images as synthetic;

    struct Place {
        folder: tempfile::TempDir,
    }

    impl Place {
        fn new() -> Self {
            Self { folder: tempfile::tempdir().unwrap() }
        }

        fn golden(&self, extension: &str) -> PathBuf {
            self.folder.path().join("goldens/view").with_extension(extension)
        }

        fn failures(&self) -> PathBuf {
            self.folder.path().join("failures/view")
        }

        fn run(&self, mode: Mode, extension: &str, image: &Image) -> Result<f64, MetricsError> {
            check_as(mode, image, &self.golden(extension), &self.failures(), 0.01)
        }

        fn left(&self) -> Vec<String> {
            let Ok(entries) = fs::read_dir(self.failures()) else {
                return Vec::new();
            };
            let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
            names.sort();
            names
        }
    }

    #[test]
    fn blessed_pictures_pass_exactly() {
        for (extension, image) in [
            ("png", synthetic::stripes()),
            ("png", synthetic::hdr()),
            ("exr", synthetic::hdr()),
            ("npy", synthetic::hdr()),
        ] {
            let place = Place::new();
            place.run(Mode::Bless, extension, &image).unwrap();
            assert_eq!(place.run(Mode::Check, extension, &image).unwrap(), 0.0);
            assert!(place.left().is_empty());
        }
    }

    #[test]
    fn a_failure_leaves_three_pictures_and_names_them() {
        let place = Place::new();
        place.run(Mode::Bless, "png", &synthetic::stripes()).unwrap();
        let error = place.run(Mode::Check, "png", &synthetic::disturbed()).unwrap_err().to_string();
        let names = ["actual.png", "difference.png", "expected.png"];
        assert!(names.iter().all(|n| error.contains(n)), "{error}");
        assert_eq!(place.left(), names);
        let expected = io::load(&place.failures().join("expected.png")).unwrap();
        assert_eq!(expected, synthetic::stripes().rounded_to_8_bits());

        place.run(Mode::Check, "png", &synthetic::stripes()).unwrap();
        assert!(place.left().is_empty());
    }

    #[test]
    fn a_small_difference_passes_with_its_mean() {
        let place = Place::new();
        let golden = synthetic::stripes();
        place.run(Mode::Bless, "png", &golden).unwrap();
        let mut other = golden.clone();
        other.pixels_mut()[1000] = [0.0; 3];
        let mean = place.run(Mode::Check, "png", &other).unwrap();
        assert!(mean > 0.0 && mean < 0.01);
    }

    #[test]
    fn a_missing_golden_says_how_to_bless() {
        let place = Place::new();
        let error = place.run(Mode::Check, "png", &synthetic::stripes()).unwrap_err();
        assert!(error.to_string().contains(BLESS_VARIABLE));
        assert_eq!(place.left(), ["actual.png"]);
    }

    #[test]
    fn other_sizes_and_nan_fail() {
        let place = Place::new();
        place.run(Mode::Bless, "exr", &synthetic::hdr()).unwrap();
        let small = Image::from_fn(3, 3, Encoding::Linear, |_, _| [0.0; 3]).unwrap();
        assert!(matches!(
            place.run(Mode::Check, "exr", &small),
            Err(MetricsError::Golden(GoldenFailure::Size { .. }))
        ));
        let mut nan = synthetic::hdr();
        nan.pixels_mut()[7] = [f32::NAN; 3];
        for mode in [Mode::Check, Mode::Bless] {
            assert!(matches!(
                place.run(mode, "exr", &nan),
                Err(MetricsError::Golden(GoldenFailure::NonFinite { count: 1, .. }))
            ));
        }
    }

    #[test]
    fn only_one_blesses() {
        assert_eq!(Mode::from_value(Some(OsStr::new("1"))), Mode::Bless);
        assert_eq!(Mode::from_value(Some(OsStr::new("0"))), Mode::Check);
        assert_eq!(Mode::from_value(None), Mode::Check);
    }
}
