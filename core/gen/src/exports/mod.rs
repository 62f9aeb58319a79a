//! Entry points of `libGL.so.1`: `exports.rs` and `proc_table.rs` of gl-shim.

mod ctypes;
mod parameters;

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::calls::{self, Call, Route, is_count, is_result, snake_case, unclear};
use crate::model::{Api, Base, CType, Command, Model, ModelError, Param};
use crate::rules::Rules;
use crate::rust::NOTICE;
use ctypes::{result_type, rust_type};
use parameters::{Parameters, identifier};

const EXPORTS_HEAD: &str = "
#![allow(
    unused_unsafe,
    unused_variables,
    clippy::too_many_arguments,
    reason = \"parameters are OpenGL's, and not every command needs all that an entry point offers\"
)]

use std::ffi::c_void;

use afterglow_api::constants::GL_INVALID_VALUE;
use afterglow_gl::Params;

use crate::boundary::{with_context, with_context_plainly};
use crate::export::{exports, refusals, stubs};
use crate::{memory, number, special};
";

/// The file: a function for each name of OpenGL that there is.
///
/// # Errors
/// Where the manifest does not say how a command in scope reaches the context.
pub fn exports(model: &Model, rules: &Rules) -> Result<String, ModelError> {
    let canonical: Vec<&Command> = calls::canonical_commands(model, rules).collect();
    if let Some(name) = rules.export.unknown_name(&canonical) {
        return Err(unclear(name, "is no command in scope, or an alias"));
    }
    let classic = rules.commands(model);
    let (mut exported, mut refused, mut stubs) = (String::new(), String::new(), String::new());
    for name in names(model) {
        if !classic.contains(name) {
            let _ = writeln!(stubs, "    {name}");
            continue;
        }
        let command = &model.commands[name];
        let canonical = model.canonical(name).unwrap_or(command);
        if !are_alike(command, canonical) {
            return Err(unclear(name, "takes other types than the command that it is an alias of"));
        }
        match body(canonical, rules)? {
            Some(body) => {
                let _ = writeln!(exported, "    fn {name}{} = {body};", declaration(canonical)?);
            }
            None => {
                let _ = writeln!(refused, "    fn {name}{};", declaration(canonical)?);
            }
        }
    }
    Ok(format!(
        "{NOTICE}{EXPORTS_HEAD}
exports! {{\n{exported}}}
\n// In scope, but the context has no method for them.
refusals! {{\n{refused}}}
\n// Out of scope.
stubs! {{\n{stubs}}}\n"
    ))
}

