//! Scenes in files, for pictures that can be held against other renderers' and for figures that can be repeated.
//!
//! Three kinds of files are read: scenes (JSON, format `rtgt-1`, with or without a sequence), meshes (NumPy's `.npz`) and
//! views of meshes (JSON that names the mesh beside it). All become a [`SceneFile`], checked when it is read: whatever
//! holds one may rely on indices that are in range and on numbers that are finite. A [`Stage`] makes of it what the
//! renderer takes, a frame and its scene, as if a program had drawn it and nothing was left to be recovered.

mod check;
mod draws;
mod error;
mod fit;
mod lights;
mod mesh;
mod rtgt;
mod scene;
mod stage;
#[cfg(test)]
mod tests;
mod view;

pub use error::{Problem, SceneFileError};
pub use scene::{
    Material, Model, Object, SceneFile, SequenceFrame, Sky, SphereLight, Sun, Triangles, View, load, parse,
};
pub use stage::Stage;
