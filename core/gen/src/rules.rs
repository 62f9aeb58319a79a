//! The project's own rules about entry points: `manifests/gl-behaviours.toml`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::Deserialize;

use crate::model::{Api, Base, CType, Command, Enumerant, Model, ModelError};

const FILE: &str = "manifests/gl-behaviours.toml";

/// The manifest.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rules {
    scope: Scope,
    aliases: BTreeMap<String, String>,
    libgl: LibGl,
    /// How calls reach the context.
    pub play: Play,
    /// What is different for entry points.
    pub export: Export,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Scope {
    version: String,
    extensions: Vec<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LibGl {
    names: Vec<String>,
}

/// How a trace's calls reach the methods of the GL context.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Play {
    /// Hand-written functions of commands.
    pub special: BTreeMap<String, String>,
    /// Commands without a method.
    pub unsupported: BTreeSet<String>,
    /// Commands that have no effect which the trace does not hold already.
    pub without_effect: BTreeSet<String>,
    /// Parameters that a method does not have, by command.
    pub dropped: BTreeMap<String, String>,
    /// Commands whose memory of pixels may not be missing.
    pub required_memory: BTreeSet<String>,
    /// Method of a plain command, where it has another name.
    pub methods: BTreeMap<String, String>,
    /// Commands that differ in the number and type of components.
    #[serde(rename = "family")]
    pub families: Vec<Family>,
}

impl Play {
    /// A name in the manifest that is none of the commands.
    pub fn unknown_name<'a>(&self, commands: impl Iterator<Item = &'a Command>) -> Option<&str> {
        let known: BTreeSet<&str> = commands.map(|command| command.name.as_str()).collect();
        let sets = [&self.unsupported, &self.without_effect, &self.required_memory];
        let maps = [&self.special, &self.dropped, &self.methods];
        let names = sets.into_iter().flatten().chain(maps.into_iter().flat_map(BTreeMap::keys));
        names.map(String::as_str).find(|name| !known.contains(name))
    }
}

/// Where the entry points differ from a trace's calls.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Export {
    /// Commands with hand-written functions, besides those of [`Play::special`].
    pub special: BTreeSet<String>,
    /// Methods that cannot panic.
    pub plainly: BTreeSet<String>,
}

impl Export {
    /// A name in the manifest that is none of the commands.
    pub fn unknown_name(&self, commands: &[&Command]) -> Option<&str> {
        let known: BTreeSet<&str> = commands.iter().map(|command| command.name.as_str()).collect();
        self.special.iter().map(String::as_str).find(|name| !known.contains(name))
    }
}

/// Families of the same kind.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Family {
    /// What arguments mean.
    pub kind: FamilyKind,
    /// Method by stem.
    pub stems: BTreeMap<String, String>,
    /// Sizes of the vectors that the method takes, if it takes attributes.
    #[serde(default)]
    pub vectors: Vec<usize>,
    /// Integers are fractions.
    #[serde(default)]
    pub normalized: bool,
}

/// What the arguments of a family mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FamilyKind {
    /// Vectors.
    Attribute,
    /// Scalar or vector at the end.
    Params,
    /// Numbers that are converted to floats.
    Numbers,
    /// A matrix.
    Matrix,
    /// Results.
    Get,
}

impl Rules {
    /// Reads the manifest of the repository at `root`.
    ///
    /// # Errors
    /// Those of reading, and of what the file says.
    pub fn load(root: impl AsRef<Path>) -> Result<Rules, ModelError> {
        let text = crate::model::read(root.as_ref(), FILE)?;
        toml::from_str(&text).map_err(|error| rule_error(error.to_string()))
    }

    /// Adds to the model what the XML does not say.
    ///
    /// # Errors
    /// Where an alias has no command.
    pub fn amend(&self, model: &mut Model) -> Result<(), ModelError> {
        for (name, alias) in &self.aliases {
            if !model.commands.contains_key(alias) {
                return Err(rule_error(format!("no command {alias}")));
            }
            let command = model.commands.get_mut(name);
            command.ok_or_else(|| rule_error(format!("no command {name}")))?.alias = Some(alias.clone());
        }
        for name in &self.libgl.names {
            model.commands.entry(name.clone()).or_insert_with(|| nameless(name));
        }
        Ok(())
    }

    /// Names of the commands of OpenGL in scope: those of its versions and extensions, with all their aliases.
    pub fn commands<'a>(&self, model: &'a Model) -> BTreeSet<&'a str> {
        let canonical = |command: &'a Command| model.canonical(&command.name).map(|c| c.name.as_str());
        let of_gl = || model.commands.values().filter(|command| command.api == Api::Gl);
        let wanted: BTreeSet<_> =
            of_gl().filter(|command| self.has_any(&command.origins)).filter_map(canonical).collect();
        of_gl()
            .filter(|command| canonical(command).is_some_and(|name| wanted.contains(name)))
            .map(|command| command.name.as_str())
            .collect()
    }

    /// Whether an enumerant is in scope; those of GLX and WGL all are.
    pub fn has_enumerant(&self, enumerant: &Enumerant) -> bool {
        !enumerant.name.starts_with("GL_") || self.has_any(&enumerant.origins)
    }

    fn has_any(&self, origins: &[String]) -> bool {
        origins.iter().any(|origin| match origin.strip_prefix("GL_VERSION_") {
            Some(version) => version.replace('_', ".") <= self.scope.version,
            None => self.scope.extensions.contains(origin),
        })
    }

    /// Extensions in scope that nothing in the model belongs to: misspelt, or without names of their own.
    #[cfg(test)]
    fn unknown_extensions(&self, model: &Model) -> Vec<&String> {
        let commands = model.commands.values().flat_map(|command| &command.origins);
        let enumerants = model.enumerants.values().flat_map(|enumerant| &enumerant.origins);
        let known: BTreeSet<_> = commands.chain(enumerants).collect();
        self.scope.extensions.iter().filter(|extension| !known.contains(extension)).collect()
    }
}

/// A command of which nothing but the name is known.
fn nameless(name: &str) -> Command {
    Command {
        name: name.into(),
        api: if name.starts_with("glX") { Api::Glx } else { Api::Gl },
        result: CType { base: Base::Void, pointers: 0, constant: false },
        params: Vec::new(),
        alias: None,
        origins: Vec::new(),
    }
}

fn rule_error(reason: String) -> ModelError {
    ModelError::Rules { file: FILE, reason }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Sources;

    #[test]
    fn the_scope_is_that_of_the_manifest() {
        let mut model = Sources::load(crate::tests::ROOT).unwrap().model().unwrap();
        let rules = Rules::load(crate::tests::ROOT).unwrap();
        rules.amend(&mut model).unwrap();
        let commands = rules.commands(&model);
        let has = |name: &str| commands.contains(name);
        assert!(has("glVertex3f") && has("glBufferData") && has("glBufferDataARB"));
        assert!(has("glLockArraysEXT") && has("glGenTexturesEXT"));
        // Later than 1.5, but an extension of the time has it by another name.
        assert!(has("glBlendEquationSeparate"));
        assert!(!has("glUseProgram") && !has("glXSwapBuffers") && !has("glPrimitiveRestart"));
        // These have no names of their own.
        let nameless = [
            "GL_ARB_texture_env_add",
            "GL_ARB_texture_env_crossbar",
            "GL_EXT_shadow_funcs",
            "GL_EXT_texture_env_add",
            "GL_NV_blend_square",
        ];
        assert_eq!(rules.unknown_extensions(&model), nameless);
    }
}
