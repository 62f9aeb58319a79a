//! One shader through `glslc`.

use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use crate::Shader;
use crate::options::OPTIONS;

/// Compiles the shader unless its SPIR-V is newer than all that it was made from.
pub fn compile_if_changed(shader: &Shader) -> Result<(), String> {
    let dependencies = shader.spirv.with_extension("d");
    if is_current(&shader.spirv, &dependencies) {
        return Ok(());
    }
    let compiler = std::env::var_os("GLSLC").unwrap_or_else(|| OsString::from("glslc"));
    let output = Command::new(&compiler)
        .args(OPTIONS)
        .args(["-MD", "-MF"])
        .arg(&dependencies)
        .arg("-o")
        .arg(&shader.spirv)
        .arg(&shader.source)
        .output();
    match output {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
        Err(error) if error.kind() == ErrorKind::NotFound => Err(format!(
            "The shader compiler {} was not found. Install glslc (Debian and Ubuntu: package glslc; also part of the \
             Vulkan SDK), or name it by the environment variable GLSLC.",
            compiler.display()
        )),
        Err(error) => Err(format!("could not run {}: {error}", compiler.display())),
    }
}

/// Whether the SPIR-V is newer than the sources that its dependency file lists, and than this build script.
fn is_current(spirv: &Path, dependencies: &Path) -> bool {
    let Some(built) = modified(spirv) else {
        return false;
    };
    let Ok(rule) = std::fs::read_to_string(dependencies) else {
        return false;
    };
    let Some((_, sources)) = rule.split_once(": ") else {
        return false;
    };
    let script = std::env::current_exe().unwrap_or_default();
    sources
        .split_whitespace()
        .map(PathBuf::from)
        .chain([script])
        .all(|source| modified(&source).is_some_and(|changed| changed < built))
}

fn modified(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).ok()?.modified().ok()
}
