//! A scene as it is in memory, whichever file it came from.

use std::path::Path;

use glam::{DMat4, DVec3, Vec3};
use serde::Deserialize;

use crate::check;
use crate::error::{Problem, SceneFileError};
use crate::{mesh, rtgt, view};

/// A scene whose every index is in range and whose every number is finite. World space is right-handed; light is linear
/// RGB of the sRGB primaries, in one arbitrary unit.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    pub name: String,
    /// Width and height of the picture, pixels.
    pub size: [u32; 2],
    /// The camera, and that of the first frame of a sequence.
    pub view: View,
    pub sun: Option<Sun>,
    pub sky: Option<Sky>,
    pub sphere_lights: Vec<SphereLight>,
    pub materials: Vec<Material>,
    pub triangles: Triangles,
    /// Parts of the triangles that have a name; they do not overlap.
    pub objects: Vec<Object>,
    /// Frames of the sequence; empty if the scene is a still.
    pub frames: Vec<SequenceFrame>,
}

/// Where a picture is taken from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World to eye space, a rotation and a translation.
    pub modelview: DMat4,
    /// Eye to clip space (OpenGL's).
    pub projection: DMat4,
}

/// A disc of uniform radiance, infinitely far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sun {
    /// Unit vector to its centre, world space.
    pub direction: DVec3,
    /// Radians.
    pub angular_radius: f64,
    /// Irradiance of a surface that faces it.
    pub irradiance: DVec3,
}

/// Radiance from every direction in which there is nothing else.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sky {
    pub radiance: DVec3,
}

/// A sphere that shines, reflects nothing and hides what is behind it.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereLight {
    pub name: Option<String>,
    pub center: DVec3,
    /// World units.
    pub radius: f64,
    pub radiance: DVec3,
}

/// How a surface reflects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// BRDF = base colour / pi.
    Lambert,
    /// GGX with separable Smith shadowing and Schlick's Fresnel, whose reflectance at 0 degrees is the base colour.
    GgxMetal,
}

/// What surfaces are made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    pub name: String,
    pub model: Model,
    /// 0 to 1.
    pub base_color: Vec3,
    /// Perceptual roughness, 0 to 1; of metal only.
    pub roughness: f32,
    /// Radiance that the front side gives off.
    pub emission: DVec3,
}

/// Triangles, flat: the front is where their corners go counter-clockwise.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Triangles {
    pub positions: Vec<Vec3>,
    pub corners: Vec<[u32; 3]>,
    /// Of each triangle, its material's number.
    pub materials: Vec<u32>,
}

/// A part of the triangles that a sequence may move.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Object {
    pub name: String,
    pub first_triangle: usize,
    pub triangle_count: usize,
}

/// A frame of a sequence, complete in itself. All factors are on radiance.
#[derive(Debug, Clone, PartialEq)]
pub struct SequenceFrame {
    pub view: View,
    /// Where objects are that do not rest, by their numbers: from the still scene's place, in world space.
    pub transforms: Vec<(usize, DMat4)>,
    /// Factors on the emission of materials, by their numbers.
    pub emission_scales: Vec<(usize, f64)>,
    /// Factors on single sphere lights, by their numbers.
    pub light_scales: Vec<(usize, f64)>,
    /// Factor on all sphere lights.
    pub sphere_light_scale: f64,
    pub sun_scale: f64,
    pub sky_scale: f64,
}

/// Reads a scene.
///
/// # Errors
/// If the file, or the mesh that it names, cannot be read, is damaged, too large, or contradicts itself.
pub fn load(path: &Path) -> Result<SceneFile, SceneFileError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    match extension.to_str() {
        Some("json") => load_json(path),
        Some("npz") => mesh::load(path).map_err(|problem| SceneFileError::new(path, problem)),
        _ => Err(SceneFileError::new(path, Problem::Extension)),
    }
}

/// What tells views of meshes from scenes.
#[derive(Deserialize)]
struct Kind {
    mesh: Option<String>,
}

/// Reads a scene, with or without a sequence, from the bytes of its JSON (`rtgt-1`).
///
/// # Errors
/// If it is damaged, too large, or contradicts itself.
pub fn parse(text: &[u8]) -> Result<SceneFile, Problem> {
    rtgt::parse(text)
}

fn load_json(path: &Path) -> Result<SceneFile, SceneFileError> {
    let of_file = |problem| SceneFileError::new(path, problem);
    let text = read_bounded(path).map_err(of_file)?;
    let kind: Kind = serde_json::from_slice(&text).map_err(|error| of_file(error.into()))?;
    match kind.mesh {
        Some(_) => view::load(path, &text),
        None => rtgt::parse(&text).map_err(of_file),
    }
}

/// A file's bytes, unless there are too many.
fn read_bounded(path: &Path) -> Result<Vec<u8>, Problem> {
    use std::io::Read;
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(check::MOST_BYTES + 1).read_to_end(&mut bytes)?;
    check::count("bytes", bytes.len(), check::MOST_BYTES as usize)?;
    Ok(bytes)
}

impl View {
    pub(crate) fn checked(place: &str, modelview: [f64; 16], projection: [f64; 16]) -> Result<Self, Problem> {
        Ok(Self {
            modelview: check::rigid(&format!("{place}.modelview"), modelview)?,
            projection: check::invertible(&format!("{place}.projection"), projection)?,
        })
    }
}

impl Sun {
    /// `angular_radius` in radians.
    pub(crate) fn checked(
        direction: [f64; 3],
        angular_radius: f64,
        irradiance: [f64; 3],
    ) -> Result<Self, Problem> {
        Ok(Self {
            direction: check::direction("sun.direction_to_sun", direction)?,
            angular_radius: check::within("sun's angular radius", angular_radius, 0.0, 1.5)?,
            irradiance: check::light("sun.irradiance_normal", irradiance)?,
        })
    }
}

impl Triangles {
    /// Triangles whose corners are among `positions` and whose materials are of `material_count`.
    pub(crate) fn checked(
        positions: Vec<Vec3>,
        corners: impl ExactSizeIterator<Item = [u64; 3]>,
        materials: impl ExactSizeIterator<Item = u64>,
        material_count: usize,
    ) -> Result<Self, Problem> {
        check::count("positions", positions.len(), check::MOST_VERTICES)?;
        check::count("triangles", corners.len(), check::MOST_TRIANGLES)?;
        if corners.len() == 0 {
            return Err(Problem::value("triangles", "there are none"));
        }
        if materials.len() != corners.len() {
            let reason = format!("{} of them for {} triangles", materials.len(), corners.len());
            return Err(Problem::value("triangle_material", reason));
        }
        if let Some(index) = positions.iter().position(|position| !position.is_finite()) {
            return Err(Problem::value(format!("positions[{index}]"), "a coordinate is not finite"));
        }
        let mut triangles = Self { positions, ..Self::default() };
        for (index, (corners, material)) in corners.zip(materials).enumerate() {
            let place = || format!("triangles[{index}]");
            let count = triangles.positions.len();
            let [a, b, c] = corners.map(|corner| check::index(place, corner, count));
            triangles.corners.push([a?, b?, c?]);
            let place = || format!("triangle_material[{index}]");
            triangles.materials.push(check::index(place, material, material_count)?);
        }
        Ok(triangles)
    }
}
