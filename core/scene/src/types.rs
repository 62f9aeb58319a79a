//! What a scene is: the one type that goes from here to the renderer.

use std::fmt;

use glam::{DMat4, Mat4, Vec3};

pub use crate::baked::{BakedInto, Bakes, Relit};
pub use crate::memory::{Look, MEMORY_BYTES, MISSING_FRAMES, MemoryCounts, Pass, Unseen};

/// The camera that the world was drawn with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// World to eye space, in f64: its inverse moves lights and objects to the world.
    pub view: DMat4,
    /// Eye to clip space (OpenGL's).
    pub projection: Mat4,
}

/// What a draw is. Classes that need more than one frame's evidence are there for later.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Class {
    /// Part of the world, drawn under the view matrix itself.
    Static,
    /// Part of the world, with a model matrix of its own.
    Movable,
    /// Part of the world, its vertices change.
    Dynamic,
    /// First-person weapon: seen by the camera, casts no shadow.
    ViewModel,
    /// Blended over the world.
    Translucent,
    /// Behind everything.
    Sky,
    /// Menus, HUD.
    Interface,
    /// Drawn again over a surface of the world, to be part of it (lightmap, detail, glow).
    Layer,
    /// Part of another view (mirror, picture in picture, cube map).
    OtherView,
    /// Not needed when rays make the light (shadow volumes, planar shadows).
    Dropped,
    /// Nothing of the above is sure: rasterized.
    Undecided,
}

impl Class {
    /// All classes, in the order of [`TriangleCounts::named`].
    pub const ALL: [Class; 11] = [
        Class::Static,
        Class::Movable,
        Class::Dynamic,
        Class::ViewModel,
        Class::Translucent,
        Class::Sky,
        Class::Interface,
        Class::Layer,
        Class::OtherView,
        Class::Dropped,
        Class::Undecided,
    ];

    /// As reports and profiles write it.
    pub fn name(self) -> &'static str {
        match self {
            Class::Static => "static",
            Class::Movable => "movable",
            Class::Dynamic => "dynamic",
            Class::ViewModel => "view_model",
            Class::Translucent => "translucent",
            Class::Sky => "sky",
            Class::Interface => "interface",
            Class::Layer => "layer",
            Class::OtherView => "mirrored",
            Class::Dropped => "dropped",
            Class::Undecided => "undecided",
        }
    }

    /// Whether the camera sees the draw through the visibility buffer.
    pub fn is_traced(self) -> bool {
        matches!(self, Class::Static | Class::Movable | Class::Dynamic | Class::ViewModel)
    }
}

/// The verdict on a draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// Index of the operation in the frame.
    pub operation: u32,
    /// What it is.
    pub class: Class,
    /// Why, in a few words; a profile's own where it decided.
    pub reason: &'static str,
    /// Object to world space; identity unless the draw belongs to the world. Static draws of a world that the
    /// program scales keep the scale here, since the camera is rigid.
    pub model: Mat4,
    /// The object that it is of, the same in all frames and in all runs of a program; 0 where that means nothing.
    pub object: u64,
    /// Its model matrix in the frame before, if the object was there.
    pub previous: Option<Mat4>,
    /// Its colours are baked light: unlit, with a lightmap or vertex colours.
    pub baked: bool,
    /// Number of triangles; 0 for points and lines.
    pub triangles: u32,
    /// Of a layer: the operation that drew the surface below, where it has exactly these triangles.
    pub base: Option<u32>,
}

/// Where the corners of a dynamic draw were in the frame before.
#[derive(Debug, Clone, PartialEq)]
pub struct Deformed {
    /// Index of the operation.
    pub operation: u32,
    /// Object-space positions, one an index of the draw.
    pub positions: Vec<Vec3>,
}

/// Where a light came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightOrigin {
    /// glLight.
    Gl(u8),
    /// The program has said it, by GL_AFTERGLOW_scene_hints; the name that it gave to the light.
    Program(u64),
    /// The program's profile.
    Profile,
    /// The world's baked light: what was found to have been there when it was baked.
    Recovered,
    /// A scene file. A point of light that falls off with the square of the distance is a sphere there, which is seen and
    /// hides what is behind it; its radiance is its colour over its radius squared.
    SceneFile,
    /// Nothing was found: a soft sun.
    Fallback,
}

/// As reports write it.
impl fmt::Display for LightOrigin {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            LightOrigin::Gl(number) => write!(f, "GL_LIGHT{number}"),
            LightOrigin::Program(id) => write!(f, "program {id}"),
            LightOrigin::Profile => f.write_str("profile"),
            LightOrigin::Recovered => f.write_str("recovered"),
            LightOrigin::SceneFile => f.write_str("scene file"),
            LightOrigin::Fallback => f.write_str("fallback"),
        }
    }
}

/// Where a light is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightShape {
    /// Infinitely far; direction from the surface to the light, and the disc's angular radius (radians).
    Directional {
        /// Unit vector to the light, world space.
        to_light: Vec3,
        /// Radians.
        angular_radius: f32,
    },
    /// At a place.
    Point {
        /// World space.
        position: Vec3,
        /// Radius of the sphere that shines, world units.
        radius: f32,
        /// Constant, linear, quadratic falloff with distance, as OpenGL has it.
        attenuation: Vec3,
        /// Spot: unit axis, cosine of the cut-off, exponent.
        spot: Option<(Vec3, f32, f32)>,
    },
}

/// A light of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLight {
    /// Where it is.
    pub shape: LightShape,
    /// Linear RGB that a facing white surface would show (where falloff is 1): OpenGL's diffuse colour, taken as sRGB,
    /// or what the program says over pi.
    pub color: Vec3,
    /// Where it came from.
    pub origin: LightOrigin,
}

