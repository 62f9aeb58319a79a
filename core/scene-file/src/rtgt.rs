//! The JSON of scenes, format `rtgt-1`: a camera, lights, materials, triangles, and a sequence if there is one.

use std::collections::BTreeMap;

use glam::Vec3;
use serde::Deserialize;

use crate::check;
use crate::error::Problem;
use crate::scene::{
    Material, Model, Object, SceneFile, SequenceFrame, Sky, SphereLight, Sun, Triangles, View,
};

#[derive(Deserialize)]
struct Document {
    format: String,
    #[serde(default)]
    name: String,
    camera: Camera,
    sun: Option<FileSun>,
    sky: Option<FileSky>,
    #[serde(default)]
    sphere_lights: Vec<FileLight>,
    materials: Vec<FileMaterial>,
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u64; 3]>,
    triangle_material: Vec<u64>,
    #[serde(default)]
    objects: Vec<FileObject>,
    sequence: Option<FileSequence>,
}

#[derive(Deserialize)]
struct Camera {
    width: u32,
    height: u32,
    modelview: [f64; 16],
    projection: [f64; 16],
}

#[derive(Deserialize)]
struct FrameCamera {
    modelview: [f64; 16],
    projection: [f64; 16],
}

#[derive(Deserialize)]
struct FileSun {
    direction_to_sun: [f64; 3],
    angular_radius_rad: f64,
    irradiance_normal: [f64; 3],
}

#[derive(Deserialize)]
struct FileSky {
    r#type: String,
    radiance: [f64; 3],
}

#[derive(Deserialize)]
struct FileLight {
    name: Option<String>,
    center: [f64; 3],
    radius: f64,
    radiance: [f64; 3],
}

#[derive(Deserialize)]
struct FileMaterial {
    name: String,
    model: String,
    base_color: [f64; 3],
    #[serde(default)]
    roughness: f64,
    #[serde(default)]
    emission: [f64; 3],
}

#[derive(Deserialize)]
struct FileObject {
    name: String,
    first_triangle: u64,
    triangle_count: u64,
}

#[derive(Deserialize)]
struct FileSequence {
    frames: Vec<FileFrame>,
}

#[derive(Deserialize)]
struct FileFrame {
    camera: FrameCamera,
    #[serde(default)]
    transforms: BTreeMap<String, [f64; 16]>,
    #[serde(default)]
    emission_scale: BTreeMap<String, f64>,
    sphere_light_scale: Option<f64>,
    sun_scale: Option<f64>,
    sky_scale: Option<f64>,
}

/// Reads a scene from its file's bytes.
pub(crate) fn parse(text: &[u8]) -> Result<SceneFile, Problem> {
    let document: Document = serde_json::from_slice(text)?;
    if document.format != "rtgt-1" {
        return Err(Problem::Format(document.format));
    }
    let camera = &document.camera;
    let materials = materials(&document.materials)?;
    let triangles = triangles(&document, materials.len())?;
    let objects = objects(document.objects, triangles.corners.len())?;
    let mut scene = SceneFile {
        name: document.name,
        size: check::size("camera", [camera.width, camera.height])?,
        view: View::checked("camera", camera.modelview, camera.projection)?,
        sun: document.sun.map(sun).transpose()?,
        sky: document.sky.map(sky).transpose()?,
        sphere_lights: sphere_lights(document.sphere_lights)?,
        materials,
        triangles,
        objects,
        frames: Vec::new(),
    };
    if let Some(sequence) = document.sequence {
        scene.frames = frames(sequence.frames, &scene)?;
    }
    Ok(scene)
}

fn sun(sun: FileSun) -> Result<Sun, Problem> {
    Sun::checked(sun.direction_to_sun, sun.angular_radius_rad, sun.irradiance_normal)
}

fn sky(sky: FileSky) -> Result<Sky, Problem> {
    match sky.r#type.as_str() {
        "constant" => Ok(Sky { radiance: check::light("sky.radiance", sky.radiance)? }),
        other => Err(Problem::value("sky.type", format!("{other:?} is unknown; constant is known"))),
    }
}

fn sphere_lights(lights: Vec<FileLight>) -> Result<Vec<SphereLight>, Problem> {
    check::count("sphere_lights", lights.len(), check::MOST_LIGHTS)?;
    check::unique("sphere_lights", lights.iter().filter_map(|light| light.name.as_deref()))?;
    let light = |(index, light): (usize, FileLight)| {
        let place = |field: &str| format!("sphere_lights[{index}].{field}");
        Ok(SphereLight {
            name: light.name,
            center: check::point(&place("center"), light.center)?,
            radius: check::within(&place("radius"), light.radius, f64::from(f32::MIN_POSITIVE), 1e18)?,
            radiance: check::light(&place("radiance"), light.radiance)?,
        })
    };
    lights.into_iter().enumerate().map(light).collect()
}

