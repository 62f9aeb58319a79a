//! What commands write: text, JSON for `--json FILE` (`-` is standard output), pictures.

use std::io::{self, BufWriter, ErrorKind, Stdout, Write};
use std::path::Path;

use afterglow_metrics::Image;

use crate::failure::Failure;

/// Writes text to standard output. That whoever reads has gone away (`| head`) is no failure.
pub fn print(write: impl FnOnce(&mut BufWriter<Stdout>) -> io::Result<()>) -> Result<(), Failure> {
    let mut out = BufWriter::new(io::stdout());
    match write(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::output(Path::new("standard output"), error))
        }
        _ => {
            // What a closed pipe left behind is not to be written again when this is dropped.
            let _ = out.into_parts();
            Ok(())
        }
    }
}

/// Writes `value` as JSON.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|error| Failure::output(path, std::io::Error::other(error)))?;
    if path == Path::new("-") {
        return print(|out| writeln!(out, "{text}"));
    }
    std::fs::write(path, text + "\n").map_err(|error| Failure::output(path, error))
}

/// Writes a picture of RGBA bytes, top row first.
pub fn write_picture(path: &Path, size: (u32, u32), rgba: &[u8]) -> Result<(), Failure> {
    let image = Image::from_rgba8(size.0 as usize, size.1 as usize, rgba)
        .map_err(|error| Failure::output(path, io::Error::other(error)))?;
    write_image(path, &image)
}

/// Writes a picture in the format that its name ends in.
pub fn write_image(path: &Path, image: &Image) -> Result<(), Failure> {
    afterglow_metrics::io::save(image, path).map_err(|error| Failure::output(path, io::Error::other(error)))
}
