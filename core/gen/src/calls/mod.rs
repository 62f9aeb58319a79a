//! From a command to a call of a method of the GL context, as text. How an argument is read is the affair of a
//! [`Reader`]: the player takes it from a trace, an entry point from its parameter.

mod arguments;
mod family;
mod form;
mod plain;

pub use form::snake_case;
pub use plain::{is_count, is_result};

use crate::model::{Command, Model, ModelError};
use crate::rules::{Family, Rules};
use form::Form;

/// Writes expressions for arguments. `index` is a parameter's position; decoders are named by `arguments.rs`.
pub trait Reader {
    /// A scalar.
    fn scalar(&self, index: usize, decoder: &str) -> String;
    /// An array of as many elements as the context expects.
    fn vector(&self, index: usize, decoder: &str) -> String;
    /// The one element that a pointer points to.
    fn first(&self, index: usize, decoder: &str) -> String;
    /// Up to four elements, as many as the parameter's name has.
    fn few(&self, index: usize, decoder: &str) -> String;
    /// As many elements as the parameter at `count` says.
    fn list(&self, index: usize, count: usize, decoder: &str) -> String;
    /// An address that is kept.
    fn pointer(&self, index: usize) -> String;
    /// As many of them as the parameter at `count` says.
    fn pointers(&self, index: usize, count: usize) -> String;
    /// Memory, if this reader knows how much it is.
    fn bytes(&self, index: usize) -> Option<String>;
    /// Memory that may be missing, likewise.
    fn memory(&self, index: usize) -> Option<String>;
}

/// A call.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// The method.
    pub method: String,
    /// The expression.
    pub text: String,
    /// Whether the method gives what the command returns or writes.
    pub gives: bool,
}

/// How a command reaches the context.
pub enum Route<'a> {
    /// Through a hand-written function.
    Special(&'a str),
    /// Not at all.
    Unsupported,
    /// Through a method.
    Method(Call),
}

/// Commands in scope that are no aliases.
pub fn canonical_commands<'a>(model: &'a Model, rules: &Rules) -> impl Iterator<Item = &'a Command> {
    let names = rules.commands(model);
    names.into_iter().map(|name| &model.commands[name]).filter(|command| command.alias.is_none())
}

/// How a command that is no alias reaches the context.
///
/// # Errors
/// Where it is none or several of what the manifest can make of it.
pub fn route<'a>(command: &Command, rules: &'a Rules, reader: &dyn Reader) -> Result<Route<'a>, ModelError> {
    let play = &rules.play;
    let special = play.special.get(&command.name);
    let unsupported = play.unsupported.contains(&command.name);
    match (special, unsupported, family_of(command, &play.families)) {
        (Some(function), false, None) => Ok(Route::Special(function)),
        (None, true, _) => Ok(Route::Unsupported),
        (None, false, Some((family, form))) => family::call(command, family, form, reader).map(Route::Method),
        (None, false, None) => plain::call(command, rules, reader).map(Route::Method),
        _ => Err(unclear(&command.name, "is in several places of the manifest")),
    }
}

/// The family of a command, and how it differs from the others of it.
fn family_of<'a>(command: &Command, families: &'a [Family]) -> Option<(&'a Family, Form<'a>)> {
    families.iter().find_map(|family| {
        let form = |stem: &'a String| Form::of(&command.name, stem);
        family.stems.keys().find_map(form).map(|form| (family, form))
    })
}

/// A call of the method with these arguments.
fn method_call(method: &str, arguments: &[String]) -> String {
    format!("gl.{method}({})", arguments.join(", "))
}

/// An error of the manifest about a command.
pub fn unclear(command: &str, problem: &str) -> ModelError {
    ModelError::Rules { file: "manifests/gl-behaviours.toml", reason: format!("{command} {problem}") }
}
