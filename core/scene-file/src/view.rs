//! A view of a mesh: JSON that names the mesh in the same folder, and has a camera, a sun and a sky.

use std::path::{Component, Path};

use serde::Deserialize;

use crate::check;
use crate::error::{Problem, SceneFileError};
use crate::mesh;
use crate::scene::{SceneFile, Sky, Sun, View};

#[derive(Deserialize)]
struct Document {
    mesh: String,
    resolution: [u32; 2],
    camera: Camera,
    sun: Option<FileSun>,
    sky: Option<FileSky>,
}

#[derive(Deserialize)]
struct Camera {
    modelview: [f64; 16],
    projection: [f64; 16],
}

#[derive(Deserialize)]
struct FileSun {
    direction_to_sun: [f64; 3],
    /// Radians.
    angular_radius: f64,
    irradiance_normal: [f64; 3],
}

#[derive(Deserialize)]
struct FileSky {
    radiance: [f64; 3],
}

/// Reads a view from its file's bytes, and its mesh.
pub(crate) fn load(path: &Path, text: &[u8]) -> Result<SceneFile, SceneFileError> {
    let of_view = |problem: Problem| SceneFileError::new(path, problem);
    let document: Document = serde_json::from_slice(text).map_err(|error| of_view(error.into()))?;
    let scene = view(path, &document).map_err(of_view)?;
    let mesh = path.with_file_name(&document.mesh);
    let (triangles, materials) = mesh::read(&mesh).map_err(|problem| SceneFileError::new(&mesh, problem))?;
    Ok(SceneFile { triangles, materials, ..scene })
}

/// The scene without its mesh.
fn view(path: &Path, document: &Document) -> Result<SceneFile, Problem> {
    if !matches!(Path::new(&document.mesh).components().collect::<Vec<_>>()[..], [Component::Normal(_)]) {
        return Err(Problem::value("mesh", format!("{:?} is no file in the same folder", document.mesh)));
    }
    Ok(SceneFile {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        size: check::size("resolution", document.resolution)?,
        view: View::checked("camera", document.camera.modelview, document.camera.projection)?,
        sun: document.sun.as_ref().map(sun).transpose()?,
        sky: match &document.sky {
            Some(sky) => Some(Sky { radiance: check::light("sky.radiance", sky.radiance)? }),
            None => None,
        },
        sphere_lights: Vec::new(),
        materials: Vec::new(),
        triangles: Default::default(),
        objects: Vec::new(),
        frames: Vec::new(),
    })
}

fn sun(sun: &FileSun) -> Result<Sun, Problem> {
    Sun::checked(sun.direction_to_sun, sun.angular_radius, sun.irradiance_normal)
}
