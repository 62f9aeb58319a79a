//! Intel's Open Image Denoise on the same noise, through Python: what a large network makes of each picture by itself.

use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};

use afterglow_metrics::{Encoding, Image, io};
use afterglow_render::Paint;
use tempfile::TempDir;

use super::player::{Pictures, Player};
use super::sequence::Sequence;
use crate::failure::Failure;
use crate::output;

/// What is run.
const SCRIPT: &str = include_str!("../../../../tests/denoise/oidn");

/// Whether Python finds what is needed; else why not.
pub fn check(python: &Path) -> Result<(), String> {
    let found = Command::new(python).args(["-c", "import numpy, pyoidn"]).stdin(Stdio::null()).output();
    match found {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(last_line(&output.stderr)),
        Err(error) => Err(format!("{}: {error}", python.display())),
    }
}

/// Plays frames without history, and denoises them with the albedo and the normals of what is seen.
pub fn play(
    player: &Player,
    sequence: &Sequence,
    frames: &Range<usize>,
    python: &Path,
    progress: impl FnMut(),
) -> Result<Pictures, Failure> {
    let folder = TempDir::new().map_err(|error| Failure::output(&std::env::temp_dir(), error))?;
    let path = |kind: &str, frame: usize| folder.path().join(format!("{kind}-{frame:06}.npy"));
    let write = |kind: &str, pictures: &[Image]| {
        let mut numbered = frames.clone().zip(pictures);
        numbered.try_for_each(|(frame, picture)| output::write_image(&path(kind, frame), picture))
    };
    write("color", &player.play_noisy(&sequence.stage, frames, progress)?)?;
    write("albedo", &player.play_painted(&sequence.stage, frames, Paint::Albedo)?)?;
    write("normal", &as_numbers(player.play_painted(&sequence.stage, frames, Paint::Normal)?)?)?;

    let run = Command::new(python).args(["-c", SCRIPT]).arg(folder.path()).stdin(Stdio::null()).output();
    match run {
        Ok(output) if output.status.success() => {}
        Ok(output) => return Err(Failure::Check(format!("oidn: {}", last_line(&output.stderr)))),
        Err(error) => return Err(Failure::Check(format!("oidn: {}: {error}", python.display()))),
    }
    let read = |frame| {
        let path = path("denoised", frame);
        let picture = io::load(&path).map_err(|error| Failure::input(&path, error))?;
        let [width, height] = sequence.scene.size.map(|side| side as usize);
        match (picture.width(), picture.height()) == (width, height) {
            true => Ok(picture),
            false => Err(Failure::input(&path, "of another size")),
        }
    };
    frames.clone().map(read).collect()
}

/// Pictures whose pixels are no display values but numbers.
fn as_numbers(pictures: Pictures) -> Result<Pictures, Failure> {
    let converted = |picture: Image| {
        let pixels = picture.pixels().to_vec();
        let image = Image::new(picture.width(), picture.height(), Encoding::Linear, pixels);
        image.map_err(|error| Failure::Check(error.to_string()))
    };
    pictures.into_iter().map(converted).collect()
}

fn last_line(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    text.lines().rfind(|line| !line.trim().is_empty()).unwrap_or("it failed").trim().to_owned()
}
