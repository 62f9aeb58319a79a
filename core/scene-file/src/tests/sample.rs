//! A scene that has everything.

use serde_json::{Value, json};

use crate::{Problem, SceneFile, rtgt};

const IDENTITY: [f64; 16] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];

/// A translation, by columns.
pub(super) fn moved(x: f64, y: f64, z: f64) -> [f64; 16] {
    let mut columns = IDENTITY;
    columns[12..15].copy_from_slice(&[x, y, z]);
    columns
}

/// Two squares of two materials, one of them an object that moves in the second of three frames.
pub(super) fn document() -> Value {
    let camera = json!({ "modelview": moved(0.0, 0.0, -5.0), "projection": IDENTITY });
    json!({
        "format": "rtgt-1",
        "name": "sample",
        "note": "what is not known is passed by",
        "camera": { "width": 32, "height": 16, "modelview": moved(0.0, 0.0, -5.0), "projection": IDENTITY },
        "sun": { "direction_to_sun": [0.0, 2.0, 0.0], "angular_radius_rad": 0.005, "irradiance_normal": [3.0, 2.0, 1.0] },
        "sky": { "type": "constant", "radiance": [0.5, 0.25, 0.125] },
        "sphere_lights": [
            { "name": "lamp", "center": [0.0, 1.0, 0.0], "radius": 0.5, "radiance": [8.0, 4.0, 2.0] },
            { "center": [1.0, 1.0, 0.0], "radius": 2.0, "radiance": [1.0, 1.0, 1.0] },
        ],
        "materials": [
            { "name": "paint", "model": "lambert", "base_color": [0.5, 0.25, 1.0], "emission": [0.0, 0.0, 0.0] },
            { "name": "brass", "model": "ggx_metal", "base_color": [0.9, 0.8, 0.1], "roughness": 0.2, "metallic": 1.0,
              "emission": [2.0, 0.0, 0.0] },
        ],
        "positions": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.1]],
        "triangles": [[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]],
        "triangle_material": [0, 1, 1, 1],
        "objects": [{ "name": "lid", "first_triangle": 2, "triangle_count": 2 }],
        "sequence": { "frames": [
            { "camera": camera.clone() },
            { "camera": camera.clone(), "transforms": { "lid": moved(3.0, 0.0, 0.0) },
              "emission_scale": { "brass": 0.5, "lamp": 0.25 }, "sphere_light_scale": 2.0, "sun_scale": 0.0, "sky_scale": 4.0 },
            { "camera": camera },
        ] },
    })
}

/// Reads a document.
pub(super) fn parse(document: &Value) -> Result<SceneFile, Problem> {
    rtgt::parse(document.to_string().as_bytes())
}
