//! Options, from the environment and from files, and where log lines go.

mod words;

use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::{Arc, Once};

use afterglow_engine::{Action, EngineOptions, Keys, OptionsSource};
use afterglow_gpu::{Faults, GpuOptions};
use afterglow_render::{ImageOptions, PathtraceOptions};
use afterglow_scene::{Profile, ProfileChoice, ProgramCache};
use afterglow_settings::{ConfigFile, Layer, Layers, Quality, flag};
use tracing::level_filters::LevelFilter;

use words::{backend, chord, light_scale, lights, mode, number, radiance, replacing, sky, view, within};

/// Samples a pixel and frame unless asked otherwise: a program that is played cannot wait for more.
const LIVE_SAMPLES: u32 = 1;
/// Most samples a pixel and frame.
const MOST_SAMPLES: u32 = 65536;

/// The environment's variable of this name.
fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

/// Whether nothing is to be drawn at all (`AFTERGLOW_NOOP`), to measure what calls cost.
pub fn is_noop() -> bool {
    variable("AFTERGLOW_NOOP").and_then(|value| flag(&value)).unwrap_or(false)
}

/// All options of a live program. Each is a variable of the environment, `AFTERGLOW_SPP`, and a key of the configuration
/// file, `spp`, and of a profile's `[options]`; the former counts more than the latter. A value that is not understood is
/// logged and counts as absent.
///
/// For tests: the device is lost at the submissions that `debug_lose_device` lists, counted from 1, and has
/// `debug_memory` MiB of memory; with `debug_no_windows` it cannot show pictures itself.
pub struct Options {
    file: Option<ConfigFile>,
    /// What the file said when it could be read last.
    said: Layer,
}

impl Options {
    /// Those of this process. Log lines go where they say from now on.
    pub fn read() -> Options {
        let mut options = Options { file: ConfigFile::find(&variable), said: Layer::default() };
        let failure = options.read_file();
        let level = options.layers(&variable).get("log", |level| level.parse().ok());
        start_log(level.unwrap_or(LevelFilter::WARN));
        if let Some(failure) = failure {
            tracing::warn!("the configuration is left out: {failure}");
        }
        options
    }

    /// What they are now.
    pub fn engine(&self) -> EngineOptions {
        let mut layers = self.layers(&variable);
        let options = engine(&mut layers, &variable);
        layers.take_problems().iter().for_each(|problem| tracing::warn!("{problem}"));
        options
    }

    fn layers<'a>(&self, variable: &'a dyn Fn(&str) -> Option<String>) -> Layers<'a> {
        let mut layers = Layers::new(variable);
        layers.push(self.said.clone());
        layers
    }

    /// Why the file cannot be read, if so; what it said before holds.
    fn read_file(&mut self) -> Option<String> {
        match self.file.as_mut()?.read() {
            Ok(said) => {
                self.said = said;
                None
            }
            Err(error) => Some(error.to_string()),
        }
    }
}

impl OptionsSource for Options {
    fn changed(&mut self) -> Option<EngineOptions> {
        if !self.file.as_ref()?.has_changed() {
            return None;
        }
        if let Some(failure) = self.read_file() {
            tracing::warn!("the configuration stays as it was: {failure}");
            return None;
        }
        Some(self.engine())
    }
}

/// What the layers say, the profile's below them.
fn engine(layers: &mut Layers<'_>, variable: &dyn Fn(&str) -> Option<String>) -> EngineOptions {
    let profile = profile(layers);
    if let Some(profile) = &profile {
        layers.push(Layer::new(&format!("profile {}", profile.name), None, &profile.options));
    }
    let layers = &*layers;
    EngineOptions {
        gpu: GpuOptions {
            device: layers.text("device"),
            validation: layers.get("validation", flag).unwrap_or(false),
            faults: faults(layers),
            ..GpuOptions::default()
        },
        mode: layers.get("mode", mode),
        pathtrace: pathtrace(layers, profile),
        quality: quality(layers),
        backend: layers.get("backend", backend).flatten(),
        hud: layers.get("hud", flag).unwrap_or(false),
        keys: keys(layers),
        screenshots: screenshots(layers, variable),
    }
}

