//! Options that commands share. Each is also the environment variable `AFTERGLOW_<NAME>`.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

use afterglow_gpu::GpuOptions;
use afterglow_render as render;
use afterglow_render::Paint;
use afterglow_scene::{Profile, ProfileChoice, ProfileError, ProgramCache, Replacing};
use afterglow_settings::{Preset, Quality};
use afterglow_trace::TraceReader;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use crate::failure::Failure;

/// How a frame becomes a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Mode {
    /// What the OpenGL specification says.
    Raster,
    /// Light by rays, in real time.
    Pathtrace,
    /// Light by rays without any bias, however long it takes.
    Reference,
}

impl Mode {
    /// As it is written on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Mode::Raster => "raster",
            Mode::Pathtrace => "pathtrace",
            Mode::Reference => "reference",
        }
    }

    /// As the renderer has it.
    pub fn of_renderer(self) -> render::Mode {
        match self {
            Mode::Raster => render::Mode::Raster,
            Mode::Pathtrace => render::Mode::Pathtrace,
            Mode::Reference => render::Mode::Reference,
        }
    }
}

/// What becomes of baked light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Baked {
    /// Traced light takes its place where its sources explain it well
    Auto,
    /// It stays, darkened by the shadows of what moves
    Keep,
    /// Traced light takes its place however well it is explained
    Replace,
}

impl Baked {
    /// As recovery takes it.
    pub fn replacing(self) -> Replacing {
        match self {
            Baked::Auto => Replacing::WhereGood,
            Baked::Keep => Replacing::Never,
            Baked::Replace => Replacing::Always,
        }
    }

    /// As AFTERGLOW_BAKED has it.
    pub fn name(self) -> &'static str {
        match self {
            Baked::Auto => "auto",
            Baked::Keep => "keep",
            Baked::Replace => "replace",
        }
    }
}

/// What rays see of a sky that the program draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Sky {
    /// One colour in all directions: its mean
    Constant,
    /// What is drawn in each direction
    Cube,
}

impl Sky {
    /// As the renderer has it.
    pub fn choice(self) -> render::SkyChoice {
        match self {
            Sky::Constant => render::SkyChoice::Constant,
            Sky::Cube => render::SkyChoice::Cube,
        }
    }

    /// As AFTERGLOW_SKY has it.
    pub fn name(self) -> &'static str {
        match self {
            Sky::Constant => "constant",
            Sky::Cube => "cube",
        }
    }
}

/// What traces rays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Backend {
    /// The software one; in live programs the faster one of both, which is found while they play
    Auto,
    /// A BVH of our own in compute shaders
    Software,
    /// The driver's structures and ray-tracing pipelines
    Hardware,
}

impl Backend {
    /// Where nothing may depend on how fast things are.
    pub fn fixed(self) -> render::Backend {
        match self {
            Backend::Auto | Backend::Software => render::Backend::Software,
            Backend::Hardware => render::Backend::Hardware,
        }
    }

    /// As AFTERGLOW_BACKEND has it.
    pub fn name(self) -> &'static str {
        match self {
            Backend::Auto => "auto",
            Backend::Software => "software",
            Backend::Hardware => "hardware",
        }
    }
}

/// Which device, and how it is watched.
#[derive(Debug, Args)]
pub struct DeviceArguments {
    /// Vulkan device by part of its name, or `lavapipe`
    #[arg(long, value_name = "NAME", env = "AFTERGLOW_DEVICE")]
    pub device: Option<String>,
    /// Run under the Vulkan validation layer; a message from it is a failure
    #[arg(long, env = "AFTERGLOW_VALIDATION", value_parser = clap::builder::BoolishValueParser::new())]
    pub validation: bool,
}

impl DeviceArguments {
    /// What to ask the device layer for.
    pub fn gpu_options(&self) -> GpuOptions {
        GpuOptions {
            device: self.device.clone(),
            validation: self.validation,
            synchronization_validation: self.validation,
            ..GpuOptions::default()
        }
    }
}

/// How one of many lights is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LightChoice {
    /// By what it may bring, several candidates by what they bring unshadowed
    Resampled,
    /// All with equal chances
    Uniform,
}

impl LightChoice {
    /// As the renderer has it.
    fn of_renderer(self) -> render::LightChoice {
        match self {
            LightChoice::Resampled => render::LightChoice::Resampled,
            LightChoice::Uniform => render::LightChoice::Uniform,
        }
    }

