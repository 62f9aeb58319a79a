//! Numbers by their type: out of words and out of memory.

use std::fs::File;

use afterglow_api::{Base, Param};
use afterglow_trace::TraceWriter;

use super::names;

/// Where events go.
pub type Writer = TraceWriter<File>;

/// A type of numbers, with the meaning that they are written with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    U64,
    /// As wide as a pointer.
    Size,
    F32,
    F64,
    Boolean,
    Enum,
    Primitive,
    Error,
    /// A signed integer that may be an enumerant: the internal format of a texture.
    Format,
    Bits,
    ClientBits,
    Address,
}

impl Number {
    /// What a parameter, or what it points to, is; `None` where that is no number.
    pub fn of(param: &Param) -> Option<Number> {
        let is_format = param.group == "InternalFormat";
        Some(match param.ctype.base {
            Base::Byte => Number::I8,
            Base::UByte => Number::U8,
            Base::Short => Number::I16,
            Base::UShort => Number::U16,
            Base::Int if is_format => Number::Format,
            Base::Int | Base::Sizei => Number::I32,
            Base::UInt => Number::U32,
            Base::UInt64 => Number::U64,
            Base::Intptr | Base::Sizeiptr => Number::Size,
            Base::Float | Base::Clampf => Number::F32,
            Base::Double | Base::Clampd => Number::F64,
            Base::Boolean => Number::Boolean,
            Base::Enum if param.group == "PrimitiveType" => Number::Primitive,
            Base::Enum => Number::Enum,
            Base::Bitfield if param.group == "ClientAttribMask" => Number::ClientBits,
            Base::Bitfield => Number::Bits,
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Number::I8 | Number::U8 | Number::Boolean => 1,
            Number::I16 | Number::U16 => 2,
            Number::U64 | Number::F64 => 8,
            Number::Size | Number::Address => size_of::<usize>(),
            _ => 4,
        }
    }

    /// Element `index` of an array, as [`Bits`](super::bits::Bits) has it.
    ///
    /// # Safety
    /// The array can be read so far.
    pub unsafe fn load(self, array: usize, index: usize) -> u64 {
        let at = (array + index * self.bytes()) as *const u8;
        // SAFETY: the element can be read.
        unsafe {
            match self {
                Number::I8 => i64::from(at.cast::<i8>().read()) as u64,
                Number::U8 | Number::Boolean => at.read().into(),
                Number::I16 => i64::from(at.cast::<i16>().read_unaligned()) as u64,
                Number::U16 => at.cast::<u16>().read_unaligned().into(),
                Number::I32 | Number::Format => i64::from(at.cast::<i32>().read_unaligned()) as u64,
                Number::U64 | Number::F64 => at.cast::<u64>().read_unaligned(),
                Number::Size => at.cast::<isize>().read_unaligned() as i64 as u64,
                Number::Address => at.cast::<usize>().read_unaligned() as u64,
                _ => at.cast::<u32>().read_unaligned().into(),
            }
        }
    }

    /// Writes a number.
    #[inline]
    pub fn write(self, writer: &mut Writer, bits: u64) {
        match self {
            Number::F32 => writer.float(f32::from_bits(bits as u32)),
            Number::F64 => writer.double(f64::from_bits(bits)),
            Number::I8 | Number::I16 | Number::I32 | Number::Size => writer.sint(bits as i64),
            Number::U8 | Number::U16 | Number::U32 | Number::U64 => writer.uint(bits),
            Number::Boolean => writer.enumerant(&names::BOOLEANS, bits as i64),
            Number::Enum | Number::Format => writer.enumerant(&names::enumerants(), bits as i64),
            Number::Primitive => writer.enumerant(&names::PRIMITIVES, bits as i64),
            Number::Error => writer.enumerant(&names::ERRORS, bits as i64),
            Number::Bits => writer.bits(&names::ATTRIBUTE_BITS, bits),
            Number::ClientBits => writer.bits(&names::CLIENT_ATTRIBUTE_BITS, bits),
            Number::Address => writer.pointer(bits),
        }
    }

    /// Writes a number that is an enumerant if it can be one.
    pub fn write_symbolic(self, writer: &mut Writer, bits: u64) {
        let value = match self {
            Number::F32 => f64::from(f32::from_bits(bits as u32)),
            Number::F64 => f64::from_bits(bits),
            _ => bits as i64 as f64,
        };
        if value == f64::from(value as u32) {
            writer.enumerant(&names::enumerants(), value as i64);
        } else {
            self.write(writer, bits);
        }
    }
}