fn pathtrace(layers: &Layers<'_>, profile: Option<Arc<Profile>>) -> PathtraceOptions {
    let mut pathtrace = PathtraceOptions::default();
    pathtrace.spp = LIVE_SAMPLES;
    // A program that plays must not stall.
    pathtrace.waits_for_builds = false;
    pathtrace.images = images(layers, profile.as_deref());
    pathtrace.profile = profile;
    pathtrace.seed = layers.get("seed", number).unwrap_or(pathtrace.seed);
    if let Some(mebibytes) = layers.get("memory", number) {
        pathtrace.memory_bytes = u64::from(mebibytes) << 20;
    }
    pathtrace.replacing = layers.get("baked", replacing).unwrap_or(pathtrace.replacing);
    pathtrace.sky = layers.get("sky", sky).unwrap_or(pathtrace.sky);
    pathtrace.paint = layers.get("view", view).unwrap_or(pathtrace.paint);
    if layers.get("keep", flag).unwrap_or(true) {
        pathtrace.cache = cache();
    }
    pathtrace
}

fn quality(layers: &Layers<'_>) -> Quality {
    Quality {
        preset: layers.get("preset", |name| name.parse().ok()),
        samples: layers.get("spp", within(1, MOST_SAMPLES)),
        bounces: layers.get("bounces", within(0, 63)),
        candidates: layers.get("candidates", within(1, 8)),
        asked: layers.get("asked", within(1, 4)),
        limit: layers.get("limit", radiance),
        lights: layers.get("lights", lights),
        reuse: layers.get("reuse", flag),
        denoiser: layers.get("denoiser", |name| name.parse().ok()),
        light_scale: layers.get("light_scale", light_scale),
        antialiasing: layers.get("antialiasing", flag),
    }
}

/// The keys that a player may press, unless none are to be listened to.
fn keys(layers: &Layers<'_>) -> Option<Keys> {
    let mut keys = Keys::default();
    for action in Action::ALL {
        if let Some(chord) = layers.get(&format!("keys_{}", action.name()), chord) {
            keys.set(action, chord);
        }
    }
    layers.get("keys", flag).unwrap_or(true).then_some(keys)
}

/// The folder for screenshots: the one that is named, else the user's folder of pictures or that of all that is the user's.
fn screenshots(layers: &Layers<'_>, variable: &dyn Fn(&str) -> Option<String>) -> Option<PathBuf> {
    let usual = |name: &str| variable(name).map(PathBuf::from).filter(|folder| folder.is_absolute());
    layers.path("screenshots").or_else(|| usual("XDG_PICTURES_DIR")).or_else(|| usual("HOME"))
}

/// What is known of this program, from the file that is named or else by the program's own name.
fn profile(layers: &Layers<'_>) -> Option<Arc<Profile>> {
    let choice = match layers.text("profile") {
        Some(none) if none == "none" => ProfileChoice::None,
        Some(_) => layers.path("profile").map_or(ProfileChoice::ByName, ProfileChoice::File),
        None => ProfileChoice::ByName,
    };
    let program = std::env::current_exe().ok();
    let loaded = choice.load(program.as_deref());
    loaded.unwrap_or_else(|error| {
        tracing::warn!("there is no profile: {error}");
        None
    })
}

/// Images that take the place of textures: those of the folder that is named, or else of the profile's.
fn images(layers: &Layers<'_>, profile: Option<&Profile>) -> Option<ImageOptions> {
    let folder = layers.path("replace_images").or_else(|| profile?.images.clone())?;
    Some(ImageOptions { folder, waits: false })
}

/// Where this program's worlds are kept.
fn cache() -> Option<ProgramCache> {
    let program = std::env::current_exe().ok()?;
    Some(ProgramCache::new(&afterglow_gpu::lavapipe::cache_folder()?, &program))
}

/// Failures to make up.
fn faults(layers: &Layers<'_>) -> Faults {
    let numbers = |list: &str| list.split(',').map(|number| number.trim().parse().ok()).collect();
    let losses: Option<Vec<u64>> = layers.get("debug_lose_device", numbers);
    let mut faults = Faults::default();
    faults.losses = losses.unwrap_or_default();
    faults.memory = layers.get("debug_memory", number).map(|mebibytes| u64::from(mebibytes) << 20);
    faults.no_windows = layers.get("debug_no_windows", flag).unwrap_or(false);
    faults
}

