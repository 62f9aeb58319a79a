//! `afterglow run`: starts a program with our libGL in place of the system's.

use std::ffi::{OsStr, OsString};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, io};

use afterglow_gpu::Gpu;
use afterglow_scene::ProfileChoice;
use clap::Args;

use crate::failure::Failure;
use crate::libdir;
use crate::options::{
    Baked, DeviceArguments, ImageArguments, KeepArguments, LightArguments, Mode, ProfileArguments, Sky,
};

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// How frames become pictures. Unless it is said: by rays, and as OpenGL defines where rays turn out too slow to play
    #[arg(long, value_enum, env = "AFTERGLOW_MODE")]
    mode: Option<Mode>,
    /// Samples a pixel and frame; 1 unless it or a preset is said (pathtrace)
    #[arg(long, value_name = "N", env = "AFTERGLOW_SPP", value_parser = clap::value_parser!(u32).range(1..=65536))]
    spp: Option<u32>,
    #[command(flatten)]
    light: LightArguments,
    /// Seed of the random numbers; 0 unless it is said
    #[arg(long, value_name = "N", env = "AFTERGLOW_SEED")]
    seed: Option<u32>,
    /// Remember so many MiB of the world that is not drawn, for rays to meet; 0 for none, and 256 unless it is said (pathtrace)
    #[arg(long, value_name = "MIB", env = "AFTERGLOW_MEMORY")]
    memory: Option<u32>,
    /// What becomes of light that is baked into the world, where its sources are found; `auto` unless it is said
    #[arg(long, value_enum, value_name = "HOW", env = "AFTERGLOW_BAKED")]
    baked: Option<Baked>,
    /// What rays see of the sky that the program draws; `cube` unless it is said
    #[arg(long, value_enum, value_name = "WHAT", env = "AFTERGLOW_SKY")]
    sky: Option<Sky>,
    #[command(flatten)]
    images: ImageArguments,
    #[command(flatten)]
    keep: KeepArguments,
    /// Record what the program calls, in apitrace's format. Further processes of the program record into FILE.1.trace
    /// and so on
    #[arg(long, value_name = "FILE", env = "AFTERGLOW_RECORD")]
    record: Option<PathBuf>,
    /// Configuration (TOML), or `none`; its keys are options' names, and what is said here or in the environment counts
    /// more. The default is afterglow/config.toml in the user's folder of configurations, if it is there. What of it changes
    /// while the program plays holds from then on
    #[arg(long, value_name = "FILE", env = "AFTERGLOW_CONFIG")]
    config: Option<PathBuf>,
    /// Listen to keys while the program plays, without taking them from it: yes, as is the default, or no. Ctrl+Shift and
    /// Home: next mode, PageDown: next view, PageUp: next preset, Insert: screenshot, End: figures. A configuration may name others
    #[arg(long, value_name = "BOOL", env = "AFTERGLOW_KEYS", value_parser = clap::builder::BoolishValueParser::new())]
    keys: Option<bool>,
    /// Folder for screenshots; the default is $XDG_PICTURES_DIR, or $HOME
    #[arg(long, value_name = "DIR", env = "AFTERGLOW_SCREENSHOTS")]
    screenshots: Option<PathBuf>,
    /// Show figures in the window: frames a second, time of a frame, latency from buffer swap to picture, and the passes that
    /// take the device longest
    #[arg(long, env = "AFTERGLOW_HUD", value_parser = clap::builder::BoolishValueParser::new())]
    hud: bool,
    #[command(flatten)]
    profile: ProfileArguments,
    #[command(flatten)]
    device: DeviceArguments,
    /// The program and its arguments
    #[arg(required = true, trailing_var_arg = true, allow_hyphen_values = true, value_name = "COMMAND")]
    command: Vec<OsString>,
}

/// Runs `run`. Comes back only if the program could not be started: it takes this one's place, so that its exit code
/// and its signals are its own.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (program, rest) = arguments.command.split_first().expect("clap requires a command");
    let mut command = Command::new(program);
    command.args(rest);
    match Gpu::new(&arguments.device.gpu_options()) {
        Ok(gpu) => {
            drop(gpu);
            set_up(&mut command, arguments, &libdir::find()?);
            if let Some(choice) = &arguments.profile.profile {
                // A program starts only with a profile that can be read.
                arguments.profile.load(None)?;
                command.env("AFTERGLOW_PROFILE", profile(choice)?);
            }
            if let Some(folder) = arguments.images.folder(None)? {
                command.env("AFTERGLOW_REPLACE_IMAGES", folder);
            }
            if let Some(path) = &arguments.config {
                command.env("AFTERGLOW_CONFIG", config(path)?);
            }
            if let Some(folder) = &arguments.screenshots {
                let absolute = std::path::absolute(folder);
                command
                    .env("AFTERGLOW_SCREENSHOTS", absolute.map_err(|error| Failure::output(folder, error))?);
            }
            if let Some(path) = &arguments.record {
                command.env("AFTERGLOW_RECORD", recording(path)?);
            }
        }
        Err(error) if error.is_no_device() => {
            eprintln!("afterglow: {error}\nafterglow: starting the program with the system's OpenGL");
            if arguments.record.is_some() {
                eprintln!("afterglow: nothing is recorded");
                command.env_remove("AFTERGLOW_RECORD");
            }
        }
        Err(error) => return Err(Failure::Device(error)),
    }
    let error = command.exec();
    Err(Failure::Usage(format!("cannot start {}: {error}", program.to_string_lossy())))
}