    /// As AFTERGLOW_LIGHTS has it.
    fn name(self) -> &'static str {
        match self {
            LightChoice::Resampled => "resampled",
            LightChoice::Uniform => "uniform",
        }
    }
}

/// How light is found.
#[derive(Debug, Args)]
pub struct LightArguments {
    /// A set of samples, bounces, candidates and limit by one word; what is said besides counts more
    #[arg(long, value_name = "PRESET", env = "AFTERGLOW_PRESET", value_parser = preset())]
    pub preset: Option<Preset>,
    /// What traces rays: `auto` unless it is said
    #[arg(long, value_enum, value_name = "WHAT", env = "AFTERGLOW_BACKEND")]
    pub backend: Option<Backend>,
    /// Bounces of light between surfaces; 1 unless it or a preset is said (pathtrace)
    #[arg(long, value_name = "N", env = "AFTERGLOW_BOUNCES", value_parser = clap::value_parser!(u32).range(0..=63))]
    pub bounces: Option<u32>,
    /// How one of many lights is chosen; `resampled` unless it is said
    #[arg(long, value_enum, value_name = "HOW", env = "AFTERGLOW_LIGHTS", hide_short_help = true)]
    pub lights: Option<LightChoice>,
    /// Candidates of which one light is kept; 4 unless it or a preset is said
    #[arg(long, value_name = "N", env = "AFTERGLOW_CANDIDATES", hide_short_help = true, value_parser = clap::value_parser!(u32).range(1..=8))]
    pub candidates: Option<u32>,
    /// Lights that a sample asks at the surface that is seen; 4 unless it or a preset is said (pathtrace)
    #[arg(long, value_name = "N", env = "AFTERGLOW_ASKED", hide_short_help = true, value_parser = clap::value_parser!(u32).range(1..=4))]
    pub asked: Option<u32>,
    /// Of many lights keep the choice of each pixel from frame to frame, and lend it to its neighbours (pathtrace)
    #[arg(long, env = "AFTERGLOW_REUSE", hide_short_help = true, value_parser = clap::builder::BoolishValueParser::new())]
    pub reuse: bool,
    /// Radiance that a sample brings at most, `inf` for no limit; 16 unless it or a preset is said (pathtrace)
    #[arg(long, value_name = "RADIANCE", env = "AFTERGLOW_LIMIT", hide_short_help = true, value_parser = limit)]
    pub limit: Option<f32>,
    /// What makes a picture of few samples; `asvgf` unless it is said (pathtrace)
    #[arg(long, value_name = "WHAT", env = "AFTERGLOW_DENOISER", value_parser = denoiser())]
    pub denoiser: Option<render::Denoiser>,
    /// Texels of light along a side for each pixel, 0.5 to 1; 1 unless it or a preset is said (pathtrace)
    #[arg(long, value_name = "SHARE", env = "AFTERGLOW_LIGHT_SCALE", value_parser = light_scale)]
    pub light_scale: Option<f32>,
    /// Whether the edges of triangles are smoothed; yes unless it is said (pathtrace)
    #[arg(long, value_name = "BOOL", env = "AFTERGLOW_ANTIALIASING", value_parser = clap::builder::BoolishValueParser::new())]
    pub antialiasing: Option<bool>,
    /// Show a buffer in place of the picture
    #[arg(long, value_enum, value_name = "WHAT", alias = "paint", env = "AFTERGLOW_VIEW")]
    pub view: Option<View>,
}

/// What a path-traced picture can show instead of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum View {
    /// The picture itself
    Picture,
    /// How light is found: a colour a kind of surface
    Kind,
    /// Shading normals
    Normal,
    /// Albedo
    Albedo,
    /// Direct light
    Direct,
    /// Indirect light
    Indirect,
    /// Light of the specular lobe
    Specular,
    /// Where what is seen was in the frame before
    Motion,
    /// How much samples of light differ
    Variance,
    /// How much of earlier frames' light is not believed
    Gradient,
    /// Over how many frames light is gathered
    History,
    /// Edges that are smoothed
    Edges,
    /// The sky as rays see it, in all directions: longitude to the right, latitude of the world's y axis upward
    Sky,
}

impl View {
    /// As the renderer has it.
    pub fn paint(self) -> Paint {
        match self {
            View::Picture => Paint::Picture,
            View::Kind => Paint::Kind,
            View::Normal => Paint::Normal,
            View::Albedo => Paint::Albedo,
            View::Direct => Paint::Direct,
            View::Indirect => Paint::Indirect,
            View::Specular => Paint::Specular,
            View::Motion => Paint::Motion,
            View::Variance => Paint::Variance,
            View::Gradient => Paint::Gradient,
            View::History => Paint::History,
            View::Edges => Paint::Edges,
            View::Sky => Paint::Sky,
        }
    }
}

