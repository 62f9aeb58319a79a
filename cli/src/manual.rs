//! `afterglow manual`: writes the manual pages, made of what the program says of itself.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, Command};
use clap_mangen::roff::{Roff, bold, roman};
use clap_mangen::{Man, generate_to};

use crate::failure::Failure;

/// Arguments of `manual`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Folder to write the pages to; it is made if it is not there
    folder: PathBuf,
}

/// Places that the program reads or writes without being told.
const FILES: [(&str, &str); 7] = [
    ("../lib/afterglow/libGL.so.1", "The library that games load, seen from the program's own folder."),
    (
        "$XDG_CONFIG_HOME/afterglow/config.toml",
        "Options by name (mode, spp, hud, [keys] ...) for programs that are played. It is looked at again while they are.",
    ),
    (
        "$XDG_CACHE_HOME/afterglow/pipelines",
        "Compiled shaders of each device. May be removed; the next start takes longer then.",
    ),
    (
        "$XDG_CACHE_HOME/afterglow/worlds",
        "What is remembered of each program's worlds, at most 64 MiB a program and 512 MiB of all. May be removed.",
    ),
    (
        "$XDG_CACHE_HOME/afterglow/lights",
        "Light sources recovered from baked light, at most 64 MiB. May be removed.",
    ),
    (
        "$XDG_CACHE_HOME/afterglow/references",
        "Converged pictures that bench denoise has made. May be removed; it makes them again then, which takes long.",
    ),
    (
        "$XDG_CACHE_HOME/afterglow/lavapipe",
        "A software driver that ./x setup puts there for --device lavapipe.",
    ),
];

const EXIT_CODES: [(&str, &str); 5] = [
    ("0", "All went well."),
    ("1", "A comparison or a check failed, or a file could not be written."),
    ("2", "Wrong usage."),
    ("3", "There is no usable Vulkan device."),
    ("4", "Input is unreadable or damaged; what was readable has been done."),
];

const VARIABLES: [(&str, &str); 5] = [
    (
        "AFTERGLOW_MODE, AFTERGLOW_DEVICE, ...",
        "Every option of a command has a variable, which its page names.",
    ),
    (
        "AFTERGLOW_KEYS_MODE, _VIEW, _PRESET, _SCREENSHOT, _HUD",
        "Keys that a player presses, such as Ctrl+Shift+Home; none for none.",
    ),
    (
        "AFTERGLOW_LOG",
        "What the library tells on standard error: error, warn (if absent), info, debug or trace.",
    ),
    ("AFTERGLOW_NOOP", "The library draws nothing, to measure what calls cost a program."),
    ("LD_LIBRARY_PATH", "A program that finds the library's folder there needs no `afterglow run`."),
];

/// Runs `manual`.
pub fn run(arguments: &Arguments, command: Command) -> Result<(), Failure> {
    let folder = &arguments.folder;
    let failed = |source| Failure::output(folder, source);
    fs::create_dir_all(folder).map_err(failed)?;
    generate_to(command.clone(), folder).map_err(failed)?;
    add_sections(command, &folder.join("afterglow.1")).map_err(failed)
}

/// Appends to the main page what no single option tells.
fn add_sections(command: Command, page: &Path) -> std::io::Result<()> {
    let mut text = Vec::new();
    Man::new(command).render(&mut text)?;
    let mut more = Roff::new();
    for (title, entries) in
        [("ENVIRONMENT", &VARIABLES[..]), ("FILES", &FILES[..]), ("EXIT STATUS", &EXIT_CODES[..])]
    {
        more.control("SH", [title]);
        for (name, meaning) in entries {
            more.control("TP", []).text([bold(*name)]).text([roman(*meaning)]);
        }
    }
    more.to_writer(&mut text)?;
    fs::write(page, text)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn every_command_has_a_page_and_the_main_one_tells_more() {
        let folder = std::env::temp_dir().join(format!("afterglow-manual-{}", std::process::id()));
        run(&Arguments { folder: folder.clone() }, crate::Arguments::command()).unwrap();
        let page = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
        assert!(page("afterglow.1").contains("EXIT STATUS") && page("afterglow.1").contains("AFTERGLOW_LOG"));
        assert!(page("afterglow-run.1").contains("AFTERGLOW_RECORD"));
        assert!(page("afterglow-replay.1").contains("frames"));
        fs::remove_dir_all(folder).unwrap();
    }
}