/// Sends log lines of a level and above to the standard error output. All calls but the first do nothing.
fn start_log(level: LevelFilter) {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let _ = tracing_subscriber::fmt()
            .with_max_level(level)
            .with_writer(std::io::stderr)
            .with_ansi(std::io::stderr().is_terminal())
            .log_internal_errors(false)
            .try_init();
    });
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::collections::BTreeSet;

    use afterglow_render::{Backend, Mode};
    use afterglow_settings::Preset;

    use super::*;

    /// What an environment says, over a configuration file of this text.
    fn with(config: &str, variable: &dyn Fn(&str) -> Option<String>) -> (EngineOptions, Vec<String>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("config.toml");
        std::fs::write(&path, config).unwrap();
        let mut options = Options { file: Some(ConfigFile::new(path)), said: Layer::default() };
        assert_eq!(options.read_file(), None);
        let mut layers = options.layers(variable);
        let engine = engine(&mut layers, variable);
        (engine, layers.take_problems())
    }

    fn from_variables(variable: &dyn Fn(&str) -> Option<String>) -> EngineOptions {
        with("", variable).0
    }

    #[test]
    fn nothing_set_leaves_the_mode_to_the_device() {
        let options = from_variables(&|_| None);
        assert_eq!(options.mode, None);
        assert!(!options.gpu.validation && options.gpu.device.is_none());
        assert_eq!(options.pathtrace.spp, 1);
        assert_eq!((options.quality, options.keys), (Quality::default(), Some(Keys::default())));
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
        assert_eq!((options.quality.samples, options.pathtrace.seed), (None, 0));
        assert_eq!(options.pathtrace.profile, None);
        assert_eq!(options.backend, Some(Backend::Hardware));
        assert!(options.hud && options.gpu.faults.losses.is_empty());
    }
    #[test]
    fn every_key_is_asked_for() {
        let asked = RefCell::new(BTreeSet::from(["AFTERGLOW_LOG".to_owned()]));
        from_variables(&|name| {
            asked.borrow_mut().insert(name.to_owned());
            None
        });
        asked.borrow_mut().retain(|name| name.starts_with("AFTERGLOW_"));
        let keys: BTreeSet<_> =
            afterglow_settings::KEYS.iter().map(|key| afterglow_settings::variable(key)).collect();
        assert_eq!(asked.into_inner(), keys);
    }

    #[test]
    fn the_environment_counts_more_than_the_file_and_the_file_more_than_a_preset() {
        let config = "preset = 'ultra'\nspp = 3\nmode = 'raster'\nseed = 'x'\nscreenshots = 'shots'\n\
                      [keys]\nmode = 'Alt+F2'\nview = false";
        let variable = |name: &str| (name == "AFTERGLOW_MODE").then(|| "pathtrace".to_owned());
        let (options, problems) = with(config, &variable);
        assert_eq!(problems.len(), 1, "{problems:?}");
        assert!(problems[0].ends_with("config.toml: seed: \"x\" is not understood"), "{problems:?}");
        assert_eq!((options.mode, options.quality.samples), (Some(Mode::Pathtrace), Some(3)));
        assert_eq!(options.quality.preset, Some(Preset::Ultra));
        let keys = options.keys.unwrap();
        assert_eq!(keys.chord(Action::Mode), "Alt+F2".parse().ok());
        assert_eq!(keys.chord(Action::View), None);
        assert!(keys.chord(Action::Hud).is_some());
        assert!(options.screenshots.unwrap().ends_with("shots"));
        assert_eq!(with("keys = false", &|_| None).0.keys, None);
    }

    #[test]
    fn a_profile_says_options_below_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("game.toml");
        std::fs::write(&path, "name = 'A'\n[options]\nkeys = false\nspp = 5\nbounces = 3\nx = 1").unwrap();
        let variable = |name: &str| (name == "AFTERGLOW_PROFILE").then(|| path.display().to_string());
        let (options, problems) = with("spp = 2", &variable);
        assert_eq!(
            (options.keys, options.quality.samples, options.quality.bounces),
            (None, Some(2), Some(3))
        );
        assert_eq!(problems, ["profile A: there is no option \"x\""]);
    }

    #[test]
    fn a_file_that_changes_is_read_again_and_one_that_is_damaged_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("config.toml");
        let mut options = Options { file: Some(ConfigFile::new(path.clone())), said: Layer::default() };
        assert!(options.read_file().is_none() && options.changed().is_none());
        std::fs::write(&path, "bounces = 4").unwrap();
        assert_eq!(options.changed().unwrap().quality.bounces, Some(4));
        assert!(options.changed().is_none());
        std::fs::write(&path, "bounces = ").unwrap();
        assert!(options.changed().is_none());
        assert_eq!(options.engine().quality.bounces, Some(4));
    }

    #[test]
    fn screenshots_have_a_folder_where_there_is_one() {
        let folder = |set: &'static str| {
            from_variables(&move |name| (name == set).then(|| "/p".to_owned())).screenshots
        };
        assert_eq!(folder("XDG_PICTURES_DIR"), Some("/p".into()));
        assert_eq!(folder("HOME"), Some("/p".into()));
        assert_eq!(folder("AFTERGLOW_SCREENSHOTS"), Some("/p".into()));
        assert_eq!(folder("PATH"), None);
    }
}
