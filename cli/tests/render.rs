//! `afterglow render`: scenes in files, and what it says of those that are none.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::path::{Path, PathBuf};
use std::process::Command;

use afterglow_gpu::{Gpu, GpuOptions};
use afterglow_metrics::{Image, io};
use afterglow_render::{Mode, PathtraceOptions, Radiance, RenderOptions, Renderer};
use afterglow_scene_file::{Stage, load};
use serde_json::{Value, json};
use tempfile::TempDir;

/// A floor and a lamp that shines on it from above; an object that a sequence of three frames moves.
fn document() -> Value {
    let at = |x: f64, y: f64, z: f64| {
        let mut columns = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        columns[12..15].copy_from_slice(&[x, y, z]);
        columns
    };
    let projection = [2.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, -1.02, -1.0, 0.0, 0.0, -0.202, 0.0];
    let camera = json!({ "modelview": at(0.0, -1.0, -4.0), "projection": projection });
    json!({
        "format": "rtgt-1", "name": "lamp",
        "camera": { "width": 24, "height": 16, "modelview": at(0.0, -1.0, -4.0), "projection": projection },
        "sky": { "type": "constant", "radiance": [0.1, 0.2, 0.3] },
        "materials": [
            { "name": "floor", "model": "lambert", "base_color": [0.5, 0.5, 0.5] },
            { "name": "lamp", "model": "lambert", "base_color": [0.0, 0.0, 0.0], "emission": [9.0, 9.0, 9.0] },
        ],
        "positions": [[-3, 0, 3], [3, 0, 3], [3, 0, -3], [-3, 0, -3], [-1, 2, -1], [1, 2, -1], [0, 2, 1]],
        "triangles": [[0, 1, 2], [0, 2, 3], [4, 5, 6]],
        "triangle_material": [0, 0, 1],
        "objects": [{ "name": "lamp", "first_triangle": 2, "triangle_count": 1 }],
        "sequence": { "frames": [
            { "camera": camera.clone() },
            { "camera": camera.clone(), "transforms": { "lamp": at(0.5, 0.0, 0.0) } },
            { "camera": camera, "emission_scale": { "lamp": 0.5 } },
        ] },
    })
}

/// A folder with the scene, as it is and as a still.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut document = document();
    std::fs::write(folder.path().join("scene.json"), document.to_string()).unwrap();
    document.as_object_mut().unwrap().remove("sequence");
    std::fs::write(folder.path().join("still.json"), document.to_string()).unwrap();
    folder
}

