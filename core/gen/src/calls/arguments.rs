//! Names of the functions that decode one argument of a call.

use crate::model::Base;

/// The decoder of a scalar type: a function of `core/player/src/args.rs` and of `gl-shim/src/number.rs`.
pub fn decoder(base: Base) -> Option<&'static str> {
    Some(match base {
        Base::Enum | Base::Bitfield | Base::UInt | Base::UByte => "uint",
        Base::Int | Base::Sizei | Base::Short | Base::Byte => "int",
        Base::UShort => "ushort",
        Base::Float | Base::Clampf => "float",
        Base::Double | Base::Clampd => "double",
        Base::Boolean => "boolean",
        Base::UInt64 => "ulong",
        Base::Intptr | Base::Sizeiptr => "size",
        _ => return None,
    })
}

/// The decoder that makes a fraction of an integer (specification 2.14, table 2.9), or a float of a number.
pub fn normalizer(base: Base) -> &'static str {
    match base {
        Base::Byte => "snorm8",
        Base::UByte => "unorm8",
        Base::Short => "snorm16",
        Base::UShort => "unorm16",
        Base::Int => "snorm32",
        Base::UInt => "unorm32",
        _ => "float",
    }
}
