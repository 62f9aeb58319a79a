//! Options from the environment, and where log lines go.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::{Arc, Once};

use afterglow_engine::EngineOptions;
use afterglow_gpu::{Faults, GpuOptions};
use afterglow_render::{Backend, ImageOptions, Mode, PathtraceOptions};
use afterglow_scene::{Profile, ProfileChoice, ProgramCache, Replacing};
use tracing::level_filters::LevelFilter;

/// Samples a pixel and frame unless asked otherwise: a program that is played cannot wait for more.
const LIVE_SAMPLES: u32 = 1;
/// Most samples a pixel and frame.
const MOST_SAMPLES: u32 = 65536;

/// How to render: `AFTERGLOW_MODE` (`raster` or `pathtrace`), `AFTERGLOW_DEVICE`, `AFTERGLOW_VALIDATION`,
/// `AFTERGLOW_SPP`, `AFTERGLOW_SEED`, `AFTERGLOW_MEMORY` (MiB of the undrawn world), `AFTERGLOW_KEEP` (worlds are kept
/// for the next run, which they are unless it says no), `AFTERGLOW_BAKED` (`auto`, `keep` or `replace` baked light),
/// `AFTERGLOW_REPLACE_IMAGES` (a folder), `AFTERGLOW_BACKEND` (`auto`, `software` or `hardware` traces rays),
/// `AFTERGLOW_HUD` and `AFTERGLOW_PROFILE`. A value that is not understood is logged and counts as absent.
///
/// For tests: the device is lost at the submissions that `AFTERGLOW_DEBUG_LOSE_DEVICE` lists, counted from 1, and has
/// `AFTERGLOW_DEBUG_MEMORY` MiB of memory; with `AFTERGLOW_DEBUG_NO_WINDOWS` it cannot show pictures itself.
pub fn engine() -> EngineOptions {
    from_variables(&|name| std::env::var(name).ok())
}

/// Whether nothing is to be drawn at all (`AFTERGLOW_NOOP`), to measure what calls cost.
pub fn is_noop() -> bool {
    parsed(&|name| std::env::var(name).ok(), "AFTERGLOW_NOOP", flag).unwrap_or(false)
}

fn from_variables(variable: &dyn Fn(&str) -> Option<String>) -> EngineOptions {
    let mut pathtrace = PathtraceOptions::default();
    let samples = parsed(variable, "AFTERGLOW_SPP", number).unwrap_or(LIVE_SAMPLES);
    pathtrace.spp = samples.clamp(1, MOST_SAMPLES);
    pathtrace.seed = parsed(variable, "AFTERGLOW_SEED", number).unwrap_or(pathtrace.seed);
    // A program that plays must not stall.
    pathtrace.waits_for_builds = false;
    pathtrace.profile = profile(variable);
    pathtrace.images = images(variable, pathtrace.profile.as_deref());
    if let Some(mebibytes) = parsed(variable, "AFTERGLOW_MEMORY", number) {
        pathtrace.memory_bytes = u64::from(mebibytes) << 20;
    }
    pathtrace.replacing = parsed(variable, "AFTERGLOW_BAKED", replacing).unwrap_or(pathtrace.replacing);
    if parsed(variable, "AFTERGLOW_KEEP", flag).unwrap_or(true) {
        pathtrace.cache = cache();
    }
    EngineOptions {
        gpu: GpuOptions {
            device: variable("AFTERGLOW_DEVICE").filter(|name| !name.is_empty()),
            validation: parsed(variable, "AFTERGLOW_VALIDATION", flag).unwrap_or(false),
            faults: faults(variable),
            ..GpuOptions::default()
        },
        mode: parsed(variable, "AFTERGLOW_MODE", mode),
        pathtrace,
        backend: parsed(variable, "AFTERGLOW_BACKEND", backend).flatten(),
        hud: parsed(variable, "AFTERGLOW_HUD", flag).unwrap_or(false),
    }
}

/// What is known of this program, from the file that is named or else by the program's own name.
fn profile(variable: &dyn Fn(&str) -> Option<String>) -> Option<Arc<Profile>> {
    let choice = parsed(variable, "AFTERGLOW_PROFILE", |value| value.parse::<ProfileChoice>().ok());
    let program = std::env::current_exe().ok();
    let loaded = choice.unwrap_or_default().load(program.as_deref());
    loaded.unwrap_or_else(|error| {
        tracing::warn!("there is no profile: {error}");
        None
    })
}

/// Images that take the place of textures: those of the folder that is named, or else of the profile's.
fn images(variable: &dyn Fn(&str) -> Option<String>, profile: Option<&Profile>) -> Option<ImageOptions> {
    let named = variable("AFTERGLOW_REPLACE_IMAGES").filter(|folder| !folder.is_empty()).map(PathBuf::from);
    let folder = named.or_else(|| profile?.images.clone())?;
    Some(ImageOptions { folder, waits: false })
}

/// Where this program's worlds are kept.
fn cache() -> Option<ProgramCache> {
    let program = std::env::current_exe().ok()?;
    Some(ProgramCache::new(&afterglow_gpu::lavapipe::cache_folder()?, &program))
}

