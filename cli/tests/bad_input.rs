//! Damaged files, absurd arguments, no device: a clear message and the right exit code, never a crash.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data").join(name)
}

fn afterglow(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_afterglow"))
        .args(arguments)
        .env_remove("AFTERGLOW_MODE")
        .output()
        .expect("the program starts")
}

/// The exit code, and what was said on standard error.
fn run(arguments: &[&str]) -> (i32, String) {
    let output = afterglow(arguments);
    (output.status.code().expect("no signal ended it"), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn path(path: &Path) -> &str {
    path.to_str().expect("paths of tests are text")
}

#[test]
fn a_file_that_is_no_trace() {
    let (code, said) = run(&["replay", path(&data("README.md")), "--mode", "raster"]);
    assert_eq!(code, 4, "{said}");
    assert!(said.contains("README.md"), "{said}");
    let (code, said) = run(&["inspect", path(&data("README.md"))]);
    assert_eq!(code, 4, "{said}");
}

#[test]
fn a_file_that_is_not_there() {
    let (code, said) = run(&["replay", "/nowhere/at-all.trace"]);
    assert_eq!(code, 4, "{said}");
    assert_eq!(run(&["compare", "/nowhere/a.png", "/nowhere/b.png"]).0, 4);
}

#[test]
fn denoisers_are_measured_on_sequences() {
    let scene = data("../denoise/glossy.json");
    let mut document: serde_json::Value = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
    document.as_object_mut().unwrap().remove("sequence");
    let folder = tempfile::tempdir().unwrap();
    let still = folder.path().join("still.json");
    std::fs::write(&still, document.to_string()).unwrap();
    let (code, said) = run(&["bench", "denoise", "--scene", path(&still)]);
    assert_eq!((code, said.contains("no sequence")), (4, true), "{said}");
    assert_eq!(run(&["bench", "denoise", "--scene", "/nowhere/at-all.json"]).0, 4);
    assert_eq!(run(&["bench", "denoise", "--references", "/nowhere/at-all.npz"]).0, 2);
    assert_eq!(run(&["bench", "denoise", "--denoiser", "blur"]).0, 2);
}

#[test]
fn a_trace_that_is_cut_plays_up_to_the_cut() {
    let whole = std::fs::read(data("glxgears.trace")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let cut = folder.path().join("cut.trace");
    std::fs::write(&cut, &whole[..whole.len() * 9 / 10]).unwrap();
    let out = folder.path().join("out");
    let arguments = ["replay", path(&cut), "--mode", "raster", "--device", "lavapipe", "--out", path(&out)];
    let (code, said) = run(&arguments);
    assert_eq!(code, 4, "{said}");
    assert!(said.contains("cut"), "{said}");
    assert!(out.join("frame-000000.png").exists(), "{said}");
}

#[test]
fn no_such_device() {
    let trace = data("glxgears.trace");
    let (code, said) = run(&["replay", path(&trace), "--device", "a device that nobody has"]);
    assert_eq!(code, 3, "{said}");
    assert!(said.contains("doctor"), "{said}");
}

#[test]
fn absurd_arguments() {
    let trace = data("glxgears.trace");
    for arguments in
        [["--size", "0x0"], ["--size", "100000x9"], ["--frames", "9..3"], ["--spp", "0"], ["--every", "0"]]
    {
        let (code, said) = run(&["replay", path(&trace), arguments[0], arguments[1]]);
        assert_eq!(code, 2, "{arguments:?}: {said}");
    }
    let (code, said) =
        run(&["replay", path(&trace), "--mode", "raster", "--device", "lavapipe", "--frames", "5000"]);
    assert_eq!(code, 2, "{said}");
}

#[test]
fn random_damage_never_crashes() {
    let whole = std::fs::read(data("glxgears.trace")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for seed in 1..6u64 {
        let mut damaged = whole.clone();
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        for _ in 0..8 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let place = (state >> 33) as usize % damaged.len();
            damaged[place] ^= (state >> 20) as u8 | 1;
        }
        let file = folder.path().join(format!("{seed}.trace"));
        std::fs::write(&file, damaged).unwrap();
        let (code, said) = run(&["inspect", path(&file)]);
        assert!(code == 0 || code == 4, "seed {seed}: {code} {said}");
    }
}
