//! A scene's sequence: which frames show the same, and what changes between them.

use std::ops::Range;
use std::path::Path;

use afterglow_scene_file::{SceneFile, SequenceFrame, Stage};
use serde::Serialize;
use xxhash_rust::xxh3::xxh3_64;

use crate::failure::Failure;

/// Scenes that come with the program.
const OWN: [(&str, &[u8]); 2] = [
    ("glossy.json", include_bytes!("../../../../tests/denoise/glossy.json")),
    ("lamps.json", include_bytes!("../../../../tests/denoise/lamps.json")),
];

/// Frames of a sequence, at most: each is compared with those before it.
const MOST_FRAMES: usize = 10_000;

/// What a frame is to a denoiser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The first that is played: there is no history.
    First,
    /// The camera or an object is not where it was.
    Moving,
    /// The same as the frame before.
    Still,
    /// The lights have changed, or the same as a frame in which they have.
    Lighting,
}

/// A scene that is played, with its frames.
#[derive(Debug)]
pub struct Sequence {
    /// As its file has it, or the file's name.
    pub name: String,
    /// The scene.
    pub scene: SceneFile,
    /// The same, ready to be drawn.
    pub stage: Stage,
    /// Hash of the file.
    pub content: u64,
}

impl Sequence {
    /// Those that come with the program.
    pub fn own() -> Result<Vec<Sequence>, Failure> {
        let load = |(name, bytes): (&str, &[u8])| {
            let path = Path::new(name);
            let scene =
                afterglow_scene_file::parse(bytes).map_err(|problem| Failure::input(path, problem))?;
            Sequence::new(path, bytes, scene)
        };
        OWN.into_iter().map(load).collect()
    }

    /// That of a file.
    pub fn load(path: &Path) -> Result<Sequence, Failure> {
        let scene =
            afterglow_scene_file::load(path).map_err(|error| Failure::input(&error.path, error.problem))?;
        let bytes = std::fs::read(path).map_err(|error| Failure::input(path, error))?;
        Sequence::new(path, &bytes, scene)
    }

    /// Of a scene that no file has.
    #[cfg(test)]
    pub fn of(scene: SceneFile) -> Sequence {
        Sequence::new(Path::new("test.json"), &[], scene).unwrap()
    }

    fn new(path: &Path, bytes: &[u8], scene: SceneFile) -> Result<Sequence, Failure> {
        if scene.frames.is_empty() {
            return Err(Failure::input(path, "the scene is a still: it has no sequence of frames"));
        }
        if scene.frames.len() > MOST_FRAMES {
            return Err(Failure::input(path, format!("has more than {MOST_FRAMES} frames")));
        }
        let stage = Stage::new(scene.clone()).map_err(|problem| Failure::input(path, problem))?;
        let name = match scene.name.as_str() {
            "" => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            name => name.into(),
        };
        Ok(Sequence { name, scene, stage, content: xxh3_64(bytes) })
    }

    /// Those of its frames that are asked for.
    pub fn played(&self, asked: Option<&Range<u64>>) -> Result<Range<usize>, Failure> {
        let length = self.scene.frames.len();
        let Some(asked) = asked else { return Ok(0..length) };
        let within = |frame: u64| usize::try_from(frame).map_or(length, |frame| frame.min(length));
        match within(asked.start)..within(asked.end) {
            range if range.is_empty() => {
                Err(Failure::Usage(format!("{} has {length} frames, none of those asked for", self.name)))
            }
            range => Ok(range),
        }
    }
}

/// For each frame the first that shows exactly the same.
pub fn same_frames(frames: &[SequenceFrame]) -> Vec<usize> {
    let first = |frame: &SequenceFrame| frames.iter().position(|other| other == frame);
    frames.iter().enumerate().map(|(index, frame)| first(frame).unwrap_or(index)).collect()
}

/// Where frames that show the same follow each other: the longest stretches, in order.
pub fn stretches(same: &[usize]) -> Vec<Range<usize>> {
    let starts: Vec<usize> =
        (0..same.len()).filter(|&index| index == 0 || same[index] != same[index - 1]).collect();
    let ends = starts.iter().skip(1).copied().chain([same.len()]);
    starts.iter().copied().zip(ends).map(|(start, end)| start..end).collect()
}

/// Whether nothing but lights differs from the frame before.
pub fn is_light_step(frames: &[SequenceFrame], index: usize) -> bool {
    let Some(before) = index.checked_sub(1) else { return false };
    let (before, frame) = (&frames[before], &frames[index]);
    before != frame && before.view == frame.view && before.transforms == frame.transforms
}

/// What each of the frames `played` is.
pub fn kinds(frames: &[SequenceFrame], played: &Range<usize>) -> Vec<Kind> {
    let mut kinds: Vec<Kind> = Vec::new();
    for index in played.clone() {
        let kind = match kinds.last() {
            None => Kind::First,
            Some(_) if is_light_step(frames, index) => Kind::Lighting,
            Some(_) if frames[index] != frames[index - 1] => Kind::Moving,
            Some(Kind::Lighting) => Kind::Lighting,
            Some(_) => Kind::Still,
        };
        kinds.push(kind);
    }
    kinds
}

#[cfg(test)]
pub mod tests {
    use afterglow_scene_file::View;
    use glam::{DMat4, DVec3};

    use super::*;

    /// A frame with the camera, the object 0 and all lights as told.
    pub fn frame(camera: f64, object: f64, light: f64) -> SequenceFrame {
        let cotangent = 1.0 / 0.5f64.tan();
        let at = |x| DMat4::from_translation(DVec3::new(x, 0.0, 0.0));
        SequenceFrame {
            view: View {
                modelview: DMat4::from_translation(DVec3::new(-camera, 0.0, -5.0)),
                projection: DMat4::from_cols_array(&[
                    cotangent, 0.0, 0.0, 0.0, 0.0, cotangent, 0.0, 0.0, 0.0, 0.0, -1.002, -1.0, 0.0, 0.0,
                    -0.2002, 0.0,
                ]),
            },
            transforms: vec![(0, at(object))],
            emission_scales: Vec::new(),
            light_scales: Vec::new(),
            sphere_light_scale: light,
            sun_scale: 1.0,
            sky_scale: 1.0,
        }
    }

    #[test]
    fn frames_are_told_by_what_changes() {
        let frames = [
            (0.0, 0.0, 1.0),
            (1.0, 0.0, 1.0),
            (1.0, 0.0, 1.0),
            (1.0, 2.0, 1.0),
            (1.0, 2.0, 0.1),
            (1.0, 2.0, 0.1),
        ]
        .map(|(camera, object, light)| frame(camera, object, light));
        let same = same_frames(&frames);
        assert_eq!(same, [0, 1, 1, 3, 4, 4]);
        assert_eq!(stretches(&same), [0..1, 1..3, 3..4, 4..6]);
        use Kind::{First, Lighting, Moving, Still};
        assert_eq!(kinds(&frames, &(0..6)), [First, Moving, Still, Moving, Lighting, Lighting]);
        assert_eq!(kinds(&frames, &(2..4)), [First, Moving]);
    }

    #[test]
    fn the_own_sequences_move_rest_and_have_a_light_step() {
        for sequence in Sequence::own().unwrap() {
            let frames = &sequence.scene.frames;
            let kinds = kinds(frames, &(0..frames.len()));
            for kind in [Kind::Moving, Kind::Still, Kind::Lighting] {
                assert!(kinds.contains(&kind), "{} {kind:?}", sequence.name);
            }
            assert!((32..=48).contains(&frames.len()));
        }
    }
}
