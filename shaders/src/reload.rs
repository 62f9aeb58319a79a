//! Shaders that change while a program runs: for development (feature `reload`).
//!
//! `AFTERGLOW_SHADERS` names a folder with the same files as this crate's: `pass` and `include`. Once a second the shaders
//! are compiled anew that a changed file is part of, by `glslc` (or what `GLSLC` names), with the feature `shaderc` by
//! that library. What is compiled takes the place of the built shader in [`current`].

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use crate::ALL;

/// How often files are looked at.
const PERIOD: Duration = Duration::from_secs(1);
/// Files that a shader is made of, at most.
const MOST_FILES: usize = 256;

/// Shaders that were compiled anew, by the path of their source.
static NEWER: Mutex<BTreeMap<&'static str, &'static [u32]>> = Mutex::new(BTreeMap::new());

/// A shader as it is now, by what it was built as.
pub fn current(built: &'static [u32]) -> &'static [u32] {
    let newer = NEWER.lock().unwrap_or_else(PoisonError::into_inner);
    let source = ALL.iter().find(|(_, words)| std::ptr::eq(*words, built)).map(|(source, _)| source);
    source.and_then(|source| newer.get(source).copied()).unwrap_or(built)
}

/// What has become of changed files.
#[derive(Debug, Default)]
pub struct Changes {
    /// Whether [`current`] has something new.
    pub has_new: bool,
    /// Why shaders are not, a line each.
    pub errors: Vec<String>,
}

/// Looks after a folder of shaders.
#[derive(Debug)]
pub struct Reloader {
    folder: PathBuf,
    next: Instant,
    /// When the newest file of each shader was changed, by the shader's place in [`ALL`].
    stamps: Vec<Option<SystemTime>>,
}

impl Reloader {
    /// Of the folder that `AFTERGLOW_SHADERS` names, if it does.
    pub fn from_environment() -> Option<Self> {
        let folder = std::env::var_os("AFTERGLOW_SHADERS").filter(|folder| !folder.is_empty())?;
        Some(Self::new(folder.into()))
    }

    /// Of a folder. Files that differ from those of the build count from their next change on.
    pub fn new(folder: PathBuf) -> Self {
        let stamps = ALL.iter().map(|(source, _)| newest(&folder, source)).collect();
        Self { folder, next: Instant::now() + PERIOD, stamps }
    }

    /// Compiles what has changed, unless files were looked at within the last second.
    pub fn poll(&mut self) -> Changes {
        let mut changes = Changes::default();
        if Instant::now() < self.next {
            return changes;
        }
        for (index, (source, _)) in ALL.iter().enumerate() {
            let stamp = newest(&self.folder, source);
            if std::mem::replace(&mut self.stamps[index], stamp) == stamp {
                continue;
            }
            match compile(&self.folder, source) {
                Ok(words) => {
                    let mut newer = NEWER.lock().unwrap_or_else(PoisonError::into_inner);
                    // Nobody counts who still uses a shader, and in development a few hundred kilobytes do not matter.
                    newer.insert(*source, words.leak());
                    changes.has_new = true;
                }
                Err(error) => changes.errors.push(error.lines().next().unwrap_or("no shader").to_owned()),
            }
        }
        self.next = Instant::now() + PERIOD;
        changes
    }
}

/// When the newest of the files was changed that a shader is made of.
fn newest(folder: &Path, source: &str) -> Option<SystemTime> {
    let mut files = BTreeSet::new();
    let mut found = vec![folder.join(source)];
    let mut newest = None;
    while let Some(file) = found.pop() {
        let Ok(file) = file.canonicalize() else { continue };
        if files.len() < MOST_FILES && files.insert(file.clone()) {
            newest = newest.max(file.metadata().and_then(|metadata| metadata.modified()).ok());
            found.extend(included(folder, &file));
        }
    }
    newest
}

/// Where the files may be that a file includes: beside it, or in the folder of all includes.
fn included(folder: &Path, file: &Path) -> Vec<PathBuf> {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let names = text.lines().filter_map(|line| line.trim().strip_prefix("#include \"")?.strip_suffix('"'));
    let beside = file.parent().unwrap_or(folder);
    names.flat_map(|name| [beside.join(name), folder.join("include").join(name)]).collect()
}

/// A shader's words.
#[cfg(not(feature = "shaderc"))]
fn compile(folder: &Path, source: &str) -> Result<Vec<u32>, String> {
    let compiler = std::env::var_os("GLSLC").unwrap_or_else(|| "glslc".into());
    let output = std::process::Command::new(&compiler)
        .current_dir(folder)
        .args(crate::options::OPTIONS)
        .args(["-o", "-", source])
        .output()
        .map_err(|error| format!("{}: {error}", compiler.display()))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    words(&output.stdout, source)
}

/// A shader's words.
#[cfg(feature = "shaderc")]
fn compile(folder: &Path, source: &str) -> Result<Vec<u32>, String> {
    use shaderc::{
        CompileOptions, Compiler, EnvVersion, OptimizationLevel, ResolvedInclude, ShaderKind, TargetEnv,
    };
    let failed = |error: &dyn std::fmt::Display| format!("{source}: {error}");
    let kind = match source.rsplit('.').next() {
        Some("vert") => ShaderKind::Vertex,
        Some("frag") => ShaderKind::Fragment,
        Some("comp") => ShaderKind::Compute,
        Some("rgen") => ShaderKind::RayGeneration,
        Some("rmiss") => ShaderKind::Miss,
        Some("rchit") => ShaderKind::ClosestHit,
        Some("rahit") => ShaderKind::AnyHit,
        Some("rint") => ShaderKind::Intersection,
        _ => return Err(failed(&"no stage is named so")),
    };
    let text = std::fs::read_to_string(folder.join(source)).map_err(|error| failed(&error))?;
    let mut options = CompileOptions::new().map_err(|error| failed(&error))?;
    options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_2 as u32);
    options.set_optimization_level(OptimizationLevel::Performance);
    options.set_warnings_as_errors();
    options.set_include_callback(|name, _, from, _| {
        let beside = folder.join(from).parent().unwrap_or(folder).join(name);
        let path = if beside.exists() { beside } else { folder.join("include").join(name) };
        let content =
            std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(ResolvedInclude { resolved_name: path.to_string_lossy().into_owned(), content })
    });
    let compiler = Compiler::new().map_err(|error| failed(&error))?;
    let compiled = compiler.compile_into_spirv(&text, kind, source, "main", Some(&options));
    words(compiled.map_err(|error| error.to_string())?.as_binary_u8(), source)
}