/// Failures to make up.
fn faults(variable: &dyn Fn(&str) -> Option<String>) -> Faults {
    let numbers = |list: &str| list.split(',').map(|number| number.trim().parse().ok()).collect();
    let losses: Option<Vec<u64>> = parsed(variable, "AFTERGLOW_DEBUG_LOSE_DEVICE", numbers);
    let memory =
        parsed(variable, "AFTERGLOW_DEBUG_MEMORY", number).map(|mebibytes| u64::from(mebibytes) << 20);
    let mut faults = Faults::default();
    faults.losses = losses.unwrap_or_default();
    faults.memory = memory;
    faults.no_windows = parsed(variable, "AFTERGLOW_DEBUG_NO_WINDOWS", flag).unwrap_or(false);
    faults
}

fn parsed<T>(
    variable: &dyn Fn(&str) -> Option<String>,
    name: &str,
    parse: impl Fn(&str) -> Option<T>,
) -> Option<T> {
    let value = variable(name).filter(|value| !value.is_empty())?;
    let result = parse(&value);
    if result.is_none() {
        tracing::warn!("{name}: {value:?} is not understood");
    }
    result
}

fn mode(value: &str) -> Option<Mode> {
    match value {
        "raster" => Some(Mode::Raster),
        "pathtrace" => Some(Mode::Pathtrace),
        "reference" => Some(Mode::Reference),
        _ => None,
    }
}

/// None is the faster one.
fn backend(value: &str) -> Option<Option<Backend>> {
    match value {
        "auto" => Some(None),
        "software" => Some(Some(Backend::Software)),
        "hardware" => Some(Some(Backend::Hardware)),
        _ => None,
    }
}

fn replacing(value: &str) -> Option<Replacing> {
    match value {
        "auto" => Some(Replacing::WhereGood),
        "keep" => Some(Replacing::Never),
        "replace" => Some(Replacing::Always),
        _ => None,
    }
}

fn flag(value: &str) -> Option<bool> {
    match value.to_ascii_lowercase().as_str() {
        "1" | "true" | "yes" | "on" => Some(true),
        "0" | "false" | "no" | "off" => Some(false),
        _ => None,
    }
}

fn number(value: &str) -> Option<u32> {
    value.parse().ok()
}

/// Sends log lines of the level `AFTERGLOW_LOG` (`warn` if absent) and above to the standard error output. All calls
/// but the first do nothing.
pub fn start_log() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let level = std::env::var("AFTERGLOW_LOG").ok().and_then(|level| level.parse().ok());
        let _ = tracing_subscriber::fmt()
            .with_max_level(level.unwrap_or(LevelFilter::WARN))
            .with_writer(std::io::stderr)
            .with_ansi(std::io::stderr().is_terminal())
            .log_internal_errors(false)
            .try_init();
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_set_leaves_the_mode_to_the_device() {
        let options = from_variables(&|_| None);
        assert_eq!(options.mode, None);
        assert!(!options.gpu.validation && options.gpu.device.is_none());
        assert_eq!(options.pathtrace.spp, 1);
    }

    #[test]
    fn worlds_are_kept_unless_it_is_refused() {
        let cache = |keep: &str| {
            from_variables(&|name| (name == "AFTERGLOW_KEEP").then(|| keep.to_owned())).pathtrace.cache
        };
        assert_eq!(cache("no"), None);
        assert_eq!(cache("").is_some(), afterglow_gpu::lavapipe::cache_folder().is_some());
    }

    #[test]
    fn images_come_from_the_folder_that_is_named() {
        let options =
            from_variables(&|name| (name == "AFTERGLOW_REPLACE_IMAGES").then(|| "/a/pack".to_owned()));
        let images = options.pathtrace.images.unwrap();
        assert_eq!((images.folder, images.waits), ("/a/pack".into(), false));
        assert_eq!(from_variables(&|_| None).pathtrace.images, None);
    }

    #[test]
    fn what_is_not_understood_counts_as_absent() {
        let options = from_variables(&|name| {
            let value = match name {
                "AFTERGLOW_MODE" => "raster",
                "AFTERGLOW_VALIDATION" => "Yes",
                "AFTERGLOW_SPP" => "0",
                "AFTERGLOW_SEED" => "minus one",
                "AFTERGLOW_HUD" => "on",
                "AFTERGLOW_BACKEND" => "hardware",
                "AFTERGLOW_PROFILE" => "/nowhere/at-all.toml",
                "AFTERGLOW_DEBUG_LOSE_DEVICE" => "3, never",
                _ => "",
            };
            Some(value.to_owned())
        });
        assert_eq!(options.mode, Some(Mode::Raster));
        assert!(options.gpu.validation && options.gpu.device.is_none());
        assert_eq!((options.pathtrace.spp, options.pathtrace.seed), (1, 0));
        assert_eq!(options.pathtrace.profile, None);
        assert_eq!(options.backend, Some(Backend::Hardware));
        assert!(options.hud && options.gpu.faults.losses.is_empty());
    }
}
