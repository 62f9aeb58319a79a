//! Calls of commands that differ from others only in the number and type of components.

use super::arguments::{decoder, get, normalizer};
use super::form::Form;
use super::unclear;
use crate::model::{Base, Command, ModelError};
use crate::rules::{Family, FamilyKind};

/// What stands in for components that a form lacks.
const MISSING: [&str; 4] = ["0.0", "0.0", "0.0", "1.0"];
const NAMES: [&str; 4] = ["x", "y", "z", "w"];

/// The call of the family's method.
pub fn call(command: &Command, family: &Family, form: Form) -> Result<String, ModelError> {
    let method = &family.stems[form.stem];
    match family.kind {
        FamilyKind::Attribute => attribute(command, family, form, method),
        FamilyKind::Params => params(command, form, method),
        FamilyKind::Numbers => numbers(command, method),
        FamilyKind::Matrix => Ok(format!("gl.{method}(a.vector(0, float)?)")),
        FamilyKind::Get => get_state(command, method),
    }
}

fn attribute(command: &Command, family: &Family, form: Form, method: &str) -> Result<String, ModelError> {
    let decode = if family.normalized { normalizer(form.base) } else { "float" };
    let vectors = &family.vectors;
    let components = form.count.unwrap_or(vectors.iter().sum());
    let own = if form.vector { vectors.len() } else { components };
    let Some(leading) = command.params.len().checked_sub(own).filter(|_| !vectors.is_empty()) else {
        return Err(unclear(&command.name, "has too few parameters for its family"));
    };
    let mut arguments = scalars(command, leading)?;
    if form.vector {
        return vector_attribute(command, vectors, components, leading, decode, method, arguments);
    }
    let mut next = leading;
    for &size in vectors {
        let given = components.min(size);
        let values = (next..next + given).map(|index| get(index, decode)).collect();
        arguments.push(vector(values, size));
        next += given;
    }
    Ok(format!("gl.{method}({})", arguments.join(", ")))
}

/// The form with pointers: one for each vector.
fn vector_attribute(
    command: &Command,
    vectors: &[usize],
    components: usize,
    leading: usize,
    decode: &str,
    method: &str,
    mut arguments: Vec<String>,
) -> Result<String, ModelError> {
    if let [size] = vectors {
        let names: Vec<String> = NAMES[..components.min(4)].iter().map(|&name| name.into()).collect();
        let bound = names.join(", ");
        arguments.push(vector(names.into_iter().take(*size).collect(), *size));
        let arguments = arguments.join(", ");
        return Ok(format!("{{ let [{bound}] = a.vector({leading}, {decode})?; gl.{method}({arguments}) }}"));
    }
    if components != vectors.iter().sum::<usize>() {
        return Err(unclear(&command.name, "has several vectors with missing components"));
    }
    arguments.extend((0..vectors.len()).map(|i| format!("a.vector({}, {decode})?", leading + i)));
    Ok(format!("gl.{method}({})", arguments.join(", ")))
}

/// An array of `size` of the values and of what stands in for missing ones; one value alone is no array.
fn vector(values: Vec<String>, size: usize) -> String {
    if size == 1 {
        return values.concat();
    }
    let missing = MISSING[values.len()..size].iter().map(|&value| value.to_owned());
    format!("[{}]", values.into_iter().chain(missing).collect::<Vec<_>>().join(", "))
}

fn params(command: &Command, form: Form, method: &str) -> Result<String, ModelError> {
    let Some(last) = command.params.len().checked_sub(1) else {
        return Err(unclear(&command.name, "has no parameters"));
    };
    let (variant, decode) = match form.base {
        Base::Int => ("Ints", "int"),
        _ => ("Floats", "float"),
    };
    let values = match form.vector {
        true => format!("&a.few({last}, {decode})?"),
        false => format!("&[a.get({last}, {decode})?]"),
    };
    let mut arguments = scalars(command, last)?;
    arguments.push(format!("Params::{variant}({values})"));
    Ok(format!("gl.{method}({})", arguments.join(", ")))
}

fn numbers(command: &Command, method: &str) -> Result<String, ModelError> {
    let decode = |base: Base| match base {
        Base::Int | Base::Double => Some("float"),
        other => decoder(other),
    };
    let argument = |(index, param): (usize, &crate::model::Param)| {
        decode(param.ctype.base).map(|decoder| get(index, decoder))
    };
    let arguments: Option<Vec<_>> = command.params.iter().enumerate().map(argument).collect();
    let arguments = arguments.ok_or_else(|| unclear(&command.name, "takes more than numbers"))?;
    Ok(format!("gl.{method}({})", arguments.join(", ")))
}

/// All parameters but the pointers that results are written to.
fn get_state(command: &Command, method: &str) -> Result<String, ModelError> {
    let inputs = command.params.iter().take_while(|param| param.ctype.is_scalar()).count();
    Ok(format!("{{ let _ = gl.{method}({}); }}", scalars(command, inputs)?.join(", ")))
}

/// The first `count` arguments, which must be scalars.
fn scalars(command: &Command, count: usize) -> Result<Vec<String>, ModelError> {
    let params = command.params[..count].iter().enumerate();
    let arguments = params.map(|(index, param)| {
        let decoder = decoder(param.ctype.base).filter(|_| param.ctype.is_scalar());
        decoder.map(|decoder| get(index, decoder))
    });
    let arguments: Option<Vec<_>> = arguments.collect();
    arguments.ok_or_else(|| unclear(&command.name, "has pointers where its family has none"))
}
