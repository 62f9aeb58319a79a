//! `afterglow inspect`: what it says of draws, and the pictures it paints.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data").join(name)
}

fn inspect(trace: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_afterglow"));
    command.arg("inspect").arg(data(trace)).args(arguments);
    command.env_remove("AFTERGLOW_PROFILE").output().expect("the program starts")
}

fn text(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn draws_as_json_have_class_id_reason_and_triangles() {
    let report: Value = serde_json::from_str(&text(&inspect(
        "neverball.trace",
        &["--draws", "--frames", "3..5", "--json", "-"],
    )))
    .unwrap();
    let frames = report["frames"].as_array().unwrap();
    assert_eq!(frames.iter().map(|f| f["index"].as_u64().unwrap()).collect::<Vec<_>>(), [3, 4]);
    let frame = &frames[0];
    assert_eq!(frame["camera"]["view"].as_array().unwrap().len(), 16);
    let draws = frame["draws"].as_array().unwrap();
    let sum = |class: &str| -> u64 {
        let of_class = draws.iter().filter(|draw| draw["class"] == class);
        of_class.map(|draw| draw["triangles"].as_u64().unwrap()).sum()
    };
    for (class, count) in frame["triangles"].as_object().unwrap() {
        assert_eq!(sum(class), count.as_u64().unwrap(), "{class}");
    }
    for draw in draws {
        assert_eq!(draw["id"].as_str().unwrap().len(), 16);
        assert!(!draw["reason"].as_str().unwrap().is_empty());
    }
    assert!(draws.iter().any(|draw| draw["textures"][0].as_str().is_some_and(|hash| hash.len() == 16)));
}

#[test]
fn a_table_has_a_line_a_draw_and_a_summary() {
    let said = text(&inspect("glxgears.trace", &["--draws", "--frames", "2"]));
    assert!(said.starts_with("frame 2:"), "{said}");
    assert!(said.contains("1 frames (1 with a camera"), "{said}");
    assert!(said.lines().filter(|line| line.contains("; triangles")).count() >= 3, "{said}");
    assert!(text(&inspect("glxgears.trace", &["--classes"])).contains("means a frame"));
}

#[test]
fn frames_that_are_not_there() {
    let output = inspect("glxgears.trace", &["--draws", "--frames", "5000"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn pictures_are_painted_by_class() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    text(&inspect(
        "neverball.trace",
        &["--paint", out, "--frames", "3", "--size", "160x120", "--device", "lavapipe", "--validation"],
    ));
    for name in ["drawn", "class", "id", "layer", "light", "reason"] {
        assert!(folder.path().join(format!("frame-000003-{name}.png")).exists(), "{name}");
    }
    assert!(folder.path().join("legend.png").exists());
    let image = afterglow_metrics::io::load(&folder.path().join("frame-000003-class.png")).unwrap();
    assert_eq!((image.width(), image.height()), (160, 120));
    // Static is a grey, movable an orange, the sky a blue, however bright the program drew them.
    let share = |is: &dyn Fn([f32; 3]) -> bool| {
        image.pixels().iter().filter(|pixel| is(**pixel)).count() as f64 / image.pixels().len() as f64
    };
    assert!(share(&|[r, _, b]| r > 0.2 && b > 0.85 * r && b < r) > 0.1);
    assert!(share(&|[r, _, b]| b > 0.3 && r < 0.4 * b) > 0.1);
}

#[test]
fn only_what_is_asked_for_is_painted() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let frames = ["--frames", "2..7", "--every", "3", "--by", "class,id", "--device", "lavapipe"];
    text(&inspect("glxgears.trace", &[&["--paint", out], &frames[..]].concat()));
    let mut names: Vec<_> = std::fs::read_dir(out)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let of = |frame: u32| ["class", "drawn", "id"].map(|by| format!("frame-{frame:06}-{by}.png"));
    assert_eq!(names, [&of(2)[..], &of(5), &["legend.png".into()]].concat());
}

#[test]
fn a_proposal_changes_nothing_and_a_rule_of_it_does() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("proposal.toml");
    let path = file.to_str().unwrap();
    text(&inspect("neverball.trace", &["--propose", path, "--frames", "5"]));
    let classes = |profile: &str| {
        let said = text(&inspect("neverball.trace", &["--classes", "--frames", "5", "--profile", profile]));
        // The first line tells how long it took.
        said.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(classes(path), classes("none"));
    let proposal = std::fs::read_to_string(&file).unwrap();
    let start = proposal.find("# [[class]]").unwrap();
    let end = start + proposal[start..].find("\n\n").unwrap();
    let rule = proposal[start..end].replace("# ", "");
    let rule = rule.lines().map(|line| if line.starts_with("is =") { "is = \"dropped\"" } else { line });
    std::fs::write(&file, rule.collect::<Vec<_>>().join("\n")).unwrap();
    assert!(classes(path).iter().any(|line| line.ends_with("dropped: the profile says so")));
}

#[test]
fn a_profile_that_is_none_is_told_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bad.toml");
    std::fs::write(&file, "name = 'a'\n[[class]]\nis = 'nothing'\nwhen = { lit = true }\n").unwrap();
    let output = inspect("glxgears.trace", &["--classes", "--profile", file.to_str().unwrap()]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{said}");
    assert!(said.contains("bad.toml") && said.contains("line 3"), "{said}");
}
