//! Bytes of a file, written and read in order. Reading is checked: what is not there or makes no sense is `None`.

use afterglow_gl::frame::{Compare, FloatBits};
use bytemuck::Pod;

/// Bytes being written.
#[derive(Debug, Default)]
pub struct Writer {
    /// So far.
    pub bytes: Vec<u8>,
}

impl Writer {
    /// Writes a plain value as it lies in memory.
    pub fn put<T: Pod>(&mut self, value: &T) {
        self.bytes.extend_from_slice(bytemuck::bytes_of(value));
    }

    /// Writes a number of 32 bits.
    pub fn number(&mut self, number: usize) {
        self.put(&(number as u32));
    }

    /// Writes words with their number.
    pub fn words(&mut self, words: &[u32]) {
        self.number(words.len());
        self.bytes.extend_from_slice(bytemuck::cast_slice(words));
    }

    /// Writes a float's bits.
    pub fn float(&mut self, float: FloatBits) {
        self.put(&float.get());
    }
}

/// Bytes being read.
#[derive(Debug, Clone)]
pub struct Reader<'a> {
    bytes: &'a [u8],
}

impl<'a> Reader<'a> {
    /// From their beginning.
    pub fn new(bytes: &'a [u8]) -> Reader<'a> {
        Reader { bytes }
    }

    /// Whether all were read.
    pub fn is_done(&self) -> bool {
        self.bytes.is_empty()
    }

    /// So many bytes.
    pub fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.bytes.split_at_checked(count)?;
        self.bytes = rest;
        Some(taken)
    }

    /// A plain value.
    pub fn get<T: Pod>(&mut self) -> Option<T> {
        Some(bytemuck::pod_read_unaligned(self.take(size_of::<T>())?))
    }

    /// A number of things that take at least so many bytes each, all of which must be there.
    pub fn count(&mut self, least_bytes: usize) -> Option<usize> {
        let count = self.get::<u32>()? as usize;
        (count.checked_mul(least_bytes)? <= self.bytes.len()).then_some(count)
    }

    /// Words.
    pub fn words(&mut self) -> Option<Vec<u32>> {
        let count = self.count(4)?;
        Some(self.take(4 * count)?.chunks_exact(4).map(bytemuck::pod_read_unaligned).collect())
    }

    /// A byte that is 0 or 1.
    pub fn flag(&mut self) -> Option<bool> {
        match self.get::<u8>()? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }

    /// One of these values, by its number.
    pub fn one_of<T: Copy>(&mut self, values: &[T]) -> Option<T> {
        values.get(usize::from(self.get::<u8>()?)).copied()
    }

    /// A float.
    pub fn float(&mut self) -> Option<FloatBits> {
        Some(self.get::<f32>()?.into())
    }
}

/// Comparisons by number.
pub const COMPARES: [Compare; 8] = [
    Compare::Never,
    Compare::Less,
    Compare::Equal,
    Compare::LessEqual,
    Compare::Greater,
    Compare::NotEqual,
    Compare::GreaterEqual,
    Compare::Always,
];
