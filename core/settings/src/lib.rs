//! Options by name: presets of them, a configuration file, and which of several places decides.
//!
//! An option has one key everywhere: `spp` in the configuration file and in a profile's `[options]`, `AFTERGLOW_SPP` in the
//! environment, `--spp` on the command line, which reaches a live program by the environment. The higher place
//! decides: default < preset < profile < configuration file < environment. Nothing that a file says is ever a failure:
//! what is not understood counts as absent, and is a line to log.

mod file;
mod keys;
mod layers;
mod quality;

pub use file::{ConfigError, ConfigFile, MOST_BYTES};
pub use keys::{KEYS, is_key, variable};
pub use layers::{Layer, Layers, flag};
pub use quality::{Preset, Quality, UnknownPreset};
