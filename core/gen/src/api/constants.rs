//! `constants.rs`: enumerants in scope as Rust constants.

use std::fmt::Write;

use crate::model::{Enumerant, Model};
use crate::rules::Rules;
use crate::rust::NOTICE;

/// The file: constants of OpenGL at its root, those of the window systems in modules.
pub fn constants(model: &Model, rules: &Rules) -> String {
    let section = |prefix: &str, indent: &str| {
        let mut wanted: Vec<&Enumerant> = model
            .enumerants
            .values()
            .filter(|enumerant| enumerant.name.starts_with(prefix) && rules.has_enumerant(enumerant))
            .collect();
        wanted.sort_by_key(|enumerant| (enumerant.value, &enumerant.name));
        wanted.iter().fold(String::new(), |mut text, Enumerant { name, value, .. }| {
            let _ = writeln!(text, "{indent}pub const {name}: u32 = {value:#06x};");
            text
        })
    };
    format!(
        "{NOTICE}\n{}\n/// Constants of GLX.\npub mod glx {{\n{}}}\n\n/// Constants of WGL.\npub mod wgl {{\n{}}}\n",
        section("GL_", ""),
        section("GLX_", "    "),
        section("WGL_", "    ")
    )
}
