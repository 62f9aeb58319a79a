//! Meshes as NumPy's archives: `positions`, `triangles`, and if there are several materials `triangle_material` and
//! `albedo_linear`.

use std::path::Path;

use afterglow_npy::{Archive, Array, NpyError};
use glam::{DVec3, Vec3};

use crate::check;
use crate::error::Problem;
use crate::fit;
use crate::scene::{Material, Model, SceneFile, Sky, Triangles};

/// Reflectance of a mesh that says nothing of its materials.
const GREY: f32 = 0.5;
/// Picture of a mesh that is rendered by itself, pixels.
const SIZE: [u32; 2] = [640, 480];

/// A mesh, seen as a whole under a white sky.
pub(crate) fn load(path: &Path) -> Result<SceneFile, Problem> {
    let (triangles, materials) = read(path)?;
    Ok(SceneFile {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        size: SIZE,
        view: fit::view_of_all(&triangles, SIZE),
        sun: None,
        sky: Some(Sky { radiance: DVec3::ONE }),
        sphere_lights: Vec::new(),
        materials,
        triangles,
        objects: Vec::new(),
        frames: Vec::new(),
    })
}

/// A mesh's triangles and materials.
pub(crate) fn read(path: &Path) -> Result<(Triangles, Vec<Material>), Problem> {
    let archive = Archive::open(path, check::MOST_BYTES).map_err(Problem::Archive)?;
    let array = |name: &str| archive.file(name).and_then(|file| Array::parse(&file)).map_err(of_array(name));
    let positions = array("positions")?.float_rows::<3>().map_err(of_array("positions"))?;
    let corners = array("triangles")?.integer_rows::<3>().map_err(of_array("triangles"))?;
    let has_materials = archive.names().any(|name| name == "triangle_material");
    let (materials, of_triangles) = match has_materials {
        true => {
            let name = "triangle_material";
            let numbers = array(name)?.integers().map_err(of_array(name))?;
            (albedos(&array("albedo_linear")?)?, numbers)
        }
        false => (vec![lambert("mesh".into(), Vec3::splat(GREY))], vec![0; corners.len()]),
    };
    let positions = positions.into_iter().map(Vec3::from).collect();
    let corners = corners.into_iter().map(|corners| corners.map(unsigned));
    let numbers = of_triangles.into_iter().map(unsigned);
    let triangles = Triangles::checked(positions, corners, numbers, materials.len())?;
    Ok((triangles, materials))
}

fn albedos(array: &Array) -> Result<Vec<Material>, Problem> {
    let colors = array.float_rows::<3>().map_err(of_array("albedo_linear"))?;
    check::count("albedo_linear", colors.len(), check::MOST_MATERIALS)?;
    let material = |(index, color): (usize, [f32; 3])| {
        let color = check::reflectance(&format!("albedo_linear[{index}]"), color.map(f64::from))?;
        Ok(lambert(index.to_string(), color))
    };
    colors.into_iter().enumerate().map(material).collect()
}

fn lambert(name: String, base_color: Vec3) -> Material {
    Material { name, model: Model::Lambert, base_color, roughness: 1.0, emission: DVec3::ZERO }
}

/// An index; one that is negative is beyond all.
fn unsigned(index: i64) -> u64 {
    u64::try_from(index).unwrap_or(u64::MAX)
}

fn of_array(name: &str) -> impl Fn(NpyError) -> Problem + use<> {
    let place = name.to_owned();
    move |source| Problem::Array { place: place.clone(), source }
}
