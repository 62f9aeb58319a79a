//! Compiles every shader under `pass/` to SPIR-V with `glslc` and writes one constant for each.
//!
//! `pass/NAME/NAME.vert` becomes `NAME_VERT`, `pass/NAME/OTHER.comp` becomes `NAME_OTHER_COMP`. A shader is compiled
//! again only if it or a file that it includes is newer than its SPIR-V. Another compiler can be named by `GLSLC`.

mod compile;
mod constants;
mod options;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A shader's source and what it is called.
pub struct Shader {
    /// The source file.
    pub source: PathBuf,
    /// Name of the constant.
    pub constant: String,
    /// Where the SPIR-V goes.
    pub spirv: PathBuf,
}

const STAGES: [&str; 8] = ["vert", "frag", "comp", "rgen", "rmiss", "rchit", "rahit", "rint"];

fn main() -> ExitCode {
    for input in ["pass", "include", "build"] {
        println!("cargo::rerun-if-changed={input}");
    }
    println!("cargo::rerun-if-env-changed=GLSLC");
    match build() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn build() -> Result<(), String> {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").ok_or("OUT_DIR is not set")?);
    let shaders = find_shaders(Path::new("pass"), &out)?;
    compile_all(&shaders)?;
    constants::write(&shaders, &out.join("shaders.rs"))
}

/// The shaders in the folders of `root`, by name, so that the generated text is always the same.
fn find_shaders(root: &Path, out: &Path) -> Result<Vec<Shader>, String> {
    let mut shaders = Vec::new();
    for folder in entries(root)?.iter().filter(|path| path.is_dir()) {
        for source in entries(folder)? {
            let Some(stage) = extension(&source).filter(|stage| STAGES.contains(stage)) else {
                continue;
            };
            let constant = constant_name(folder, &source, stage);
            let spirv = out.join(format!("{}.spv", constant.to_lowercase()));
            shaders.push(Shader { source, constant, spirv });
        }
    }
    shaders.sort_by(|a, b| a.constant.cmp(&b.constant));
    Ok(shaders)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let reading = |error| format!("could not read {}: {error}", folder.display());
    let mut paths = std::fs::read_dir(folder)
        .map_err(reading)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()
        .map_err(reading)?;
    paths.sort();
    Ok(paths)
}

fn extension(path: &Path) -> Option<&str> {
    path.extension()?.to_str()
}

fn constant_name(folder: &Path, source: &Path, stage: &str) -> String {
    let name = |path: &Path| {
        let stem = path.file_stem().unwrap_or_default();
        stem.to_string_lossy().replace('-', "_")
    };
    let (pass, file) = (name(folder), name(source));
    let words = if pass == file { format!("{pass}_{stage}") } else { format!("{pass}_{file}_{stage}") };
    words.to_uppercase()
}

/// Compiles what has changed, as many shaders at once as Cargo allows; reports every failure.
fn compile_all(shaders: &[Shader]) -> Result<(), String> {
    let jobs = std::env::var("NUM_JOBS").ok();
    let jobs = jobs.and_then(|jobs| jobs.parse().ok()).unwrap_or(1_usize);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut failures = Vec::new();
        while let Some(shader) = shaders.get(next.fetch_add(1, Ordering::Relaxed)) {
            failures.extend(compile::compile_if_changed(shader).err());
        }
        failures
    };
    let failures: Vec<String> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs.min(shaders.len()).max(1)).map(|_| scope.spawn(work)).collect();
        workers
            .into_iter()
            .flat_map(|worker| {
                worker.join().unwrap_or_else(|_| vec!["a compiling thread panicked".to_owned()])
            })
            .collect()
    });
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}
