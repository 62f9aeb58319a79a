//! Expressions that read an entry point's parameters, with the functions of `gl-shim/src/memory.rs` and
//! `gl-shim/src/number.rs`.

use crate::calls::Reader;
use crate::model::{Base, Command, Param};

/// The parameters of a command.
pub struct Parameters<'a>(pub &'a Command);

impl Parameters<'_> {
    fn name(&self, index: usize) -> String {
        identifier(&self.0.params[index])
    }

    fn base(&self, index: usize) -> Base {
        self.0.params[index].ctype.base
    }
}

impl Reader for Parameters<'_> {
    fn scalar(&self, index: usize, decoder: &str) -> String {
        let name = self.name(index);
        if is_same(self.base(index), decoder) { name } else { format!("number::{decoder}({name})") }
    }

    fn vector(&self, index: usize, decoder: &str) -> String {
        format!("memory::vector({}, number::{decoder})", self.name(index))
    }

    fn first(&self, index: usize, decoder: &str) -> String {
        format!("memory::first({}, number::{decoder})", self.name(index))
    }

    fn few(&self, index: usize, decoder: &str) -> String {
        format!("memory::few({}, pname, number::{decoder})", self.name(index))
    }

    fn list(&self, index: usize, count: usize, decoder: &str) -> String {
        format!("memory::list({}, {}, number::{decoder})", self.name(index), self.name(count))
    }

    fn pointer(&self, index: usize) -> String {
        format!("memory::pointer({}.cast())", self.name(index))
    }

    fn pointers(&self, index: usize, count: usize) -> String {
        format!("memory::list({}, {}, memory::pointer)", self.name(index), self.name(count))
    }

    // How much memory a command reads depends on what this cannot know.
    fn bytes(&self, _: usize) -> Option<String> {
        None
    }

    fn memory(&self, _: usize) -> Option<String> {
        None
    }
}

/// Whether the decoder leaves a number of that type as it is.
fn is_same(base: Base, decoder: &str) -> bool {
    match decoder {
        "uint" => matches!(base, Base::Enum | Base::Bitfield | Base::UInt),
        "int" => matches!(base, Base::Int | Base::Sizei),
        "ushort" => base == Base::UShort,
        "ulong" => base == Base::UInt64,
        "float" => matches!(base, Base::Float | Base::Clampf),
        "double" => matches!(base, Base::Double | Base::Clampd),
        "size" => matches!(base, Base::Intptr | Base::Sizeiptr),
        _ => false,
    }
}

/// A parameter's name in Rust.
pub fn identifier(param: &Param) -> String {
    match param.name.as_str() {
        keyword @ ("type" | "ref" | "in" | "box") => format!("r#{keyword}"),
        name => name.into(),
    }
}
