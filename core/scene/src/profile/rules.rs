//! What a profile says. The types are those of its file: their fields are its keys.

use std::path::PathBuf;

use afterglow_gl::frame::Frame;
use glam::Vec3;
use serde::Deserialize;

use super::parse;
use crate::draws::{DepthUse, DrawFacts};
use crate::images::Images;
use crate::opacity::Mixing;
use crate::types::{Class, LightOrigin, LightShape, SceneLight};
use crate::views::share_of_drawable;

/// Rules of a profile, at most.
pub(super) const MOST_RULES: usize = 1024;
/// Lights of a profile, at most.
pub(super) const MOST_LIGHTS: usize = 64;
/// Textures that a profile names, at most.
pub(super) const MOST_TEXTURES: usize = 8192;
/// Radius of a light of which none is given, metres.
const RADIUS: f32 = 0.1;
/// Distance of which a light's colour is told unless it is given, metres.
const REACH: f32 = 1.0;

/// What is known of one program.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Profile {
    /// What it is for.
    #[serde(deserialize_with = "parse::text")]
    pub name: String,
    /// File names of the program, without folders.
    #[serde(deserialize_with = "parse::texts")]
    pub executables: Vec<String>,
    /// XXH3 (64 bits) of the program's file, if only that one is meant.
    pub executable_hash: Option<Hash>,
    /// World units of a metre.
    #[serde(deserialize_with = "parse::positive")]
    pub(super) units_per_metre: Option<f32>,
    /// Folder of images that take the place of the program's textures; in a file's text relative to the file.
    pub images: Option<PathBuf>,
    /// Options of the library by name, for when the program is played. They are not looked at here.
    pub options: toml::Table,
    pub(super) camera: Vec<CameraRule>,
    pub(super) class: Vec<ClassRule>,
    pub(super) lights: LightSettings,
    pub(super) light: Vec<LightRule>,
    pub(super) sky: SkyRule,
}

/// A hash, as `inspect` prints it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hash(pub u64);

/// A rule for some draws.
pub(super) trait Rule {
    /// Which.
    fn condition(&self) -> &Condition;
}

/// What a frame's view is, where a draw of it meets the condition.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraRule {
    pub(super) is: CameraKind,
    when: Condition,
}

/// See [`CameraRule`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum CameraKind {
    /// The draw's MODELVIEW is the view.
    View,
    /// The frame shows no world; it is rasterized.
    None,
}

/// What draws are that meet the condition.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ClassRule {
    pub(super) is: ClassName,
    #[serde(default)]
    pub(super) why: Reason,
    when: Condition,
}

/// Why, in the profile's own words. It lives as long as the program, so that verdicts can name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Reason(pub(super) &'static str);

impl Default for Reason {
    fn default() -> Reason {
        Reason("the profile says so")
    }
}

/// A class as reports write it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum ClassName {
    Static,
    Movable,
    Dynamic,
    ViewModel,
    Translucent,
    Sky,
    Interface,
    Layer,
    Mirrored,
    Dropped,
    Undecided,
}

impl ClassName {
    pub(super) fn class(self) -> Class {
        Class::ALL[self as usize]
    }
}

impl Rule for CameraRule {
    fn condition(&self) -> &Condition {
        &self.when
    }
}

impl Rule for ClassRule {
    fn condition(&self) -> &Condition {
        &self.when
    }
}

/// What becomes of lights that were found.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct LightSettings {
    pub(super) found: Found,
    /// Linear; on every surface alike.
    #[serde(deserialize_with = "parse::some_color")]
    pub(super) ambient: Option<Vec3>,
    pub(super) baked: Option<Baked>,
    /// How much of what relit surfaces reflect reaches others.
    #[serde(deserialize_with = "parse::some_color")]
    pub(super) bounce: Option<Vec3>,
}

/// What becomes of baked light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Baked {
    Auto,
    Keep,
    Replace,
}

/// See [`LightSettings`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Found {
    #[default]
    Keep,
    Off,
}

/// A light, in world space.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, tag = "kind", rename_all = "snake_case")]
pub(super) enum LightRule {
    /// A sphere.
    Point {
        #[serde(deserialize_with = "parse::vector")]
        position: Vec3,
        /// What a facing white surface shows at the distance `reach`; linear.
        #[serde(deserialize_with = "parse::color")]
        color: Vec3,
        #[serde(deserialize_with = "parse::positive", default)]
        radius: Option<f32>,
        #[serde(deserialize_with = "parse::positive", default)]
        reach: Option<f32>,
    },
    /// Infinitely far.
    Sun {
        #[serde(deserialize_with = "parse::direction")]
        to_light: Vec3,
        /// What a facing white surface shows; linear.
        #[serde(deserialize_with = "parse::color")]
        color: Vec3,
        /// Angle across the disc, degrees.
        #[serde(deserialize_with = "parse::positive", default)]
        diameter: Option<f32>,
    },
}

impl LightRule {
    /// The light; lengths that are not given are in metres of so many units.
    pub(super) fn light(&self, metre: f32) -> SceneLight {
        let (shape, color) = match *self {
            LightRule::Point { position, color, radius, reach } => {
                let reach = reach.unwrap_or(REACH * metre);
                let attenuation = Vec3::Z / (reach * reach).max(f32::MIN_POSITIVE);
                let radius = radius.unwrap_or(RADIUS * metre);
                (LightShape::Point { position, radius, attenuation, spot: None }, color)
            }
            LightRule::Sun { to_light, color, diameter } => {
                let angular_radius = 0.5 * diameter.unwrap_or(0.53).min(90.0).to_radians();
                (LightShape::Directional { to_light, angular_radius }, color)
            }
        };
        SceneLight { shape, color, origin: LightOrigin::Profile }
    }
}