impl LightArguments {
    /// Tells a renderer, with so many samples a pixel and frame if they are said. What is not said stays as it is.
    pub fn apply(&self, samples: Option<u32>, options: &mut render::PathtraceOptions) {
        options.backend = self.backend.unwrap_or(Backend::Auto).fixed();
        let quality = Quality {
            preset: self.preset,
            samples,
            bounces: self.bounces,
            candidates: self.candidates,
            asked: self.asked,
            limit: self.limit,
            lights: self.lights.map(LightChoice::of_renderer),
            reuse: self.reuse.then_some(true),
            denoiser: self.denoiser,
            light_scale: self.light_scale,
            antialiasing: self.antialiasing,
        };
        quality.apply(options);
        options.paint = self.view.map_or(Paint::Picture, View::paint);
    }

    /// The library's variables for what is said.
    pub fn variables(&self) -> Vec<(&'static str, String)> {
        let number = |number: Option<u32>| number.map(|number| number.to_string());
        let said = [
            ("AFTERGLOW_PRESET", self.preset.map(|preset| preset.name().to_owned())),
            ("AFTERGLOW_BACKEND", self.backend.map(|backend| backend.name().to_owned())),
            ("AFTERGLOW_BOUNCES", number(self.bounces)),
            ("AFTERGLOW_LIGHTS", self.lights.map(|lights| lights.name().to_owned())),
            ("AFTERGLOW_CANDIDATES", number(self.candidates)),
            ("AFTERGLOW_ASKED", number(self.asked)),
            ("AFTERGLOW_REUSE", self.reuse.then(|| "1".to_owned())),
            ("AFTERGLOW_LIMIT", self.limit.map(|limit| limit.to_string())),
            ("AFTERGLOW_DENOISER", self.denoiser.map(|denoiser| denoiser.name().to_owned())),
            ("AFTERGLOW_LIGHT_SCALE", self.light_scale.map(|scale| scale.to_string())),
            ("AFTERGLOW_ANTIALIASING", self.antialiasing.map(|is| u8::from(is).to_string())),
            ("AFTERGLOW_VIEW", self.view.map(|view| view.paint().name().to_owned())),
        ];
        said.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
    }
}

/// Presets by name.
fn preset() -> impl TypedValueParser<Value = Preset> {
    PossibleValuesParser::new(Preset::NAMES).try_map(|name| name.parse::<Preset>())
}

/// Denoisers by name.
pub fn denoiser() -> impl TypedValueParser<Value = render::Denoiser> {
    let names = render::Denoiser::ALL.map(render::Denoiser::name);
    PossibleValuesParser::new(names).try_map(|name| name.parse::<render::Denoiser>())
}

fn light_scale(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(scale) if (0.5..=1.0).contains(&scale) => Ok(scale),
        _ => Err(format!("'{text}' is not from 0.5 to 1")),
    }
}

/// A radiance above 0, or `inf`.
pub fn limit(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(limit) if limit > 0.0 => Ok(limit),
        _ => Err(format!("'{text}' is no radiance above 0")),
    }
}

/// What is known of the program beforehand.
#[derive(Debug, Args)]
pub struct ProfileArguments {
    /// Profile of the program (TOML), or `none`; the default is the one that comes with Afterglow for a program of its name
    #[arg(long, value_name = "FILE", env = "AFTERGLOW_PROFILE")]
    pub profile: Option<ProfileChoice>,
}

impl ProfileArguments {
    /// The profile for a program.
    pub fn load(&self, program: Option<&Path>) -> Result<Option<Arc<Profile>>, Failure> {
        let choice = self.profile.clone().unwrap_or_default();
        choice.load(program).map_err(|error| match error {
            ProfileError::Unreadable { path, source } => Failure::input(&path, source),
            ProfileError::TooLarge(path) => Failure::input(&path, "too large for a profile"),
            ProfileError::Malformed { name, reason } => Failure::input(Path::new(&name), reason),
        })
    }

    /// The profile for the program that a trace is of, if the trace says which.
    pub fn load_for_trace(&self, trace: &Path) -> Result<Option<Arc<Profile>>, Failure> {
        self.load(traced_program(trace)?.as_deref())
    }
}

