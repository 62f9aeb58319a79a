//! What a program drew, as it knew it itself.

use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};
use serde::{Deserialize, Serialize};

/// All classes with their names in files and tables.
pub const CLASSES: [(Class, &str); 11] = [
    (Class::Static, "static"),
    (Class::Movable, "movable"),
    (Class::Dynamic, "dynamic"),
    (Class::ViewModel, "view_model"),
    (Class::Translucent, "translucent"),
    (Class::Sky, "sky"),
    (Class::Interface, "interface"),
    (Class::Layer, "layer"),
    (Class::OtherView, "other_view"),
    (Class::Dropped, "dropped"),
    (Class::Undecided, "undecided"),
];

/// Place of a class in [`CLASSES`].
pub fn class_index(class: Class) -> usize {
    CLASSES.iter().position(|&(known, _)| known == class).unwrap_or(CLASSES.len() - 1)
}

/// Tells serde of [`Class`], which belongs to another crate.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Class", rename_all = "snake_case")]
enum ClassName {
    Static,
    Movable,
    Dynamic,
    ViewModel,
    Translucent,
    Sky,
    Interface,
    Layer,
    OtherView,
    Dropped,
    Undecided,
}

/// From this number on, objects are told apart by nobody: identities are not asked of them.
pub const UNNAMED: u64 = 1 << 32;

/// Consecutive triangles that are one thing, in the order in which the program submits them; strips, fans, quads and
/// polygons count as the triangles that OpenGL makes of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Label {
    /// What they are.
    #[serde(with = "ClassName")]
    pub class: Class,
    /// The object that they belong to, the same in all frames. Layers, reflections and shadows belong to the object that
    /// they are of.
    pub object: u64,
    /// How many.
    pub triangles: u64,
}

/// The camera of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrueCamera {
    /// World to eye space, rigid.
    pub view: DMat4,
    /// Eye to clip space (OpenGL's).
    pub projection: DMat4,
}

/// Where a light is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TrueLightShape {
    /// Infinitely far.
    Directional {
        /// Unit vector to the light, world space.
        to_light: DVec3,
    },
    /// At a place.
    Point {
        /// World space.
        position: DVec3,
        /// Constant, linear and quadratic falloff with distance, as OpenGL has it.
        attenuation: Vec3,
    },
}

/// How the program shows a light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TrueLightOrigin {
    /// By the glLight of that number.
    Gl(u8),
    /// By a lightmap or vertex colours that were computed from it.
    Baked,
}

/// A light of the world.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrueLight {
    /// Where it is.
    pub shape: TrueLightShape,
    /// RGB as the program has it: OpenGL's diffuse colour, or what the baking multiplied by.
    pub color: Vec3,
    /// How it shows.
    pub origin: TrueLightOrigin,
}

/// The truth of one frame.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameTruth {
    /// Which world is shown: another number after a level change. World space is only fixed within one.
    pub world: u32,
    /// Nothing where no world is shown, as in a menu.
    pub camera: Option<TrueCamera>,
    /// The lights.
    pub lights: Vec<TrueLight>,
    /// What was drawn, in order.
    pub labels: Vec<Label>,
}

impl FrameTruth {
    /// Triangles in all.
    pub fn triangles(&self) -> u64 {
        self.labels.iter().map(|label| label.triangles).sum()
    }
}

/// The truth of a run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// The program's name.
    pub style: String,
    /// About how large the world is, in its units: what camera errors are relative to.
    pub extent: f64,
    /// Light that baked surfaces get alike, beside that of the baked lights.
    #[serde(default)]
    pub baked_ambient: f32,
    /// In order.
    pub frames: Vec<FrameTruth>,
}
