//! Values.

use std::io::Write;

use super::{Bitmask, Enumeration, Structure, TraceWriter};
use crate::format::tag;

impl<W: Write> TraceWriter<W> {
    #[inline]
    fn tagged(&mut self, tag: u8, value: u64) {
        self.out.byte(tag);
        self.out.uint(value);
    }

    /// A null pointer, or no value.
    pub fn null(&mut self) {
        self.out.byte(tag::NULL);
    }

    /// A truth value.
    pub fn boolean(&mut self, value: bool) {
        self.out.byte(if value { tag::TRUE } else { tag::FALSE });
    }

    /// A signed integer.
    #[inline]
    pub fn sint(&mut self, value: i64) {
        self.tagged(if value < 0 { tag::SINT } else { tag::UINT }, value.unsigned_abs());
    }

    /// An unsigned integer.
    #[inline]
    pub fn uint(&mut self, value: u64) {
        self.tagged(tag::UINT, value);
    }

    /// A float.
    #[inline]
    pub fn float(&mut self, value: f32) {
        let [a, b, c, d] = value.to_le_bytes();
        self.out.bytes(&[tag::FLOAT, a, b, c, d]);
    }

    /// A double.
    pub fn double(&mut self, value: f64) {
        self.out.byte(tag::DOUBLE);
        self.out.bytes(&value.to_le_bytes());
    }

    /// Bytes of a C string, without its zero.
    pub fn string(&mut self, bytes: &[u8]) {
        self.out.byte(tag::STRING);
        self.out.string(bytes);
    }

    /// Memory contents.
    pub fn blob(&mut self, bytes: &[u8]) {
        self.out.byte(tag::BLOB);
        self.out.string(bytes);
    }

    /// A value of an enumeration, whether it has a name or not.
    pub fn enumerant(&mut self, enumeration: &Enumeration, value: i64) {
        self.out.byte(tag::ENUM);
        self.enumeration(enumeration);
        self.sint(value);
    }

    /// Bits.
    pub fn bits(&mut self, bitmask: &Bitmask, value: u64) {
        self.out.byte(tag::BITMASK);
        self.bitmask(bitmask);
        self.out.uint(value);
    }

    /// Begins an array, whose elements follow.
    pub fn array(&mut self, elements: usize) {
        self.tagged(tag::ARRAY, elements as u64);
    }

    /// Begins a structure, whose members follow.
    pub fn structure(&mut self, structure: &Structure) {
        self.out.byte(tag::STRUCT);
        self.structure_id(structure);
    }

    /// An address in the program, or null.
    pub fn pointer(&mut self, address: u64) {
        match address {
            0 => self.null(),
            address => self.tagged(tag::OPAQUE, address),
        }
    }
}
