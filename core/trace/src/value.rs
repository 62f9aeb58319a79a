//! Values of arguments and results.

use std::sync::Arc;

use crate::signature::{BitmaskId, EnumId, Signatures, StructId};

/// A recorded value.
///
/// The `as_` functions convert as C would pass the value on, whatever type the tracer chose for it: an enumerant is
/// also an integer, a null pointer also 0, an integer also a float. They return `None` where no sensible conversion
/// exists. A value with a human-readable form ([`Repr`](Self::Repr)) converts as its machine-readable one.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Value {
    /// The trace does not record this argument (or not yet, in a call that was never left).
    #[default]
    Absent,
    Null,
    Bool(bool),
    SInt(i64),
    UInt(u64),
    Float(f32),
    Double(f64),
    /// Bytes of a C string, without its zero; in whatever encoding the program used.
    String(Box<[u8]>),
    /// Memory contents; shared, so that keeping them costs nothing.
    Blob(Arc<[u8]>),
    Enum {
        signature: EnumId,
        value: i64,
    },
    Bitmask {
        signature: BitmaskId,
        value: u64,
    },
    Array(Vec<Value>),
    Struct(Box<StructValue>),
    /// An address in the traced program.
    Pointer(u64),
    /// The same value twice: for people, and for machines.
    Repr(Box<[Value; 2]>),
    /// Characters of a wide string, without its zero; their encoding is that of the traced system.
    WString(Box<[u32]>),
}

/// A structure's members, in the order of its signature.
#[derive(Clone, Debug, PartialEq)]
pub struct StructValue {
    pub signature: StructId,
    pub members: Vec<Value>,
}

impl StructValue {
    /// The member of that name.
    pub fn member(&self, signatures: &Signatures, name: &str) -> Option<&Value> {
        let names = &signatures.structure(self.signature).member_names;
        let index = names.iter().position(|member| &**member == name)?;
        self.members.get(index)
    }
}

impl Value {
    /// What machines should use: the second half of a [`Repr`](Self::Repr), anything else itself.
    pub fn machine(&self) -> &Value {
        let mut value = self;
        while let Self::Repr(pair) = value {
            value = &pair[1];
        }
        value
    }

    /// What people should see: the first half of a [`Repr`](Self::Repr), anything else itself.
    pub fn human(&self) -> &Value {
        let mut value = self;
        while let Self::Repr(pair) = value {
            value = &pair[0];
        }
        value
    }

    pub fn is_absent(&self) -> bool {
        matches!(self, Self::Absent)
    }

    pub fn is_null(&self) -> bool {
        matches!(self.machine(), Self::Null)
    }

    /// As a signed integer; floats are truncated, large unsigned values wrap.
    pub fn as_i64(&self) -> Option<i64> {
        match *self.machine() {
            Self::SInt(value) | Self::Enum { value, .. } => Some(value),
            Self::UInt(value) | Self::Bitmask { value, .. } | Self::Pointer(value) => Some(value as i64),
            Self::Bool(value) => Some(value.into()),
            Self::Float(value) => Some(value as i64),
            Self::Double(value) => Some(value as i64),
            Self::Null => Some(0),
            _ => None,
        }
    }

    /// As an unsigned integer; floats are truncated, negative integers wrap.
    pub fn as_u64(&self) -> Option<u64> {
        match *self.machine() {
            Self::Float(value) if value >= 0.0 => Some(value as u64),
            Self::Double(value) if value >= 0.0 => Some(value as u64),
            _ => self.as_i64().map(|value| value as u64),
        }
    }

    /// As a signed integer of 32 bits; `None` also where it does not fit.
    pub fn as_i32(&self) -> Option<i32> {
        self.as_i64()?.try_into().ok()
    }

    /// As an unsigned integer of 32 bits; negative integers of 32 bits wrap, `None` also where it does not fit.
    pub fn as_u32(&self) -> Option<u32> {
        let value = self.as_i64()?;
        match value {
            0.. => value.try_into().ok(),
            _ => i32::try_from(value).ok().map(|value| value as u32),
        }
    }

    pub fn as_f64(&self) -> Option<f64> {
        match *self.machine() {
            Self::Float(value) => Some(value.into()),
            Self::Double(value) => Some(value),
            Self::UInt(value) => Some(value as f64),
            _ => self.as_i64().map(|value| value as f64),
        }
    }