/// The exit code of `render` in a folder, what it wrote on standard output and on standard error.
fn render(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_afterglow"));
    command.current_dir(folder).arg("render").args(arguments).env("AFTERGLOW_DEVICE", "lavapipe");
    for variable in
        ["AFTERGLOW_MODE", "AFTERGLOW_SPP", "AFTERGLOW_SEED", "AFTERGLOW_SIZE", "AFTERGLOW_TARGET"]
    {
        command.env_remove(variable);
    }
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn picture(folder: &Path, name: &str) -> Image {
    io::load(&folder.join(name)).unwrap()
}

fn brightness(image: &Image) -> f32 {
    image.pixels().iter().flatten().sum()
}

#[test]
fn a_still_has_a_picture_and_figures() {
    let folder = folder();
    for mode in ["raster", "pathtrace", "reference"] {
        let arguments = ["still.json", "--mode", mode, "--spp", "4", "--out", "a.npy", "--json", "-"];
        let (code, figures, said) = render(folder.path(), &arguments);
        assert_eq!(code, 0, "{said}");
        let figures: Value = serde_json::from_str(&figures).unwrap();
        assert_eq!((&figures["mode"], &figures["target"]), (&json!(mode), &json!("full")));
        assert_eq!((&figures["size"], &figures["non_finite"]), (&json!([24, 16]), &json!(0)));
        assert_eq!(figures["samples"], json!(if mode == "raster" { 1 } else { 4 }));
        assert!(figures["seconds"].is_number() && figures["device"]["name"].is_string());
        // The uppermost rows are sky.
        let [red, green, blue] = picture(folder.path(), "a.npy").pixel(0, 0);
        assert!((red - 0.1).abs() < 0.01 && (green - 0.2).abs() < 0.01 && (blue - 0.3).abs() < 0.01);
    }
}

#[test]
fn sequences_are_numbered_and_reference_frames_are_complete_in_themselves() {
    let folder = folder();
    let range = |frames: &'static str, out: &'static str| {
        let arguments = ["scene.json", "--mode", "reference", "--spp", "2", "--frames", frames, "--out", out];
        assert_eq!(render(folder.path(), &arguments).0, 0);
    };
    range("0..9", "all/frame-%06d.npy");
    range("2..3", "one/frame-%06d.npy");
    let [first, second, third] =
        [0, 1, 2].map(|frame| picture(folder.path(), &format!("all/frame-{frame:06}.npy")));
    assert!(!folder.path().join("all/frame-000003.npy").exists());
    assert_ne!(first, second);
    assert!(brightness(&third) < 0.8 * brightness(&first));
    assert_eq!(third, picture(folder.path(), "one/frame-000002.npy"));
}

#[test]
fn standard_errors_belong_to_reference_mode() {
    let folder = folder();
    let arguments = |mode| {
        [
            "still.json",
            "--mode",
            mode,
            "--spp",
            "8",
            "--size",
            "12x8",
            "--out",
            "a.exr",
            "--standard-error",
            "e.npy",
        ]
    };
    assert_eq!(render(folder.path(), &arguments("reference")).0, 0);
    let errors = picture(folder.path(), "e.npy");
    assert_eq!((errors.width(), errors.height()), (12, 8));
    assert!(errors.pixel(0, 0) == [0.0; 3] && brightness(&errors) > 0.0);
    assert_eq!(render(folder.path(), &arguments("pathtrace")).0, 2);
}

#[test]
fn wrong_usage_and_damaged_scenes_have_their_codes() {
    let folder = folder();
    for arguments in [
        &["still.json", "--out", "a.jpeg"][..],
        &["still.json", "--out", "a.npy", "--frames", "0..2"],
        &["scene.json", "--out", "a.npy", "--frames", "2"],
        &["scene.json", "--out", "a.npy", "--frames", "3..4"],
        &["still.json", "--out", "a.npy", "--frames", "0"],
        &["still.json", "--out", "a.npy", "--seconds", "-1"],
        &["still.json", "--out", "a.npy", "--seconds", "1", "--frames", "2"],
    ] {
        let (code, _, said) = render(folder.path(), arguments);
        assert_eq!(code, 2, "{arguments:?}: {said}");
    }
    std::fs::write(folder.path().join("bad.json"), "{\"format\":").unwrap();
    for name in ["bad.json", "absent.json", "scene.txt"] {
        let (code, _, said) = render(folder.path(), &[name, "--out", "a.npy"]);
        assert_eq!(code, 4, "{said}");
        assert!(said.contains(name), "{said}");
    }
}

/// What submissions of so many samples each add up to.
fn in_parts(gpu: &Gpu, scene: PathBuf, parts: &[u32]) -> Radiance {
    let stage = Stage::new(load(&scene).unwrap()).unwrap();
    let mut renderer = Renderer::new(gpu, &RenderOptions::default()).unwrap();
    for samples in parts {
        let mut options = PathtraceOptions::default();
        options.spp = *samples;
        renderer.set_mode(Mode::Reference, &options).unwrap();
        let (mut frame, scene) = stage.still();
        renderer.execute_staged(&mut frame, scene).unwrap();
    }
    renderer.read_radiance().unwrap().unwrap()
}

#[test]
fn it_does_not_matter_how_samples_are_submitted() {
    let folder = folder();
    let gpu = Gpu::new(&GpuOptions::for_tests()).unwrap();
    let all = in_parts(&gpu, folder.path().join("still.json"), &[8]);
    assert_eq!(all.samples, 8);
    assert!(all == in_parts(&gpu, folder.path().join("still.json"), &[1, 2, 4, 1]));
    assert_eq!(gpu.validation_count(), 0, "{:#?}", gpu.validation_messages());
}
