//! What goes in and what comes out.
//!
//! Lengths are in the world's own unit, whatever it is. Light is linear RGB in the unit of the baked irradiance,
//! so that albedo x irradiance is what a lit surface shows (its radiosity).

use glam::Vec3;

/// A piece of a lightmapped surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Its middle, on the surface; the irradiance is the mean over a square about it.
    pub position: Vec3,
    /// To the lit side; any length but 0.
    pub normal: Vec3,
    /// In the world's unit, squared.
    pub area: f32,
    /// What the bake says it receives.
    pub irradiance: Vec3,
    /// Share of the light that it reflects, 0..1.
    pub albedo: Vec3,
}

/// A surface that may shine: unlit or glowing among lightmapped ones. All its triangles have one radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Emitter {
    /// Counter-clockwise as seen from where it shines to.
    pub triangles: Vec<[Vec3; 3]>,
    /// Shines to both sides.
    pub two_sided: bool,
    /// How much sooner it is believed to shine than a point in the air that explains as much; 1 is no sooner.
    pub preference: f32,
}

/// Where the sky is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sky<'a> {
    /// There is none.
    None,
    /// Along rays that meet nothing.
    Open,
    /// Along rays that meet one of these triangles first: a world that has been seen in part is full of
    /// holes, which are not sky.
    Surfaces(&'a [[Vec3; 3]]),
}

/// A static world with its baked light.
#[derive(Clone, Copy, Debug)]
pub struct Baked<'a> {
    /// What casts shadows, emitters among it or not.
    pub triangles: &'a [[Vec3; 3]],
    /// The lit surfaces in pieces.
    pub patches: &'a [Patch],
    /// Surfaces that may shine, the most likely first: of very many (256 at the default effort) the first are looked at.
    pub emitters: &'a [Emitter],
    /// Where the sky is seen.
    pub sky: Sky<'a>,
}

/// How a point light fades with the distance r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Falloff {
    /// Irradiance is power x cosine / r^2.
    InverseSquare,
    /// Irradiance is power x cosine x max(0, 1 - r / reach), as some compilers of levels have it.
    Linear {
        /// Where nothing is left.
        reach: f32,
    },
}

/// Which falloffs to try.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FalloffModel {
    /// [`Falloff::InverseSquare`] alone.
    InverseSquare,
    /// [`Falloff::Linear`] alone.
    Linear,
    /// The former, and the latter where the former leaves much unexplained: twice the time at most.
    Either,
}

/// A light source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A point in the air.
    Point {
        /// Where.
        position: Vec3,
        /// Nearer than this it grows no brighter: the least distance that the falloff is evaluated at.
        radius: f32,
        /// How it fades.
        falloff: Falloff,
    },
    /// Parallel light from the sky.
    Sun {
        /// Towards the sun, unit.
        direction: Vec3,
        /// Half its apparent width, in radians.
        angular_radius: f32,
    },
    /// The emitter of this number.
    Area {
        /// Index into [`Baked::emitters`].
        emitter: usize,
    },
    /// All of the sky, uniformly.
    Sky,
}

/// A source that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// What shines.
    pub source: Source,
    /// How much, linear RGB. `Point`, inverse square: radiant intensity (irradiance x distance^2); linear: irradiance at
    /// distance 0. `Sun`: irradiance of a surface that faces it. `Area`, `Sky`: radiance; a surface that
    /// sees nothing else receives pi times as much.
    pub power: Vec3,
    /// The share of the baked light's energy that only this source explains, 0..1: what the squared residual grows
    /// by without it.
    pub evidence: f32,
}

/// What was found.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Found {
    /// The sources, those of most evidence first.
    pub lights: Vec<Light>,
    /// Irradiance that all patches receive alike.
    pub ambient: Vec3,
    /// How much of the light that patches reflect at one another is in the bake: 0 where it holds direct light alone, 1
    /// where albedos are as given, less or more where they are guesses.
    pub bounce: Vec3,
    /// That light was reflected once, not ever on.
    pub one_bounce: bool,
    /// |model - bake| / |bake| over all patches and channels, area-weighted L2. More light than a clipped bake shows is no
    /// error.
    pub residual: f32,
    /// The same of each patch, against its own irradiance or 2 % of the brightest tenth's, whichever is more; infinite where
    /// the patch was not usable (not finite, no area, no normal).
    pub per_patch: Vec<f32>,
    /// Share of the usable patches' area with a relative error below 0.25.
    pub explained: f32,
    /// Rays traced.
    pub rays: u64,
}

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Of all sampling.
    pub seed: u64,
    /// Most sources.
    pub max_sources: usize,
    /// About how many rays may be traced: what is searched grows with it between 10^5 and 3 x 10^7, but a million are
    /// traced in any case where there are many patches or a sky. Nearly all time goes into them: a level of 22,000 triangles and
    /// 3,800 patches takes 5 to 6 million by default, which is about 5 s of one core.
    pub rays: u64,
    /// A patch with a channel at or above this was clipped: its irradiance is a lower bound.
    pub saturation: Option<f32>,
    /// How point lights fade.
    pub falloff: FalloffModel,
    /// A source is kept if without it the squared residual would grow by this share of the bake's energy.
    pub least_evidence: f32,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            max_sources: 128,
            rays: 8_000_000,
            saturation: None,
            falloff: FalloffModel::InverseSquare,
            least_evidence: 5e-5,
        }
    }
}