/// The environment in which a program finds our library, however it looks for one.
fn set_up(command: &mut Command, arguments: &Arguments, folder: &Path) {
    let library = folder.join(libdir::NAMES[0]);
    command
        .env("LD_LIBRARY_PATH", before(folder, std::env::var_os("LD_LIBRARY_PATH").as_deref()))
        // SDL 1.2 and SDL 2 open a library by name; in a Wayland session SDL would not use GLX.
        .env("SDL_VIDEO_GL_DRIVER", &library)
        .env("SDL_OPENGL_LIBRARY", &library)
        .env("SDL_VIDEODRIVER", "x11")
        .env("SDL_VIDEO_DRIVER", "x11");
    for (name, value) in said(arguments) {
        command.env(name, value);
    }
}

/// The library's variables for options that are said: what is not is left to the configuration.
fn said(arguments: &Arguments) -> Vec<(&'static str, String)> {
    let number = |number: Option<u32>| number.map(|number| number.to_string());
    let flag = |flag: Option<bool>| flag.map(|flag| if flag { "1" } else { "0" }.to_owned());
    let options = [
        ("AFTERGLOW_MODE", arguments.mode.map(|mode| mode.name().to_owned())),
        ("AFTERGLOW_SPP", number(arguments.spp)),
        ("AFTERGLOW_SEED", number(arguments.seed)),
        ("AFTERGLOW_MEMORY", number(arguments.memory)),
        ("AFTERGLOW_BAKED", arguments.baked.map(|baked| baked.name().to_owned())),
        ("AFTERGLOW_SKY", arguments.sky.map(|sky| sky.name().to_owned())),
        ("AFTERGLOW_DEVICE", arguments.device.device.clone()),
        ("AFTERGLOW_KEEP", flag(arguments.keep.keep)),
        ("AFTERGLOW_KEYS", flag(arguments.keys)),
        ("AFTERGLOW_HUD", flag(arguments.hud.then_some(true))),
        ("AFTERGLOW_VALIDATION", flag(arguments.device.validation.then_some(true))),
    ];
    let said = options.into_iter().filter_map(|(name, value)| Some((name, value?)));
    said.chain(arguments.light.variables()).collect()
}

/// A choice as the library reads it, wherever the program goes.
fn profile(choice: &ProfileChoice) -> Result<OsString, Failure> {
    match choice {
        ProfileChoice::ByName => Ok(OsString::new()),
        ProfileChoice::None => Ok("none".into()),
        ProfileChoice::File(path) => {
            std::path::absolute(path).map(Into::into).map_err(|error| Failure::input(path, error))
        }
    }
}

/// A configuration as the library finds it, wherever the program goes. It may come later, but that is seldom meant.
fn config(path: &Path) -> Result<PathBuf, Failure> {
    if path == Path::new("none") {
        return Ok(path.into());
    }
    if let Err(error) = fs::metadata(path) {
        eprintln!("afterglow: {}: {error}; there is no configuration for now", path.display());
    }
    std::path::absolute(path).map_err(|error| Failure::input(path, error))
}

/// Where to record: a place that does not depend on the program's folder, without what was recorded before.
fn recording(path: &Path) -> Result<PathBuf, Failure> {
    let prepare = || {
        match fs::remove_file(path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        std::path::absolute(path)
    };
    prepare().map_err(|source| Failure::Output { path: path.into(), source })
}

/// A list of folders with one more in front.
fn before(folder: &Path, list: Option<&OsStr>) -> OsString {
    let mut text = folder.as_os_str().to_owned();
    if let Some(list) = list.filter(|list| !list.is_empty()) {
        text.push(":");
        text.push(list);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_have_a_place_of_their_own() {
        let path = recording(Path::new("no such file.trace")).unwrap();
        assert!(path.is_absolute() && path.ends_with("no such file.trace"));
        assert!(recording(&std::env::temp_dir()).is_err());
    }

    #[test]
    fn what_is_said_is_handed_on_and_nothing_else() {
        #[derive(clap::Parser)]
        struct Line {
            #[command(flatten)]
            arguments: Arguments,
        }
        let said = |options: &[&str]| {
            let line = ["run"].iter().chain(options).chain(&["--", "game"]);
            said(&<Line as clap::Parser>::try_parse_from(line).unwrap().arguments)
        };
        let options = [
            "--preset",
            "high",
            "--limit",
            "inf",
            "--keys",
            "no",
            "--view",
            "sky",
            "--denoiser",
            "svgf",
            "--antialiasing",
            "no",
        ];
        let values = said(&options);
        for (name, value) in [
            ("AFTERGLOW_PRESET", "high"),
            ("AFTERGLOW_LIMIT", "inf"),
            ("AFTERGLOW_KEYS", "0"),
            ("AFTERGLOW_VIEW", "sky"),
            ("AFTERGLOW_DENOISER", "svgf"),
            ("AFTERGLOW_ANTIALIASING", "0"),
        ] {
            assert!(values.contains(&(name, value.to_owned())), "{name}: {values:?}");
        }
        // Beside what the environment of the test says.
        let is_set = |name: &str| std::env::var_os(name).is_some();
        assert!(said(&[]).iter().all(|(name, _)| is_set(name)));
    }

    #[test]
    fn our_folder_comes_first() {
        assert_eq!(before(Path::new("/a"), None), "/a");
        assert_eq!(before(Path::new("/a"), Some("".as_ref())), "/a");
        assert_eq!(before(Path::new("/a"), Some("/b:/c".as_ref())), "/a:/b:/c");
    }
}
