//! Files that are not what they should be: an error that names the place, and never a panic.

use std::path::Path;

use proptest::prelude::*;
use serde_json::{Value, json};

use super::sample::{document, moved, parse};
use crate::{Stage, load, rtgt};

/// What is said of the sample with one value replaced; `pointer` as in RFC 6901.
fn said(pointer: &str, value: Value) -> String {
    let mut document = document();
    *document.pointer_mut(pointer).unwrap() = value;
    parse(&document).expect_err(pointer).to_string()
}

#[test]
fn errors_name_the_place() {
    for (pointer, value, place) in [
        ("/format", json!("rtgt-2"), "rtgt-2"),
        ("/triangles/1/2", json!(4), "triangles[1]"),
        ("/triangles/1/2", json!(-1), "line"),
        ("/triangles", json!([]), "triangles"),
        ("/triangle_material/3", json!(2), "triangle_material[3]"),
        ("/triangle_material", json!([0]), "triangle_material"),
        ("/positions/2/0", json!(1e300), "positions[2]"),
        ("/camera/width", json!(0), "camera"),
        ("/camera/height", json!(40_000), "camera"),
        ("/camera/modelview/0", json!(2.0), "camera.modelview"),
        ("/camera/modelview/0", json!(-1.0), "camera.modelview"),
        ("/camera/projection/5", json!(0.0), "camera.projection"),
        ("/sun/direction_to_sun", json!([0.0, 0.0, 0.0]), "sun.direction_to_sun"),
        ("/sky/type", json!("clouds"), "sky.type"),
        ("/sphere_lights/1/radius", json!(0.0), "sphere_lights[1].radius"),
        ("/sphere_lights/1/radiance/0", json!(-1.0), "sphere_lights[1].radiance"),
        ("/materials/1/model", json!("glass"), "materials[1].model"),
        ("/materials/1/base_color/1", json!(1.5), "materials[1].base_color"),
        ("/materials/1/roughness", json!(-0.5), "materials[1].roughness"),
        ("/materials/1/name", json!("paint"), "materials"),
        ("/objects/0/triangle_count", json!(3), "objects"),
        ("/objects/0/first_triangle", json!(u64::MAX), "objects"),
        ("/sequence/frames/1/transforms", json!({ "door": moved(0.0, 0.0, 0.0) }), "transforms.door"),
        ("/sequence/frames/1/transforms/lid/15", json!(2.0), "transforms.lid"),
        ("/sequence/frames/1/transforms/lid/0", json!(0.0), "transforms.lid"),
        ("/sequence/frames/1/emission_scale", json!({ "glass": 1.0 }), "emission_scale.glass"),
        ("/sequence/frames/1/sun_scale", json!(-1.0), "sequence.frames[1].sun_scale"),
    ] {
        let said = said(pointer, value);
        assert!(said.contains(place), "{pointer}: {said}");
    }
}

#[test]
fn objects_do_not_overlap() {
    let mut document = document();
    document["objects"] = json!([
        { "name": "lid", "first_triangle": 1, "triangle_count": 2 },
        { "name": "pan", "first_triangle": 2, "triangle_count": 1 },
    ]);
    assert!(parse(&document).unwrap_err().to_string().contains("triangle 2"));
}

#[test]
fn files_are_told_apart_and_named() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    assert_eq!(load(&write("a.json", document().to_string().as_bytes())).unwrap().name, "sample");
    let said = |path: &Path| load(path).unwrap_err().to_string();
    assert!(said(&write("a.obj", b"")).contains("a.obj"));
    assert!(said(&write("b.json", b"{\n3")).contains("line 2"));
    assert!(said(&write("c.npz", b"PK")).contains("c.npz"));
    assert!(said(Path::new("absent.json")).contains("absent.json"));
    let mut view = json!({
        "mesh": "absent.npz", "resolution": [4, 4],
        "camera": { "modelview": moved(0.0, 0.0, 0.0), "projection": moved(0.0, 0.0, 0.0) },
    });
    assert!(said(&write("d.json", view.to_string().as_bytes())).contains("absent.npz"));
    for outside in ["../mesh.npz", "/mesh.npz", "a/b.npz", ".."] {
        view["mesh"] = json!(outside);
        assert!(said(&write("d.json", view.to_string().as_bytes())).contains("same folder"), "{outside}");
    }
}

/// A number as files may have it.
fn number() -> impl Strategy<Value = Value> {
    prop_oneof![
        any::<f64>().prop_map(|number| json!(number)),
        any::<i64>().prop_map(|number| json!(number)),
        Just(json!(1e308)),
        Just(json!(null)),
        Just(json!([])),
    ]
}

/// Pointers to all numbers of a document.
fn numbers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(pointer.into()),
        Value::Array(array) => {
            for (index, value) in array.iter().enumerate() {
                numbers(value, &format!("{pointer}/{index}"), found);
            }
        }
        Value::Object(object) => {
            for (key, value) in object {
                numbers(value, &format!("{pointer}/{key}"), found);
            }
        }
        _ => {}
    }
}

proptest! {
    #[test]
    fn any_number_is_refused_or_staged(place: prop::sample::Index, number in number()) {
        let mut document = document();
        let mut pointers = Vec::new();
        numbers(&document, "", &mut pointers);
        *document.pointer_mut(&pointers[place.index(pointers.len())]).unwrap() = number;
        if let Ok(scene) = parse(&document) {
            let frames = scene.frames.len();
            let stage = Stage::new(scene).unwrap();
            for (frame, scene) in (0..frames).map(|index| stage.staged(index)) {
                prop_assert!(scene.lights.iter().all(|light| light.color.is_finite()));
                prop_assert_eq!(frame.draws().count(), scene.verdicts.len());
            }
        }
    }

    #[test]
    fn damaged_text_is_never_a_panic(place: prop::sample::Index, byte: u8, length: prop::sample::Index) {
        let mut text = document().to_string().into_bytes();
        let place = place.index(text.len());
        text[place] = byte;
        let _ = rtgt::parse(&text);
        text.truncate(length.index(text.len()));
        prop_assert!(rtgt::parse(&text).is_err());
    }
}