/// What is behind everything.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct SkyRule {
    /// Linear.
    #[serde(deserialize_with = "parse::some_color")]
    pub(super) color: Option<Vec3>,
    /// Draws with one of these are sky.
    pub(super) textures: Vec<Hash>,
}

/// What draws a rule is for: all that is said must hold.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Condition {
    /// One of its textures is one of these.
    pub(super) textures: Option<Vec<Hash>>,
    /// Number of texture units in use.
    units: Option<Bounds>,
    triangles: Option<Bounds>,
    /// Share of the window that its viewport covers, 0 to 1.
    viewport_share: Option<Bounds>,
    blend: Option<BlendKind>,
    depth: Option<DepthKind>,
    lit: Option<bool>,
    projection: Option<ProjectionKind>,
    order: Option<Order>,
    matrix: Option<MatrixKind>,
    /// What recovery takes it for.
    class: Option<ClassName>,
}

/// A range of numbers, its ends included.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Bounds {
    #[serde(deserialize_with = "parse::bound")]
    at_least: Option<f64>,
    #[serde(deserialize_with = "parse::bound")]
    at_most: Option<f64>,
}

impl Bounds {
    fn holds(&self, number: f64) -> bool {
        self.at_least.is_none_or(|least| number >= least) && self.at_most.is_none_or(|most| number <= most)
    }
}

/// What blending amounts to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum BlendKind {
    Opaque,
    CutOut,
    Multiply,
    Add,
    Blend,
}

/// How the depth buffer is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum DepthKind {
    Off,
    Fill,
    Test,
    Equal,
    TestWrite,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum ProjectionKind {
    Perspective,
    Orthographic,
}

/// When it is drawn, as the world's opaque surfaces go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Order {
    /// Before the first.
    Early,
    /// Between them.
    Amid,
    /// After the last.
    Late,
}

/// What MODELVIEW is, as the view goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum MatrixKind {
    /// The view, maybe with a scale.
    View,
    /// The view without its translation: what is drawn stays about the eye.
    Turned,
    /// The identity.
    Identity,
    /// Anything else.
    Own,
}

/// A draw with what rules ask of it.
pub(super) struct Subject<'a> {
    pub(super) frame: &'a Frame,
    pub(super) images: &'a Images,
    pub(super) facts: &'a DrawFacts<'a>,
    pub(super) is_perspective: bool,
    pub(super) order: Order,
    pub(super) matrix: MatrixKind,
    /// What recovery takes it for.
    pub(super) class: Class,
}

impl Condition {
    /// Whether it asks for nothing.
    pub(super) fn is_empty(&self) -> bool {
        *self == Condition::default()
    }

    /// Whether a draw meets it.
    pub(super) fn holds(&self, subject: &Subject) -> bool {
        let Subject { frame, facts, .. } = subject;
        let words = &frame.fixed[facts.draw.fixed as usize].words;
        let units = words.units.iter().filter(|unit| unit.target() != 0).count();
        let share = || share_of_drawable(frame.viewports[facts.draw.viewport as usize].rect, frame.size);
        let projection = match subject.is_perspective {
            true => ProjectionKind::Perspective,
            false => ProjectionKind::Orthographic,
        };
        self.class.is_none_or(|class| class.class() == subject.class)
            && self.units.is_none_or(|bounds| bounds.holds(units as f64))
            && self.triangles.is_none_or(|bounds| bounds.holds(facts.triangles.into()))
            && self.viewport_share.is_none_or(|bounds| bounds.holds(share()))
            && self.blend.is_none_or(|kind| kind == blend_kind(facts.mixing))
            && self.depth.is_none_or(|kind| kind == depth_kind(facts.depth))
            && self.lit.is_none_or(|lit| lit == words.is_lit())
            && self.projection.is_none_or(|kind| kind == projection)
            && self.order.is_none_or(|order| order == subject.order)
            && self.matrix.is_none_or(|kind| kind == subject.matrix)
            && self.textures.as_ref().is_none_or(|hashes| subject.has_texture(hashes))
    }
}

impl Subject<'_> {
    /// Whether a unit in use has one of these textures.
    pub(super) fn has_texture(&self, hashes: &[Hash]) -> bool {
        let units = &self.frame.fixed[self.facts.draw.fixed as usize].words.units;
        let bindings = self.frame.bindings.get(self.facts.draw.bindings as usize);
        let used = units.iter().zip(bindings.into_iter().flatten()).filter(|(unit, _)| unit.target() != 0);
        let mut contents =
            used.filter_map(|(_, binding)| Some(self.images.get(binding.as_ref()?.image)?.content()));
        contents.any(|content| hashes.contains(&Hash(content)))
    }
}

fn blend_kind(mixing: Mixing) -> BlendKind {
    match mixing {
        Mixing::Opaque => BlendKind::Opaque,
        Mixing::CutOut => BlendKind::CutOut,
        Mixing::Multiply => BlendKind::Multiply,
        Mixing::Add => BlendKind::Add,
        Mixing::Blend => BlendKind::Blend,
    }
}

fn depth_kind(depth: DepthUse) -> DepthKind {
    match depth {
        DepthUse::Off => DepthKind::Off,
        DepthUse::Fill => DepthKind::Fill,
        DepthUse::Test => DepthKind::Test,
        DepthUse::Equal => DepthKind::Equal,
        DepthUse::TestWrite => DepthKind::TestWrite,
    }
}
