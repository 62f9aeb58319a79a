//! How a renderer traces.

use std::path::PathBuf;
use std::sync::Arc;

use super::denoise::Denoiser;
use afterglow_records::Paint;
use afterglow_scene::{Class, MEMORY_BYTES, Profile, ProgramCache, Relighting, Replacing};
use glam::Vec3;

use super::backend::Backend;

/// What a frame becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Mode {
    /// What OpenGL 1.5 defines.
    #[default]
    Raster,
    /// The same with the world's light traced.
    Pathtrace,
    /// The same with light that adds up without any bias: no limit, no filter, as many bounces as are asked for.
    Reference,
}

/// How far light is followed in [`Mode::Reference`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Target {
    /// What lights bring to the surfaces that are seen, and what shines itself.
    Direct,
    /// One bounce more.
    Bounce1,
    /// All bounces. Paths end at random from the fifth surface on, and after [`Target::MOST_SURFACES`] at the latest: then
    /// a closed world of albedo a has a share of a^64 less light than it should.
    #[default]
    Full,
}

impl Target {
    /// Surfaces that a path may scatter at.
    pub const MOST_SURFACES: u32 = 64;

    pub(crate) fn surfaces(self) -> u32 {
        match self {
            Self::Direct => 1,
            Self::Bounce1 => 2,
            Self::Full => Self::MOST_SURFACES,
        }
    }
}

/// How one of many lights is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LightChoice {
    /// By what it may bring, and several candidates by what they bring unshadowed.
    #[default]
    Resampled,
    /// All with equal chances: what others are measured by.
    Uniform,
}

/// What rays see of a sky that the program draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SkyChoice {
    /// One colour in all directions: its mean.
    Constant,
    /// What is drawn in each direction.
    #[default]
    Cube,
}

impl SkyChoice {
    /// As reports write it.
    pub fn name(self) -> &'static str {
        match self {
            SkyChoice::Constant => "constant",
            SkyChoice::Cube => "cube",
        }
    }
}

/// Which traced draws are displaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Displaced {
    /// The draw of this number among a frame's draws, in the program's order.
    Draw(u32),
    /// All draws of a class.
    Class(Class),
}

/// Where images that take the place of textures come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ImageOptions {
    /// The folder. It is looked at every second.
    pub folder: PathBuf,
    /// Whether frames wait for the images that they need, so that a trace always gives the same pictures.
    pub waits: bool,
}

/// How to trace.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PathtraceOptions {
    /// What traces rays.
    pub backend: Backend,
    /// How far light is followed in [`Mode::Reference`].
    pub target: Target,
    /// Surfaces that a path may scatter at in [`Mode::Pathtrace`], the seen one included. Light that comes by more is missing,
    /// but for the program's ambient light.
    pub surfaces: u32,
    /// How one of many lights is chosen.
    pub light_choice: LightChoice,
    /// Candidates of which one light is kept, 1 to 8.
    pub candidates: u32,
    /// Lights with a place that each sample asks at the seen surface, 1 to 4.
    pub asked: u32,
    /// Of many lights, pixels keep one from frame to frame and lend it to their neighbours, in [`Mode::Pathtrace`].
    pub keeps_lights: bool,
    /// Radiance that a sample may bring in each channel in [`Mode::Pathtrace`]; infinite for no limit. What that removes is
    /// counted.
    pub most_radiance: f32,
    /// What rays see of the sky.
    pub sky: SkyChoice,
    /// Keep the linear picture, before exposure, for [`Renderer::read_radiance`](crate::Renderer::read_radiance).
    pub keeps_radiance: bool,
    /// Samples a pixel and frame, at least 1.
    pub spp: u32,
    /// Of all randomness: equal seeds give equal pictures.
    pub seed: u32,
    /// What makes a picture of few samples, in [`Mode::Pathtrace`].
    pub denoiser: Denoiser,
    /// Frames that direct, indirect and specular light are gathered over, at most, 1 to 63.
    pub histories: [u32; 3],
    /// Samples to spare for texels of whose light little is known, as a share of all others of a frame, from 0 to 1. Threads that are
    /// traced side by side wait for the one with most: a tenth more samples cost a third to two thirds more time on a graphics card.
    pub spare_samples: f32,
    /// Texels of light along a side, as a share of the picture's pixels: from 0.5 to 1.
    pub light_scale: f32,
    /// Smooth the edges of triangles, in [`Mode::Pathtrace`].
    pub smooth_edges: bool,
    /// Go on with the last frame's samples while nothing changes. Where there is a denoiser, its history is what goes on.
    pub accumulate: bool,
    /// Whether frames wait for the structures that rays need of them, so that a trace always gives the same pictures. If not, what
    /// lasts is built beside the frames, and rays pass through it until it is there ([`Backend::Software`]).
    pub waits_for_builds: bool,
    /// What is known of the program. It holds from the first frame on: later changes count for new windows only.
    pub profile: Option<Arc<Profile>>,
    /// Whether light sources are recovered from baked light. It holds from the first frame on, like the profile.
    pub relighting: Relighting,
    /// Whether their light takes the place of the baked one. Likewise.
    pub replacing: Replacing,
    /// Bytes of the static world that is remembered when it is not drawn; 0 for none of it.
    pub memory_bytes: u64,
    /// Where worlds and their recovered lights are kept for the next run of the program; nowhere if none. It holds
    /// from the first frame on, like the profile.
    pub cache: Option<ProgramCache>,
    /// Images that take the place of the program's textures; none if it is not said. They hold for a renderer from the first
    /// time on that it is said.
    pub images: Option<ImageOptions>,
    /// What the picture shows.
    pub paint: Paint,
    /// Moves the light of this number by so much, world units.
    pub move_light: Option<(usize, Vec3)>,
    /// Moves what rays meet of a draw by so much, world units. What the camera sees stays where the program drew it.
    pub move_draw: Option<(Displaced, Vec3)>,
}

impl PathtraceOptions {
    /// Samples to spare in a frame of so many texels of light. What is no number spares nothing.
    pub(crate) fn spare_samples(&self, [width, height]: [u32; 2]) -> u32 {
        let all = f64::from(self.spp.max(1)) * f64::from(width) * f64::from(height);
        (all * f64::from(self.spare_samples).clamp(0.0, 1.0)) as u32
    }
}

impl Default for PathtraceOptions {
    fn default() -> Self {
        Self {
            backend: Backend::Software,
            target: Target::Full,
            surfaces: 2,
            light_choice: LightChoice::Resampled,
            candidates: 4,
            asked: 4,
            keeps_lights: false,
            most_radiance: 16.0,
            sky: SkyChoice::Cube,
            keeps_radiance: false,
            spp: 2,
            seed: 0,
            denoiser: Denoiser::default(),
            histories: [32, 48, 32],
            spare_samples: 0.0,
            light_scale: 1.0,
            smooth_edges: true,
            accumulate: true,
            waits_for_builds: true,
            profile: None,
            relighting: Relighting::Background,
            replacing: Replacing::WhereGood,
            memory_bytes: MEMORY_BYTES,
            cache: None,
            images: None,
            paint: Paint::Picture,
            move_light: None,
            move_draw: None,
        }
    }
}
