//! The grammar of values.

use std::sync::Arc;

use super::parser::Parser;
use crate::error::{Damage, Stop};
use crate::format::{self, limits, tag};
use crate::signature::EnumId;
use crate::value::{StructValue, Value};

/// Elements reserved on the word of a length alone.
const TRUSTED_ELEMENTS: u64 = 1024;

impl Parser {
    /// Replaces `slot` with the next value, or leaves it alone after an error.
    ///
    /// Values are written in place because returning one by value, inside a `Result`, takes longer than reading it.
    #[inline]
    pub(super) fn value(&mut self, slot: &mut Value) -> Result<(), Stop> {
        self.nested_value(slot, 0)
    }

    fn nested_value(&mut self, slot: &mut Value, depth: u32) -> Result<(), Stop> {
        self.budget.take_values(1)?;
        match self.input.byte()? {
            tag::NULL => *slot = Value::Null,
            tag::FALSE => *slot = Value::Bool(false),
            tag::TRUE => *slot = Value::Bool(true),
            tag::SINT => *slot = Value::SInt(self.negative()?),
            tag::UINT => *slot = Value::UInt(self.input.uint()?),
            tag::FLOAT => *slot = Value::Float(self.input.f32()?),
            tag::DOUBLE => *slot = Value::Double(self.input.f64()?),
            tag::STRING => *slot = Value::String(self.string()?),
            tag::BLOB => *slot = Value::Blob(self.blob()?),
            tag::ENUM => {
                let (signature, value) = self.enum_value()?;
                *slot = Value::Enum { signature, value };
            }
            tag::BITMASK => {
                let signature = self.bitmask()?;
                let value = self.input.uint()?;
                *slot = Value::Bitmask { signature, value };
            }
            tag::ARRAY => {
                let count = self.input.uint()?;
                *slot = Value::Array(self.elements(count, depth)?);
            }
            tag::STRUCT => *slot = Value::Struct(self.struct_value(depth)?),
            tag::OPAQUE => *slot = Value::Pointer(self.input.uint()?),
            tag::REPR => *slot = Value::Repr(self.repr(depth)?),
            tag::WSTRING => *slot = Value::WString(self.wide_string()?),
            other => return Err(Damage::ValueType(other).into()),
        }
        Ok(())
    }

    #[inline]
    fn enum_value(&mut self) -> Result<(EnumId, i64), Stop> {
        match self.version {
            format::VERSION_WHOLE_ENUMS.. => Ok((self.enumeration()?, self.enumerant()?)),
            _ => self.lone_enumerant(),
        }
    }

    fn elements(&mut self, count: u64, depth: u32) -> Result<Vec<Value>, Stop> {
        if depth >= limits::DEPTH {
            return Err(Damage::Depth.into());
        }
        if count > self.budget.values {
            return Err(Damage::EventSize.into());
        }
        let mut values = Vec::with_capacity(count.min(TRUSTED_ELEMENTS) as usize);
        for _ in 0..count {
            let mut value = Value::Absent;
            self.nested_value(&mut value, depth + 1)?;
            values.push(value);
        }
        Ok(values)
    }

    fn struct_value(&mut self, depth: u32) -> Result<Box<StructValue>, Stop> {
        let signature = self.structure()?;
        let count = self.signatures.structure(signature).member_names.len();
        let members = self.elements(count as u64, depth)?;
        Ok(Box::new(StructValue { signature, members }))
    }

    fn repr(&mut self, depth: u32) -> Result<Box<[Value; 2]>, Stop> {
        if depth >= limits::DEPTH {
            return Err(Damage::Depth.into());
        }
        let mut pair = Box::<[Value; 2]>::default();
        for value in &mut *pair {
            self.nested_value(value, depth + 1)?;
        }
        Ok(pair)
    }

    fn string(&mut self) -> Result<Box<[u8]>, Stop> {
        let length = self.string_length(1)?;
        Ok(self.input.bytes(length)?.into())
    }

    fn wide_string(&mut self) -> Result<Box<[u32]>, Stop> {
        let length = self.string_length(size_of::<u32>() as u64)?;
        let mut characters = Vec::with_capacity(length.min(TRUSTED_ELEMENTS as usize));
        for _ in 0..length {
            // Tracers on Windows write UTF-16, others UTF-32; what fits neither is no character.
            let character = self.input.uint()?;
            characters.push(u32::try_from(character).unwrap_or(u32::from(char::REPLACEMENT_CHARACTER)));
        }
        Ok(characters.into())
    }

    /// Length of a string whose characters take `width` bytes of memory each.
    fn string_length(&mut self, width: u64) -> Result<usize, Stop> {
        let length = self.input.uint()?;
        if length > limits::STRING_BYTES {
            return Err(Damage::StringLength(length).into());
        }
        self.budget.take_bytes(length * width)?;
        Ok(length as usize)
    }

    fn blob(&mut self) -> Result<Arc<[u8]>, Stop> {
        let length = self.input.uint()?;
        if length > limits::BLOB_BYTES {
            return Err(Damage::BlobLength(length).into());
        }
        self.budget.take_bytes(length)?;
        self.input.shared_bytes(length as usize)
    }
}