/// SPIR-V bytes as words.
fn words(bytes: &[u8], source: &str) -> Result<Vec<u32>, String> {
    let (words, rest) = bytes.as_chunks::<4>();
    let words: Vec<u32> = words.iter().map(|word| u32::from_le_bytes(*word)).collect();
    match (words.first(), rest) {
        (Some(&0x0723_0203), []) => Ok(words),
        _ => Err(format!("{source}: the compiler has written no SPIR-V")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shader_is_as_new_as_what_it_includes() {
        let folder = tempfile::tempdir().unwrap();
        let write = |path: &str, text: &str| {
            let path = folder.path().join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        };
        write("pass/a/a.comp", "#version 460\n#include \"b.glsl\"\n");
        write("pass/a/b.glsl", "#include \"c.glsl\"\n#include \"b.glsl\"\n#include \"none.glsl\"\n");
        write("include/c.glsl", "");
        let before = newest(folder.path(), "pass/a/a.comp");
        assert!(before.is_some());
        std::thread::sleep(Duration::from_millis(20));
        write("include/d.glsl", "");
        assert_eq!(newest(folder.path(), "pass/a/a.comp"), before);
        write("include/c.glsl", " ");
        assert!(newest(folder.path(), "pass/a/a.comp") > before);
    }

    #[test]
    fn what_is_compiled_is_the_same_as_what_was_built() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let (source, built) = ALL.iter().find(|(source, _)| source.contains("clear.frag")).unwrap();
        assert_eq!(compile(folder, source).unwrap(), *built);
        assert_eq!(current(built), *built);
        assert!(compile(folder, "pass/none.comp").is_err());
    }
}