/// The file: addresses of all these functions, ordered by name.
pub fn proc_table(model: &Model) -> String {
    let names = names(model);
    let mut text = format!(
        "{NOTICE}
use super::exports::*;
use crate::proc_address::{{Entry, entry}};

pub static TABLE: [Entry; {}] = [\n",
        names.len()
    );
    for name in names {
        let _ = writeln!(text, "    entry({name:?}, {name} as _),");
    }
    text + "];\n"
}

/// All names of OpenGL that are exported, ordered.
fn names(model: &Model) -> BTreeSet<&str> {
    let of_gl = model.commands.values().filter(|command| command.api == Api::Gl);
    of_gl.map(|command| command.name.as_str()).collect()
}

/// Types of parameters and result, which make the binary interface.
fn signature(command: &Command) -> Result<(Vec<String>, String), ModelError> {
    let params = command.params.iter().map(|param| rust_type(param.ctype));
    let params: Option<Vec<String>> = params.collect();
    let signature = params.zip(result_type(command.result));
    signature.ok_or_else(|| unclear(&command.name, "has a type that is none of OpenGL 1.x"))
}

/// Whether both are called in the same way; that an integer has a sign makes no difference.
fn are_alike(a: &Command, b: &Command) -> bool {
    let passed = |ctype: CType| {
        let passed = if ctype.pointers > 0 { Some("pointer".into()) } else { rust_type(ctype) };
        passed.map(|name| name.replace('u', "i"))
    };
    let types = |command: &Command| {
        let params = command.params.iter().map(|param| param.ctype);
        params.chain([command.result]).map(passed).collect::<Vec<_>>()
    };
    types(a) == types(b)
}

/// `(target: u32, v: *const f32) -> u8`.
fn declaration(command: &Command) -> Result<String, ModelError> {
    let (types, result) = signature(command)?;
    let params = command.params.iter().zip(types);
    let params: Vec<_> = params.map(|(param, ctype)| format!("{}: {ctype}", identifier(param))).collect();
    Ok(format!("({}){result}", params.join(", ")))
}

/// The boundary and the expression of a command; `None` if it is unsupported.
fn body(command: &Command, rules: &Rules) -> Result<Option<String>, ModelError> {
    if rules.export.special.contains(&command.name) {
        return Ok(Some(special(command)));
    }
    Ok(match calls::route(command, rules, &Parameters(command))? {
        Route::Special(_) => Some(special(command)),
        Route::Unsupported => None,
        Route::Method(call) => {
            let boundary = match rules.export.plainly.contains(&call.method) {
                true => "with_context_plainly",
                false => "with_context",
            };
            Some(format!("{boundary}(gl) => {}", expression(command, call)?))
        }
    })
}

/// A call of the hand-written function that has the command's name.
fn special(command: &Command) -> String {
    let params: Vec<_> =
        std::iter::once("gl".to_owned()).chain(command.params.iter().map(identifier)).collect();
    let call = format!("special::{}({})", snake_case(&command.name), params.join(", "));
    format!("with_context(gl) => {}", returned(command, call))
}

/// The call of a method with what becomes of its result, and a check of counts.
fn expression(command: &Command, call: Call) -> Result<String, ModelError> {
    let results: Vec<_> = command.params.iter().filter(|param| is_result(param)).map(written).collect();
    let returns = result_type(command.result).is_some_and(|result| !result.is_empty());
    let text = match results.as_slice() {
        [] if command.result.pointers > 0 => None,
        [] => Some(returned(command, call.text)),
        [result] if !returns => Some(format!("memory::store({}, {result})", call.text)),
        _ => None,
    };
    let text =
        text.ok_or_else(|| unclear(&command.name, "gives results that need a function of their own"))?;
    let mut counts = command.params.iter().enumerate().filter(|(index, _)| is_count(command, *index));
    Ok(match counts.next() {
        Some((_, count)) => {
            let count = identifier(count);
            format!("if {count} < 0 {{ gl.record_error(GL_INVALID_VALUE) }} else {{ {text} }}")
        }
        None => text,
    })
}

/// The pointer that a result is written to; results without a type are bytes.
fn written(param: &Param) -> String {
    match (param.ctype.base, param.ctype.pointers) {
        (Base::Void, 1) => format!("{}.cast::<u8>()", identifier(param)),
        _ => identifier(param),
    }
}

fn returned(command: &Command, call: String) -> String {
    match (command.result.base, command.result.pointers) {
        (Base::Boolean, 0) => format!("u8::from({call})"),
        _ => call,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &str, name: &str) -> String {
        let start = format!("fn {name}(");
        let mut lines = text.lines().map(str::trim).filter(|line| line.starts_with(&start));
        lines.next().unwrap_or_else(|| panic!("no {name}")).into()
    }

    #[test]
    fn parameters_become_arguments() {
        let (model, rules) = crate::tests::model();
        let text = exports(&model, &rules).unwrap();
        let line = |name| line(&text, name);
        assert_eq!(
            line("glVertex2i"),
            "fn glVertex2i(x: i32, y: i32) = with_context_plainly(gl) => \
             gl.vertex([number::float(x), number::float(y), 0.0, 1.0]);"
        );
        assert_eq!(
            line("glColor3ubv"),
            "fn glColor3ubv(v: *const u8) = with_context_plainly(gl) => \
             { let [x, y, z] = memory::vector(v, number::unorm8); gl.color([x, y, z, 1.0]) };"
        );
        assert_eq!(
            line("glDeleteTextures"),
            "fn glDeleteTextures(n: i32, textures: *const u32) = with_context(gl) => \
             if n < 0 { gl.record_error(GL_INVALID_VALUE) } else { \
             gl.delete_textures(&memory::list(textures, n, number::uint)) };"
        );
        assert_eq!(
            line("glIsTextureEXT"),
            "fn glIsTextureEXT(texture: u32) -> u8 = with_context(gl) => u8::from(gl.is_texture(texture));"
        );
        assert_eq!(
            line("glGetLightiv"),
            "fn glGetLightiv(light: u32, pname: u32, params: *mut i32) = with_context(gl) => \
             memory::store(gl.get_light(light, pname), params);"
        );
    }

    #[test]
    fn every_name_has_one_function() {
        let (model, rules) = crate::tests::model();
        let text = exports(&model, &rules).unwrap();
        let lines = text.lines().filter_map(|line| line.strip_prefix("    "));
        let starts = lines.map(|line| line.trim_start_matches("fn ").split('(').next().unwrap());
        let mut found: Vec<_> = starts.filter(|name| name.starts_with("gl")).collect();
        found.sort_unstable();
        assert!(found.iter().copied().eq(names(&model)));
    }
}
