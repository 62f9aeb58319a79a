//! Pictures to be looked at: frames as they would be shown, and sheets of a part of successive ones beside each other.

use std::ops::Range;
use std::path::{Path, PathBuf};

use afterglow_metrics::{Encoding, FormatError, Image, side_by_side};

use super::judge::Judge;
use super::references::References;
use crate::failure::Failure;
use crate::output;

/// Frames on a sheet.
const COLUMNS: usize = 6;
/// Side of the part that sheets show, pixels of a frame.
const PART: usize = 96;
/// How many times as large it is shown.
const SCALE: usize = 2;
/// Between pictures on a sheet, pixels.
const GAP: usize = 4;

/// Where the pictures of a sequence are written.
pub struct Album {
    folder: PathBuf,
    first: usize,
    /// What the rows of sheets show, from the top.
    rows: Vec<Vec<Option<Image>>>,
}

impl Album {
    /// In a folder, from a frame on: `reference` first, for frames that have one.
    pub fn new(folder: PathBuf, played: &Range<usize>, references: &References) -> Result<Album, Failure> {
        let mut album = Album { folder, first: played.start, rows: Vec::new() };
        let pictures = played.clone().map(|frame| references.of(frame).map(|(_, it)| it.mean.clone()));
        album.add("reference", pictures.collect())?;
        Ok(album)
    }

    /// Writes a denoiser's pictures, one a frame.
    pub fn add(&mut self, name: &str, pictures: Vec<Option<Image>>) -> Result<(), Failure> {
        let folder = self.folder.join(name);
        make(&folder)?;
        for (frame, picture) in (self.first..).zip(&pictures) {
            if let Some(picture) = picture {
                output::write_image(&folder.join(format!("frame-{frame:06}.png")), picture)?;
            }
        }
        self.rows.push(pictures);
        Ok(())
    }

    /// Writes the sheets: each has a row a denoiser, and shows the surroundings of what is uncovered in its frames.
    pub fn write_sheets(&self, judge: &Judge<'_>) -> Result<(), Failure> {
        let count = self.rows.first().map_or(0, Vec::len);
        for start in (0..count).step_by(COLUMNS) {
            let offsets = start..(start + COLUMNS).min(count);
            let (first, last) = (self.first + start, self.first + offsets.end - 1);
            let middle = judge.middle_of_uncovered(first..last + 1);
            let path = self.folder.join(format!("sheet-{first:06}-{last:06}.png"));
            let sheet = self.sheet(offsets, middle);
            let sheet = sheet.map_err(|error| Failure::output(&path, std::io::Error::other(error)))?;
            output::write_image(&path, &sheet)?;
        }
        Ok(())
    }

    fn sheet(
        &self,
        offsets: Range<usize>,
        middle: Option<[usize; 2]>,
    ) -> Result<Image, Box<dyn std::error::Error + Send + Sync>> {
        let mut rows = Vec::new();
        for row in &self.rows {
            let parts: Result<Vec<Image>, FormatError> =
                row[offsets.clone()].iter().map(|picture| part(picture.as_ref(), middle)).collect();
            rows.push(side_by_side(&parts?.iter().collect::<Vec<_>>(), GAP)?);
        }
        Ok(stacked(&rows)?)
    }
}

/// The part of a picture about its middle, or about another point, enlarged; grey where there is no picture.
fn part(picture: Option<&Image>, middle: Option<[usize; 2]>) -> Result<Image, FormatError> {
    let Some(picture) = picture else {
        return Image::from_fn(PART * SCALE, PART * SCALE, Encoding::Srgb, |_, _| [0.5; 3]);
    };
    let size = [picture.width(), picture.height()];
    let sides = size.map(|side| side.min(PART));
    let middle = middle.unwrap_or(size.map(|side| side / 2));
    let start = [0, 1].map(|axis| middle[axis].saturating_sub(sides[axis] / 2).min(size[axis] - sides[axis]));
    Image::from_fn(sides[0] * SCALE, sides[1] * SCALE, picture.encoding(), |x, y| {
        picture.pixel(start[0] + x / SCALE, start[1] + y / SCALE)
    })
}

/// Display values of pictures below each other, left sides aligned.
fn stacked(rows: &[Image]) -> Result<Image, FormatError> {
    let width = rows.iter().map(Image::width).max().unwrap_or(0);
    let mut pixels = Vec::new();
    for (number, row) in rows.iter().enumerate() {
        if number > 0 {
            pixels.resize(pixels.len() + width * GAP, [1.0; 3]);
        }
        for line in row.to_srgb().pixels().chunks_exact(row.width()) {
            pixels.extend_from_slice(line);
            pixels.resize(pixels.len() + width - line.len(), [1.0; 3]);
        }
    }
    Image::new(width, pixels.len().checked_div(width).unwrap_or(0), Encoding::Srgb, pixels)
}

fn make(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::output(folder, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_stay_within_the_picture() {
        let picture = Image::from_fn(200, 100, Encoding::Linear, |x, y| [x as f32, y as f32, 0.0]).unwrap();
        let corner = |middle| {
            let part = part(Some(&picture), middle).unwrap();
            assert_eq!((part.width(), part.height()), (PART * SCALE, PART * SCALE));
            part.pixel(0, 0)
        };
        assert_eq!(corner(None), [52.0, 2.0, 0.0]);
        assert_eq!(corner(Some([0, 0])), [0.0, 0.0, 0.0]);
        assert_eq!(corner(Some([199, 99])), [104.0, 4.0, 0.0]);
        assert_eq!(part(None, None).unwrap().pixel(0, 0), [0.5; 3]);
        let small = Image::from_fn(3, 2, Encoding::Srgb, |_, _| [0.0; 3]).unwrap();
        assert_eq!(part(Some(&small), Some([2, 1])).unwrap().width(), 3 * SCALE);
    }

    #[test]
    fn rows_are_below_each_other() {
        let row = |width, value| Image::from_fn(width, 1, Encoding::Srgb, |_, _| [value; 3]).unwrap();
        let sheet = stacked(&[row(2, 0.0), row(1, 0.25)]).unwrap();
        assert_eq!((sheet.width(), sheet.height()), (2, 2 + GAP));
        assert_eq!((sheet.pixel(0, 1 + GAP), sheet.pixel(1, 1 + GAP)), ([0.25; 3], [1.0; 3]));
    }
}