fn materials(materials: &[FileMaterial]) -> Result<Vec<Material>, Problem> {
    check::count("materials", materials.len(), check::MOST_MATERIALS)?;
    check::unique("materials", materials.iter().map(|material| material.name.as_str()))?;
    let material = |(index, material): (usize, &FileMaterial)| {
        let place = |field: &str| format!("materials[{index}].{field}");
        let model = match material.model.as_str() {
            "lambert" => Model::Lambert,
            "ggx_metal" => Model::GgxMetal,
            other => {
                let reason = format!("{other:?} is unknown; lambert and ggx_metal are known");
                return Err(Problem::value(place("model"), reason));
            }
        };
        Ok(Material {
            name: material.name.clone(),
            model,
            base_color: check::reflectance(&place("base_color"), material.base_color)?,
            roughness: check::share(&place("roughness"), material.roughness)? as f32,
            emission: check::light(&place("emission"), material.emission)?,
        })
    };
    materials.iter().enumerate().map(material).collect()
}

fn triangles(document: &Document, material_count: usize) -> Result<Triangles, Problem> {
    let positions = document.positions.iter().map(|position| Vec3::from(*position)).collect();
    let materials = document.triangle_material.iter().copied();
    Triangles::checked(positions, document.triangles.iter().copied(), materials, material_count)
}

fn objects(objects: Vec<FileObject>, triangle_count: usize) -> Result<Vec<Object>, Problem> {
    check::count("objects", objects.len(), check::MOST_OBJECTS)?;
    check::unique("objects", objects.iter().map(|object| object.name.as_str()))?;
    let mut ranges: Vec<_> =
        objects.iter().map(|object| (object.first_triangle, object.triangle_count)).collect();
    ranges.sort_unstable();
    let mut end = 0;
    for (first, count) in ranges {
        let last = first.checked_add(count).filter(|last| *last <= triangle_count as u64);
        match last {
            Some(last) if first >= end => end = last,
            Some(_) => return Err(Problem::value("objects", format!("several have triangle {first}"))),
            None => {
                return Err(Problem::Index { place: "objects".into(), index: first, count: triangle_count });
            }
        }
    }
    let object = |object: FileObject| Object {
        name: object.name,
        first_triangle: object.first_triangle as usize,
        triangle_count: object.triangle_count as usize,
    };
    Ok(objects.into_iter().map(object).collect())
}

fn frames(frames: Vec<FileFrame>, scene: &SceneFile) -> Result<Vec<SequenceFrame>, Problem> {
    check::count("sequence.frames", frames.len(), check::MOST_FRAMES)?;
    let names = Names::of(scene);
    frames.iter().enumerate().map(|(index, frame)| names.frame(index, frame)).collect()
}

/// What a sequence refers to by name.
struct Names<'a> {
    objects: BTreeMap<&'a str, usize>,
    materials: BTreeMap<&'a str, usize>,
    lights: BTreeMap<&'a str, usize>,
}

impl<'a> Names<'a> {
    fn of(scene: &'a SceneFile) -> Self {
        let numbered = |names: Vec<&'a str>| names.into_iter().zip(0..).collect();
        let lights = scene.sphere_lights.iter().zip(0..);
        Self {
            objects: numbered(scene.objects.iter().map(|object| object.name.as_str()).collect()),
            materials: numbered(scene.materials.iter().map(|material| material.name.as_str()).collect()),
            lights: lights.filter_map(|(light, number)| Some((light.name.as_deref()?, number))).collect(),
        }
    }

    fn frame(&self, index: usize, frame: &FileFrame) -> Result<SequenceFrame, Problem> {
        let place = |field: &str| format!("sequence.frames[{index}].{field}");
        let mut found = SequenceFrame {
            view: View::checked(&place("camera"), frame.camera.modelview, frame.camera.projection)?,
            transforms: Vec::new(),
            emission_scales: Vec::new(),
            light_scales: Vec::new(),
            sphere_light_scale: check::scale(&place("sphere_light_scale"), frame.sphere_light_scale)?,
            sun_scale: check::scale(&place("sun_scale"), frame.sun_scale)?,
            sky_scale: check::scale(&place("sky_scale"), frame.sky_scale)?,
        };
        for (name, columns) in &frame.transforms {
            let place = place(&format!("transforms.{name}"));
            let Some(object) = self.objects.get(name.as_str()) else {
                return Err(Problem::value(place, "there is no object of this name"));
            };
            found.transforms.push((*object, check::affine(&place, *columns)?));
        }
        for (name, factor) in &frame.emission_scale {
            let place = place(&format!("emission_scale.{name}"));
            let factor = check::scale(&place, Some(*factor))?;
            let (material, light) = (self.materials.get(name.as_str()), self.lights.get(name.as_str()));
            if material.is_none() && light.is_none() {
                return Err(Problem::value(place, "there is no material and no sphere light of this name"));
            }
            found.emission_scales.extend(material.map(|number| (*number, factor)));
            found.light_scales.extend(light.map(|number| (*number, factor)));
        }
        Ok(found)
    }
}