/// Images that take the place of the program's textures.
#[derive(Debug, Args)]
pub struct ImageArguments {
    /// Folder of images that take the place of the program's textures, each named after its texture's hash; the default is
    /// the profile's, if it has one (pathtrace)
    #[arg(long, value_name = "DIR", env = "AFTERGLOW_REPLACE_IMAGES")]
    pub replace_images: Option<PathBuf>,
}

impl ImageArguments {
    /// The folder; one that is asked for must be there.
    pub fn folder(&self, profile: Option<&Profile>) -> Result<Option<PathBuf>, Failure> {
        if let Some(folder) = &self.replace_images {
            std::fs::read_dir(folder).map_err(|error| Failure::input(folder, error))?;
            return std::path::absolute(folder).map(Some).map_err(|error| Failure::input(folder, error));
        }
        Ok(profile.and_then(|profile| profile.images.clone()))
    }
}

/// What is kept of a program for its next run.
#[derive(Debug, Args)]
pub struct KeepArguments {
    /// Keep what is remembered of the program's worlds, and the light sources found in them, in the cache folder for its
    /// next run, and use what was kept there: yes or no (pathtrace)
    #[arg(
        long,
        value_name = "BOOL",
        env = "AFTERGLOW_KEEP",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "yes",
        value_parser = clap::builder::BoolishValueParser::new()
    )]
    pub keep: Option<bool>,
}

impl KeepArguments {
    /// The files of the program that a trace is of, if they are wanted: pictures of a trace that depend on what was
    /// played before are no measure of anything.
    pub fn cache_for_trace(&self, trace: &Path) -> Result<Option<ProgramCache>, Failure> {
        if !self.keep.unwrap_or(false) {
            return Ok(None);
        }
        let program = traced_program(trace)?;
        let program = program.as_deref().unwrap_or(trace);
        Ok(afterglow_gpu::lavapipe::cache_folder().map(|folder| ProgramCache::new(&folder, program)))
    }
}

/// The path of the program that a trace is of, if the trace says it.
fn traced_program(trace: &Path) -> Result<Option<PathBuf>, Failure> {
    let reader = TraceReader::open(trace).map_err(|error| Failure::input(trace, error))?;
    let program = reader.properties().iter().find(|(name, _)| name == "process.name");
    Ok(program.map(|(_, program)| program.into()))
}

/// Frames `A..B` without B, `A..` or a single `A`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Frames(pub Range<u64>);

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Frames, String> {
        let number = |part: &str| part.parse::<u64>().map_err(|_| format!("'{part}' is no frame number"));
        let range = match text.split_once("..") {
            Some((first, "")) => number(first)?..u64::MAX,
            Some(("", end)) => 0..number(end)?,
            Some((first, end)) => number(first)?..number(end)?,
            None => number(text)?..number(text)?.saturating_add(1),
        };
        if range.is_empty() { Err("there are no such frames".into()) } else { Ok(Frames(range)) }
    }
}

/// A number, and not one of those that compare with nothing.
pub fn number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if !number.is_nan() => Ok(number),
        _ => Err(format!("'{text}' is no number")),
    }
}

/// Pixels of a picture, at most.
const MOST_PIXELS: u64 = afterglow_metrics::MAX_PIXELS as u64;

/// `WxH` in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size(pub u32, pub u32);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Size, String> {
        let (width, height) = text.split_once('x').ok_or("expected WIDTHxHEIGHT")?;
        let side = |text: &str| match text.parse::<u32>() {
            Ok(side @ 1..=16384) => Ok(side),
            _ => Err(format!("'{text}' is no side between 1 and 16384 pixels")),
        };
        let (width, height) = (side(width)?, side(height)?);
        match u64::from(width) * u64::from(height) {
            ..=MOST_PIXELS => Ok(Size(width, height)),
            _ => Err(format!("'{text}' has more than {MOST_PIXELS} pixels")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_and_sizes() {
        assert_eq!("3..5".parse(), Ok(Frames(3..5)));
        assert_eq!("7".parse(), Ok(Frames(7..8)));
        assert_eq!("2..".parse(), Ok(Frames(2..u64::MAX)));
        assert!("5..5".parse::<Frames>().is_err());
        assert_eq!("320x240".parse(), Ok(Size(320, 240)));
        assert!("0x240".parse::<Size>().is_err());
        assert!("99999x2".parse::<Size>().is_err());
        assert!("16384x16384".parse::<Size>().is_err());
        assert!(number("nan").is_err() && number("x").is_err());
    }
}
