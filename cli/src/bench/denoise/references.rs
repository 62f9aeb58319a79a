//! Converged pictures that frames are held against: those of an archive, or made by reference mode and kept in a folder.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use afterglow_metrics::{Image, io};
use afterglow_npy::{Archive, Array};

use super::player::Player;
use super::sequence::{self, Kind, Sequence};
use crate::failure::Failure;

/// Bytes of an archive, and of an array in it.
const MOST_BYTES: u64 = 1 << 30;
/// What stands still for so many frames is worth a reference of its own, whatever its frame's number.
const LONG: usize = 4;
/// Part of the names of files: another number where pictures of reference mode are no more the same.
const EDITION: u32 = 1;

/// A converged picture.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Linear light.
    pub mean: Image,
    /// Of each pixel and channel, if it is known.
    pub standard_error: Option<Image>,
}

/// Those of a sequence.
#[derive(Debug, Default)]
pub struct References {
    /// Of each frame of the sequence, the frame whose picture it shares.
    of_frame: Vec<Option<usize>>,
    pictures: BTreeMap<usize, Reference>,
}

impl References {
    /// The picture that a frame should be, and the number of the frame that it was made of.
    pub fn of(&self, frame: usize) -> Option<(usize, &Reference)> {
        let number = (*self.of_frame.get(frame)?)?;
        Some((number, self.pictures.get(&number)?))
    }

    /// Pictures that tests have made, by the frames they are of.
    #[cfg(test)]
    pub fn known(of_frame: Vec<Option<usize>>, pictures: Vec<(usize, Image)>) -> References {
        let reference = |mean| Reference { mean, standard_error: None };
        let pictures = pictures.into_iter().map(|(frame, picture)| (frame, reference(picture)));
        References { of_frame, pictures: pictures.collect() }
    }

    /// Those of an archive with `reference_of_frame` (frames; -1: none), `full_NNNN` and, where they are known, `se_NNNN`, that
    /// the frames `played` need.
    pub fn load(path: &Path, sequence: &Sequence, played: &Range<usize>) -> Result<References, Failure> {
        let refused = |reason: String| Failure::input(path, reason);
        let archive = Archive::open(path, MOST_BYTES).map_err(|error| refused(error.to_string()))?;
        let names: Vec<&str> = archive.names().collect();
        let file = archive.file("reference_of_frame").map_err(|error| refused(error.to_string()))?;
        let numbers = Array::parse(&file).and_then(|array| array.integers());
        let numbers = numbers.map_err(|error| refused(error.to_string()))?;
        let length = sequence.scene.frames.len();
        if numbers.len() != length {
            let reason = format!("is of {} frames, and {} has {length}", numbers.len(), sequence.name);
            return Err(refused(reason));
        }
        let of_frame: Vec<Option<usize>> =
            numbers.iter().map(|&number| usize::try_from(number).ok()).collect();
        let read = |name: String| {
            let file = archive.file(&name).map_err(|error| refused(error.to_string()))?;
            let image = io::npy::read(&mut file.as_slice());
            let image = image.map_err(|error| refused(format!("{name}: {error}")))?;
            sized(image, sequence).map_err(|reason| refused(format!("{name} {reason}")))
        };
        let mut pictures = BTreeMap::new();
        for &number in of_frame[played.clone()].iter().flatten() {
            if pictures.contains_key(&number) {
                continue;
            }
            let error = format!("se_{number:04}");
            let standard_error = names.contains(&error.as_str()).then(|| read(error)).transpose()?;
            pictures.insert(number, Reference { mean: read(format!("full_{number:04}"))?, standard_error });
        }
        Ok(References { of_frame, pictures })
    }

    /// Our own, of every so many frames and of each that is shown for long.
    pub fn make(
        player: &Player,
        sequence: &Sequence,
        played: &Range<usize>,
        how: &Making,
        mut progress: impl FnMut(f64),
    ) -> Result<References, Failure> {
        let of_frame = chosen(sequence, how.every);
        let mut references = References { of_frame, pictures: BTreeMap::new() };
        let mut needed: Vec<usize> = references.of_frame[played.clone()].iter().flatten().copied().collect();
        needed.sort_unstable();
        needed.dedup();
        for (done, &number) in needed.iter().enumerate() {
            progress(done as f64 / needed.len() as f64);
            let reference = how.reference(player, sequence, number)?;
            references.pictures.insert(number, reference);
        }
        Ok(references)
    }
}

/// How references are made.
#[derive(Debug)]
pub struct Making {
    /// Samples a pixel.
    pub samples: u32,
    /// Of moving frames every so many get one.
    pub every: usize,
    /// Where they are kept.
    pub cache: PathBuf,
}

impl Making {
    /// That of a frame, from the folder if it is there.
    fn reference(&self, player: &Player, sequence: &Sequence, number: usize) -> Result<Reference, Failure> {
        let name = format!("{:016x}-{}spp-v{EDITION}", sequence.content, self.samples);
        let folder = self.cache.join(name);
        let paths = ["full", "se"].map(|kind| folder.join(format!("{kind}_{number:04}.npy")));
        let kept = |path: &Path| io::load(path).ok().and_then(|image| sized(image, sequence).ok());
        if let (Some(mean), Some(error)) = (kept(&paths[0]), kept(&paths[1])) {
            return Ok(Reference { mean, standard_error: Some(error) });
        }
        std::fs::create_dir_all(&folder).map_err(|error| Failure::output(&folder, error))?;
        let made = player.reference(&sequence.stage, number, self.samples)?;
        let pictures = [Some(&made.mean), made.standard_error.as_ref()];
        for (path, picture) in paths.iter().zip(pictures) {
            picture.map_or(Ok(()), |picture| write_whole(path, picture))?;
        }
        Ok(made)
    }
}

/// Writes a picture so that there is all of it or nothing: a part of one is not to be taken for a reference.
fn write_whole(path: &Path, picture: &Image) -> Result<(), Failure> {
    let part = path.with_extension("part.npy");
    crate::output::write_image(&part, picture)?;
    std::fs::rename(&part, path).map_err(|error| Failure::output(path, error))
}

/// A picture, if it is of the sequence's size.
fn sized(image: Image, sequence: &Sequence) -> Result<Image, String> {
    let [width, height] = sequence.scene.size.map(|side| side as usize);
    match (image.width(), image.height()) == (width, height) {
        true => Ok(image),
        false => Err(format!("has {}x{} pixels, not {width}x{height}", image.width(), image.height())),
    }
}

/// Of each frame the one whose picture it shares, if that is to be made.
fn chosen(sequence: &Sequence, every: usize) -> Vec<Option<usize>> {
    let frames = &sequence.scene.frames;
    let same = sequence::same_frames(frames);
    let kinds = sequence::kinds(frames, &(0..frames.len()));
    let length_of = |first: usize| same.iter().filter(|other| **other == first).count();
    let wanted = |&first: &usize| {
        first % every == 0 || length_of(first) >= LONG || kinds.get(first) == Some(&Kind::Lighting)
    };
    same.iter().map(|first| Some(*first).filter(wanted)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_share_pictures_and_long_ones_have_one() {
        for sequence in Sequence::own().unwrap() {
            let of_frame = chosen(&sequence, 4);
            let same = sequence::same_frames(&sequence.scene.frames);
            assert_eq!((of_frame[0], of_frame[1], of_frame[4]), (Some(0), None, Some(4)));
            for stretch in sequence::stretches(&same).into_iter().filter(|stretch| stretch.len() >= LONG) {
                assert!(stretch.clone().all(|frame| of_frame[frame] == Some(stretch.start)), "{stretch:?}");
            }
        }
    }
}
