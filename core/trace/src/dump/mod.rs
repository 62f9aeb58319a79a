//! Calls as text, one a line, in the notation of `apitrace dump`.
//!
//! ```text
//! 12 glMaterialfv(face = GL_FRONT, pname = GL_AMBIENT_AND_DIFFUSE, params = {0.8, 0.1, 0, 1})
//! 13 glGenLists(range = 1) = 1
//! ```
//!
//! It differs from `apitrace dump --multiline=no` only where that loses something: control characters in strings are
//! three octal digits, arguments beyond the signature have names, and GUIDs stay structures.

mod number;
mod text;

use std::fmt::{self, Display, Formatter};

use crate::call::Call;
use crate::signature::{BitmaskSignature, Signatures};
use crate::value::{StructValue, Value};
use number::General;
use text::{quote, quote_wide};

/// What a line shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// The call's number.
    pub numbers: bool,
    /// The thread, as `@` and a hexadecimal number.
    pub threads: bool,
    /// Names of arguments.
    pub names: bool,
}

impl Default for Style {
    /// As apitrace: numbers and names.
    fn default() -> Self {
        Self { numbers: true, threads: false, names: true }
    }
}

/// Displays a call as a line, without its end.
#[derive(Clone, Copy, Debug)]
pub struct CallLine<'a> {
    pub call: &'a Call,
    /// Of the trace that the call is from.
    pub signatures: &'a Signatures,
    pub style: Style,
}

impl<'a> CallLine<'a> {
    /// In the default style.
    pub fn new(call: &'a Call, signatures: &'a Signatures) -> Self {
        Self { call, signatures, style: Style::default() }
    }

    fn value(&self, value: &'a Value) -> ValueText<'a> {
        ValueText { value, signatures: self.signatures }
    }

    fn arguments(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let names = &self.signatures.function(self.call.signature).arg_names;
        for (index, value) in self.call.args.iter().enumerate() {
            separate(f, index)?;
            if self.style.names {
                match names.get(index) {
                    Some(name) => f.write_str(name)?,
                    None => write!(f, "arg{index}")?,
                }
                f.write_str(" = ")?;
            }
            self.value(value).fmt(f)?;
        }
        Ok(())
    }
}

impl Display for CallLine<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let call = self.call;
        if self.style.numbers {
            write!(f, "{} ", call.number)?;
        }
        if self.style.threads {
            write!(f, "@{:x} ", call.thread)?;
        }
        write!(f, "{}(", self.signatures.function(call.signature).name)?;
        self.arguments(f)?;
        f.write_str(")")?;
        if let Some(ret) = &call.ret {
            write!(f, " = {}", self.value(ret))?;
        }
        f.write_str(match (call.fake, call.complete) {
            (false, true) => "",
            (true, true) => " // fake",
            (false, false) => " // incomplete",
            (true, false) => " // fake incomplete",
        })
    }
}

/// Displays a value.
#[derive(Clone, Copy, Debug)]
pub struct ValueText<'a> {
    pub value: &'a Value,
    /// Of the trace that the value is from.
    pub signatures: &'a Signatures,
}

impl<'a> ValueText<'a> {
    fn of(&self, value: &'a Value) -> Self {
        Self { value, ..*self }
    }

    fn array(&self, f: &mut Formatter<'_>, values: &'a [Value]) -> fmt::Result {
        if let [value] = values {
            return write!(f, "&{}", self.of(value));
        }
        f.write_str("{")?;
        for (index, value) in values.iter().enumerate() {
            separate(f, index)?;
            self.of(value).fmt(f)?;
        }
        f.write_str("}")
    }

    /// Members of a structure, those of anonymous members among them; returns how many were written.
    fn members(
        &self,
        f: &mut Formatter<'_>,
        structure: &'a StructValue,
        mut written: usize,
    ) -> Result<usize, fmt::Error> {
        let names = &self.signatures.structure(structure.signature).member_names;
        for (name, value) in names.iter().zip(&structure.members) {
            if let (true, Value::Struct(inner)) = (name.is_empty(), value) {
                written = self.members(f, inner, written)?;
                continue;
            }
            separate(f, written)?;
            write!(f, "{name} = {}", self.of(value))?;
            written += 1;
        }
        Ok(written)
    }
}

impl Display for ValueText<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.value {
            Value::Absent => f.write_str("?"),
            Value::Null => f.write_str("NULL"),
            Value::Bool(value) => value.fmt(f),
            Value::SInt(value) => value.fmt(f),
            Value::UInt(value) => value.fmt(f),
            Value::Float(value) => General::float(*value).fmt(f),
            Value::Double(value) => General::double(*value).fmt(f),
            Value::String(bytes) => quote(f, bytes),
            Value::Blob(bytes) => write!(f, "blob({})", bytes.len()),
            Value::Enum { signature, value } => match self.signatures.enumeration(*signature).name(*value) {
                Some(name) => f.write_str(name),
                None => value.fmt(f),
            },
            Value::Bitmask { signature, value } => flags(f, self.signatures.bitmask(*signature), *value),
            Value::Array(values) => self.array(f, values),
            Value::Struct(structure) => {
                f.write_str("{")?;
                self.members(f, structure, 0)?;
                f.write_str("}")
            }
            Value::Pointer(address) => write!(f, "{address:#x}"),
            Value::Repr(pair) => self.of(&pair[0]).fmt(f),
            Value::WString(characters) => quote_wide(f, characters),
        }
    }
}

/// Names of a bitmask's flags, and the rest as a number.
fn flags(f: &mut Formatter<'_>, signature: &BitmaskSignature, mut value: u64) -> fmt::Result {
    let mut written = 0;
    for (name, flag) in &signature.flags {
        let set = match flag {
            0 => value == 0,
            _ => value & flag == *flag,
        };
        if set {
            f.write_str(if written == 0 { "" } else { " | " })?;
            f.write_str(name)?;
            written += 1;
            value &= !flag;
            if value == 0 {
                return Ok(());
            }
        }
    }
    f.write_str(if written == 0 { "" } else { " | " })?;
    write!(f, "{value:#x}")
}

fn separate(f: &mut Formatter<'_>, index: usize) -> fmt::Result {
    f.write_str(if index == 0 { "" } else { ", " })
}
