//! Where our libGL is, and `afterglow libdir`, which prints it.

use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Names under which programs look for OpenGL; all of them are our one library.
pub const NAMES: [&str; 4] = ["libGL.so.1", "libGL.so", "libOpenGL.so.0", "libGLX.so.0"];

/// Runs `libdir`.
pub fn run() -> Result<(), Failure> {
    println!("{}", find()?.display());
    Ok(())
}

/// The folder that holds the library under all its names.
///
/// An installed program has it in `../lib/afterglow`, one that was just built beside it, in `lib`.
pub fn find() -> Result<PathBuf, Failure> {
    let program = std::env::current_exe().and_then(|path| path.canonicalize());
    let program =
        program.map_err(|error| Failure::Check(format!("cannot tell where this program is: {error}")))?;
    let folder = program.parent().unwrap_or(Path::new("."));
    let places = [folder.join("../lib/afterglow"), folder.join("lib")];
    let found = places.iter().find(|place| place.join(NAMES[0]).is_file());
    match found.map(|place| place.canonicalize()) {
        Some(Ok(place)) => Ok(place),
        _ => Err(Failure::Check(format!(
            "there is no {} in {} or {}; build it with ./x build",
            NAMES[0],
            places[0].display(),
            places[1].display()
        ))),
    }
}
