//! Calls of commands that differ from others only in the number and type of components.

use super::arguments::{decoder, normalizer};
use super::form::Form;
use super::{Call, Reader, unclear};
use crate::model::{Base, Command, ModelError, Param};
use crate::rules::{Family, FamilyKind};

/// What stands in for components that a form lacks.
const MISSING: [&str; 4] = ["0.0", "0.0", "0.0", "1.0"];
const NAMES: [&str; 4] = ["x", "y", "z", "w"];

/// The call of the family's method.
pub fn call(command: &Command, family: &Family, form: Form, reader: &dyn Reader) -> Result<Call, ModelError> {
    let method = &family.stems[form.stem];
    let writer = Writer { command, method, reader };
    let text = match family.kind {
        FamilyKind::Attribute => writer.attribute(family, form),
        FamilyKind::Params => writer.params(form),
        FamilyKind::Numbers => writer.numbers(),
        FamilyKind::Matrix => Ok(writer.call(&[reader.vector(0, "float")])),
        FamilyKind::Get => writer.get_state(),
    }?;
    Ok(Call { method: method.clone(), text, gives: family.kind == FamilyKind::Get })
}

/// Writes the call of one command.
struct Writer<'a> {
    command: &'a Command,
    method: &'a str,
    reader: &'a dyn Reader,
}

impl Writer<'_> {
    fn call(&self, arguments: &[String]) -> String {
        super::method_call(self.method, arguments)
    }

    fn unclear(&self, problem: &str) -> ModelError {
        unclear(&self.command.name, problem)
    }

    fn attribute(&self, family: &Family, form: Form) -> Result<String, ModelError> {
        let decode = if family.normalized { normalizer(form.base) } else { "float" };
        let vectors = &family.vectors;
        let components = form.count.unwrap_or(vectors.iter().sum());
        let own = if form.vector { vectors.len() } else { components };
        let leading = self.command.params.len().checked_sub(own).filter(|_| !vectors.is_empty());
        let leading = leading.ok_or_else(|| self.unclear("has too few parameters for its family"))?;
        let mut arguments = self.scalars(leading)?;
        if form.vector {
            return self.vector_attribute(vectors, components, leading, decode, arguments);
        }
        let mut next = leading;
        for &size in vectors {
            let given = components.min(size);
            let values = (next..next + given).map(|index| self.reader.scalar(index, decode)).collect();
            arguments.push(vector(values, size));
            next += given;
        }
        Ok(self.call(&arguments))
    }

    /// The form with pointers: one for each vector.
    fn vector_attribute(
        &self,
        vectors: &[usize],
        components: usize,
        leading: usize,
        decode: &str,
        mut arguments: Vec<String>,
    ) -> Result<String, ModelError> {
        if let [size] = vectors {
            let names: Vec<String> = NAMES[..components.min(4)].iter().map(|&name| name.into()).collect();
            let bound = names.join(", ");
            arguments.push(vector(names.into_iter().take(*size).collect(), *size));
            let (vector, call) = (self.reader.vector(leading, decode), self.call(&arguments));
            return Ok(format!("{{ let [{bound}] = {vector}; {call} }}"));
        }
        if components != vectors.iter().sum::<usize>() {
            return Err(self.unclear("has several vectors with missing components"));
        }
        arguments.extend((0..vectors.len()).map(|i| self.reader.vector(leading + i, decode)));
        Ok(self.call(&arguments))
    }

    fn params(&self, form: Form) -> Result<String, ModelError> {
        let last = self.command.params.len().checked_sub(1);
        let last = last.ok_or_else(|| self.unclear("has no parameters"))?;
        let (variant, decode) = match form.base {
            Base::Int => ("Ints", "int"),
            _ => ("Floats", "float"),
        };
        let values = match form.vector {
            true => format!("&{}", self.reader.few(last, decode)),
            false => format!("&[{}]", self.reader.scalar(last, decode)),
        };
        let mut arguments = self.scalars(last)?;
        arguments.push(format!("Params::{variant}({values})"));
        Ok(self.call(&arguments))
    }

    fn numbers(&self) -> Result<String, ModelError> {
        let decode = |base: Base| match base {
            Base::Int | Base::Double => Some("float"),
            other => decoder(other),
        };
        let argument = |(index, param): (usize, &Param)| {
            decode(param.ctype.base).map(|decoder| self.reader.scalar(index, decoder))
        };
        let arguments: Option<Vec<_>> = self.command.params.iter().enumerate().map(argument).collect();
        Ok(self.call(&arguments.ok_or_else(|| self.unclear("takes more than numbers"))?))
    }

    /// All parameters but the pointers that results are written to.
    fn get_state(&self) -> Result<String, ModelError> {
        let inputs = self.command.params.iter().take_while(|param| param.ctype.is_scalar()).count();
        Ok(self.call(&self.scalars(inputs)?))
    }

    /// The first `count` arguments, which must be scalars.
    fn scalars(&self, count: usize) -> Result<Vec<String>, ModelError> {
        let params = self.command.params[..count].iter().enumerate();
        let arguments = params.map(|(index, param)| {
            let decoder = decoder(param.ctype.base).filter(|_| param.ctype.is_scalar());
            decoder.map(|decoder| self.reader.scalar(index, decoder))
        });
        let arguments: Option<Vec<_>> = arguments.collect();
        arguments.ok_or_else(|| self.unclear("has pointers where its family has none"))
    }
}

/// An array of `size` of the values and of what stands in for missing ones; one value alone is no array.
fn vector(values: Vec<String>, size: usize) -> String {
    if size == 1 {
        return values.concat();
    }
    let missing = MISSING[values.len()..size].iter().map(|&value| value.to_owned());
    format!("[{}]", values.into_iter().chain(missing).collect::<Vec<_>>().join(", "))
}
