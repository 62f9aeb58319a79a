//! JSON for `--json FILE` (`-` is standard output).

use std::path::Path;

use crate::failure::Failure;

/// Writes `value` as JSON.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|error| Failure::output(path, std::io::Error::other(error)))?;
    if path == Path::new("-") {
        println!("{text}");
        return Ok(());
    }
    std::fs::write(path, text + "\n").map_err(|error| Failure::output(path, error))
}

/// Writes a picture of RGBA bytes, top row first.
pub fn write_picture(path: &Path, size: (u32, u32), rgba: &[u8]) -> Result<(), Failure> {
    let failed =
        |error: &dyn std::fmt::Display| Failure::output(path, std::io::Error::other(error.to_string()));
    let image = afterglow_metrics::Image::from_rgba8(size.0 as usize, size.1 as usize, rgba)
        .map_err(|error| failed(&error))?;
    afterglow_metrics::io::save(&image, path).map_err(|error| failed(&error))
}
