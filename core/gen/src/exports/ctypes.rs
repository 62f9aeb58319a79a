//! Types of OpenGL 1.x as Rust has them in its C interface.

use crate::model::{Base, CType};

/// The type of a parameter.
pub fn rust_type(ctype: CType) -> Option<String> {
    let base = match ctype.base {
        Base::Void if ctype.pointers > 0 => "c_void",
        base => number_type(base)?,
    };
    let pointer = if ctype.constant { "*const " } else { "*mut " };
    Some(pointer.repeat(ctype.pointers.into()) + base)
}

/// The type of a result, with the arrow; empty for none.
pub fn result_type(ctype: CType) -> Option<String> {
    match (ctype.base, ctype.pointers) {
        (Base::Void, 0) => Some(String::new()),
        _ => rust_type(ctype).map(|result| format!(" -> {result}")),
    }
}

fn number_type(base: Base) -> Option<&'static str> {
    Some(match base {
        Base::Boolean | Base::UByte => "u8",
        Base::Byte => "i8",
        Base::Short => "i16",
        Base::UShort => "u16",
        Base::Int | Base::Sizei => "i32",
        Base::UInt | Base::Enum | Base::Bitfield => "u32",
        Base::Float | Base::Clampf => "f32",
        Base::Double | Base::Clampd => "f64",
        Base::UInt64 => "u64",
        Base::Intptr | Base::Sizeiptr => "isize",
        _ => return None,
    })
}
