//! The Rust text that holds the SPIR-V.

use std::fmt::Write;
use std::path::Path;

use crate::Shader;

/// Writes one `pub static NAME: &[u32]` a shader, and a list of them all.
pub fn write(shaders: &[Shader], path: &Path) -> Result<(), String> {
    let mut text = String::new();
    for shader in shaders {
        let bytes = std::fs::metadata(&shader.spirv)
            .map_err(|error| format!("could not read {}: {error}", shader.spirv.display()))?
            .len();
        let source = shader.source.display();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "/// `{source}`.\npub static {}: &[u32] = &words::<{}>(include_bytes!({:?}));",
            shader.constant,
            bytes / 4,
            shader.spirv
        );
    }
    text += "/// Every shader: its source's path, and its words.\n#[cfg(feature = \"reload\")]\n";
    text += "pub static ALL: &[(&str, &[u32])] = &[\n";
    for shader in shaders {
        let _ = writeln!(text, "    ({:?}, {}),", shader.source, shader.constant);
    }
    text += "];\n";
    std::fs::write(path, text).map_err(|error| format!("could not write {}: {error}", path.display()))
}
