//! Writes every generated file that is checked in.
//!
//! [`outputs`] computes the texts from the repository's sources; nothing else goes in, so that running
//! the generator twice changes nothing.

mod api;
mod calls;
mod exports;
#[cfg(feature = "glsl")]
mod glsl;
pub mod model;
mod output;
mod player;
mod rules;
mod rust;

use std::path::Path;

use model::{Model, ModelError, Sources};
pub use output::{Output, differing, write};
pub use rules::Rules;

/// All generated files of the repository at `root`.
///
/// # Errors
/// Where the registry or a manifest cannot be read.
pub fn outputs(root: impl AsRef<Path>) -> Result<Vec<Output>, ModelError> {
    let (model, rules) = sources(root.as_ref())?;
    let mut outputs = vec![
        Output::new("core/api/src/generated/constants.rs", api::constants(&model, &rules)),
        Output::new("core/api/src/generated/commands.rs", api::commands(&model, &rules)),
        Output::new("core/api/src/generated/ids.rs", api::ids(&model, &rules)),
        Output::new("core/api/src/generated/enum_names.rs", api::enum_names(&model, &rules)),
        Output::new("core/player/src/generated/dispatch.rs", player::dispatch(&model, &rules)?),
        Output::new("gl-shim/src/generated/exports.rs", exports::exports(&model, &rules)?),
        Output::new("gl-shim/src/generated/proc_table.rs", exports::proc_table(&model)),
    ];
    outputs.extend(shader_outputs());
    Ok(outputs)
}

/// The model of the repository at `root` as its manifest amends it.
fn sources(root: &Path) -> Result<(Model, Rules), ModelError> {
    let rules = Rules::load(root)?;
    let mut model = Sources::load(root)?.model()?;
    rules.amend(&mut model)?;
    Ok((model, rules))
}

#[cfg(feature = "glsl")]
fn shader_outputs() -> Vec<Output> {
    vec![
        Output::new("shaders/include/generated/state_words.glsl", glsl::state_words()),
        Output::new("shaders/include/generated/gl_blocks.glsl", glsl::gl_blocks()),
        Output::new("shaders/include/generated/records.glsl", glsl::records()),
        Output::new("shaders/include/generated/pathtrace.glsl", glsl::pathtrace()),
    ]
}

#[cfg(not(feature = "glsl"))]
fn shader_outputs() -> Vec<Output> {
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The repository, seen from this crate.
    pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

    /// The repository's model.
    pub fn model() -> (Model, Rules) {
        sources(ROOT.as_ref()).unwrap()
    }

    #[test]
    fn what_is_checked_in_is_what_is_generated() {
        let outputs = outputs(ROOT).unwrap();
        let stale: Vec<_> = differing(ROOT.as_ref(), &outputs).iter().map(|output| output.path).collect();
        assert!(stale.is_empty(), "run ./x gen: {stale:?}");
    }
}