    /// As [`as_f64`](Self::as_f64), rounded; a recorded `f32` comes back bit for bit.
    pub fn as_f32(&self) -> Option<f32> {
        match *self.machine() {
            Self::Float(value) => Some(value),
            Self::UInt(value) => Some(value as f32),
            Self::SInt(value) => Some(value as f32),
            _ => self.as_f64().map(|value| value as f32),
        }
    }

    /// As C's truth: whether it is not zero.
    pub fn as_bool(&self) -> Option<bool> {
        match self.machine() {
            Self::Float(value) => Some(*value != 0.0),
            Self::Double(value) => Some(*value != 0.0),
            _ => self.as_i64().map(|value| value != 0),
        }
    }

    /// As an address or an offset: 0 for null.
    pub fn as_pointer(&self) -> Option<u64> {
        match *self.machine() {
            Self::Pointer(value) | Self::UInt(value) => Some(value),
            Self::SInt(value) => Some(value as u64),
            Self::Null => Some(0),
            _ => None,
        }
    }

    pub fn as_blob(&self) -> Option<&Arc<[u8]>> {
        match self.machine() {
            Self::Blob(bytes) => Some(bytes),
            _ => None,
        }
    }

    pub fn as_array(&self) -> Option<&[Value]> {
        match self.machine() {
            Self::Array(values) => Some(values),
            _ => None,
        }
    }

    pub fn as_struct(&self) -> Option<&StructValue> {
        match self.machine() {
            Self::Struct(structure) => Some(structure),
            _ => None,
        }
    }

    /// The bytes of a string.
    pub fn as_bytes(&self) -> Option<&[u8]> {
        match self.machine() {
            Self::String(bytes) => Some(bytes),
            _ => None,
        }
    }

    /// A string that is valid UTF-8.
    pub fn as_str(&self) -> Option<&str> {
        std::str::from_utf8(self.as_bytes()?).ok()
    }

    /// The name of an enumerant, where its signature names it.
    pub fn enum_name<'a>(&self, signatures: &'a Signatures) -> Option<&'a str> {
        match *self.machine() {
            Self::Enum { signature, value } => signatures.enumeration(signature).name(value),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_stays_small() {
        assert_eq!(size_of::<Value>(), 24);
    }

    #[test]
    fn integers_convert_as_in_c() {
        assert_eq!(Value::SInt(-1).as_u32(), Some(u32::MAX));
        assert_eq!(Value::SInt(-1).as_u64(), Some(u64::MAX));
        assert_eq!(Value::UInt(u64::MAX).as_i64(), Some(-1));
        assert_eq!(Value::UInt(1 << 32).as_u32(), None);
        assert_eq!(Value::UInt(1 << 31).as_i32(), None);
        assert_eq!(Value::UInt(u64::MAX).as_f64(), Some(u64::MAX as f64));
        assert_eq!(Value::Null.as_i64(), Some(0));
        assert_eq!(Value::Bool(true).as_i32(), Some(1));
        assert_eq!(Value::Double(-2.9).as_i64(), Some(-2));
        assert_eq!(Value::Double(1e19).as_u64(), Some(10_000_000_000_000_000_000));
        assert_eq!(Value::Float(0.25).as_bool(), Some(true));
        assert_eq!(Value::Absent.as_i64(), None);
        assert_eq!(Value::String(b"7"[..].into()).as_i64(), None);
    }

    #[test]
    fn addresses_and_offsets_convert() {
        assert_eq!(Value::Null.as_pointer(), Some(0));
        assert_eq!(Value::Pointer(16).as_pointer(), Some(16));
        assert_eq!(Value::UInt(8).as_pointer(), Some(8));
        assert_eq!(Value::Float(8.0).as_pointer(), None);
        assert!(Value::Null.is_null());
    }

    #[test]
    fn a_representation_converts_as_its_machine_half() {
        let inner = Value::Repr(Box::new([Value::Null, Value::UInt(5)]));
        let value = Value::Repr(Box::new([Value::String(b"five"[..].into()), inner]));
        assert_eq!(value.as_u32(), Some(5));
        assert_eq!(value.human().as_str(), Some("five"));
    }
}