/// Whether the sources of baked light are searched, and when they are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Relighting {
    /// They are not.
    #[default]
    Off,
    /// On a thread, beside the frames: nothing waits, and the frame from which they are known is any.
    Background,
    /// In the frame in which enough of the world has been seen: the same frames give the same lights. That frame takes
    /// seconds.
    AtOnce,
}

/// Whether traced light takes the place of baked light on what stands still.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Replacing {
    /// It does not: what is baked stays, with moving things' shadows in it.
    Never,
    /// Where the sources that were found explain it well, or a profile has lights.
    #[default]
    WhereGood,
    /// Wherever sources were found.
    Always,
}

/// How well the sources of baked light were found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relight {
    /// Relative error of the light that they make, area-weighted L2.
    pub residual: f32,
    /// Share of the lit surfaces' area with an error below a quarter.
    pub explained: f32,
    /// Share of the variance of the bake over its surfaces that they explain.
    pub variance: f32,
    /// Triangles of the world that was searched.
    pub triangles: usize,
    /// Patches of its lit surfaces.
    pub patches: usize,
    /// Surfaces that might have shone.
    pub emitters: usize,
    /// Sources that were found.
    pub sources: usize,
    /// Lights that became of them.
    pub lights: usize,
    /// Rays that it took.
    pub rays: u64,
    /// What the light of the bake is multiplied by in the scene's lights.
    pub scale: f32,
    /// It is good enough: the scene has these lights.
    pub is_used: bool,
    /// Their light takes the place of the bake.
    pub replaces: bool,
}

/// Triangles of a frame by class.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "each field is named for its class; mirrored is OtherView")]
pub struct TriangleCounts {
    pub r#static: u64,
    pub movable: u64,
    pub dynamic: u64,
    pub view_model: u64,
    pub translucent: u64,
    pub sky: u64,
    pub interface: u64,
    pub layer: u64,
    pub mirrored: u64,
    pub dropped: u64,
    pub undecided: u64,
}

impl TriangleCounts {
    /// The count of a class.
    pub fn of(&mut self, class: Class) -> &mut u64 {
        match class {
            Class::Static => &mut self.r#static,
            Class::Movable => &mut self.movable,
            Class::Dynamic => &mut self.dynamic,
            Class::ViewModel => &mut self.view_model,
            Class::Translucent => &mut self.translucent,
            Class::Sky => &mut self.sky,
            Class::Interface => &mut self.interface,
            Class::Layer => &mut self.layer,
            Class::OtherView => &mut self.mirrored,
            Class::Dropped => &mut self.dropped,
            Class::Undecided => &mut self.undecided,
        }
    }

    /// The counts with their names, as reports write them.
    pub fn named(mut self) -> [(&'static str, u64); 11] {
        Class::ALL.map(|class| (class.name(), *self.of(class)))
    }
}

impl Scene {
    /// Triangles by class.
    pub fn triangles(&self) -> TriangleCounts {
        let mut counts = TriangleCounts::default();
        for verdict in &self.verdicts {
            *counts.of(verdict.class) += u64::from(verdict.triangles);
        }
        counts
    }
}

/// A draw of the sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkyDraw {
    /// Index of the operation.
    pub operation: u32,
    /// Object to eye space.
    pub eye: DMat4,
}

/// A sky that the program draws about the eye.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedSky {
    /// Its draws, in the frame's order: triangles, each over those before it.
    pub draws: Vec<SkyDraw>,
    /// What the first of them is drawn over, sRGB.
    pub cleared: Vec3,
    /// Its mean, linear RGB.
    pub mean: Vec3,
    /// What is seen where nothing is drawn, linear RGB: what was cleared to, or the mean where that was black or nothing.
    pub open: Vec3,
    /// Radiance that it has at least in each direction, linear RGB: worlds without lights are not left dark.
    pub least: Vec3,
}

/// A frame, understood.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// The camera; without one the frame is rasterized as it is.
    pub camera: Option<Camera>,
    /// A verdict on each draw, in the frame's order.
    pub verdicts: Vec<Verdict>,
    /// Former positions of the dynamic draws that were there in the frame before, in the frame's order.
    pub deformed: Vec<Deformed>,
    /// The lights. Empty when the program's baked light is the light, or those that it was found to come from.
    pub lights: Vec<SceneLight>,
    /// Linear RGB from every direction that sees no surface: the mean over them, where they differ.
    pub sky: Vec3,
    /// How they differ; none where the program draws no sky about the eye, or something else has said what it is like.
    pub painted_sky: Option<PaintedSky>,
    /// Ambient light of the program's lights and light model, linear RGB: what bounces would have made.
    pub ambient: Vec3,
    /// The world shows baked light (lightmaps, vertex colours) and has no light sources of its own.
    pub baked: bool,
    /// How well the sources of baked light were found, once they were searched.
    pub relight: Option<Relight>,
    /// The lights take the place of baked light; None where it is shown as it is.
    pub relit: Option<Relit>,
    /// The program says that nothing of the frames before is seen any more.
    pub cut: bool,
    /// Counts worlds: another level, or anything that has no place in common with what was drawn before, has another.
    pub epoch: u64,
    /// Static parts of the world that the program has drawn before, and in this frame not or not all of. Some of their
    /// triangles may have been drawn: they lie at exactly the same place.
    pub unseen: Vec<Unseen>,
    /// Operations of static draws all of whose triangles are among the unseen ones and look the same there, ascending.
    pub covered: Vec<u32>,
}
