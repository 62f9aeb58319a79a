//! Arguments of a traced call as the types that methods take. What is not there, or of another kind, is
//! `None`: such a call is skipped.

use std::ops::Deref;

use afterglow_gl::Pointer;
use afterglow_trace::Value;

/// Arguments of a call, by position.
#[derive(Debug, Clone, Copy)]
pub struct Args<'a>(pub &'a [Value]);

/// Most elements that an array in a call may have, beyond those that a trace bounds itself.
const LONGEST_LIST: usize = 1 << 22;

impl<'a> Args<'a> {
    /// The value at a position.
    #[inline]
    pub fn value(self, index: usize) -> Option<&'a Value> {
        self.0.get(index)
    }

    /// A scalar.
    #[inline]
    pub fn get<T>(self, index: usize, decode: impl Fn(&Value) -> Option<T>) -> Option<T> {
        decode(self.value(index)?)
    }

    /// The elements of an array, at least `N`.
    #[inline]
    pub fn vector<T: Copy + Default, const N: usize>(
        self,
        index: usize,
        decode: impl Fn(&Value) -> Option<T>,
    ) -> Option<[T; N]> {
        let values = self.value(index)?.as_array()?.first_chunk::<N>()?;
        let mut vector = [T::default(); N];
        for (element, value) in vector.iter_mut().zip(values) {
            *element = decode(value)?;
        }
        Some(vector)
    }

    /// What a pointer to one element points to.
    pub fn first<T: Copy + Default>(self, index: usize, decode: impl Fn(&Value) -> Option<T>) -> Option<T> {
        self.vector(index, decode).map(|[first]| first)
    }

    /// Up to four elements of an array of unknown length; more are left out.
    #[inline]
    pub fn few<T: Copy + Default>(
        self,
        index: usize,
        decode: impl Fn(&Value) -> Option<T>,
    ) -> Option<Few<T>> {
        let values = self.value(index)?.as_array()?;
        let mut few = Few { values: [T::default(); 4], count: values.len().min(4) };
        for (element, value) in few.values.iter_mut().zip(values) {
            *element = decode(value)?;
        }
        (few.count > 0).then_some(few)
    }

    /// `count` elements of an array.
    pub fn list<T>(self, index: usize, count: i32, decode: impl Fn(&Value) -> Option<T>) -> Option<Vec<T>> {
        let count = usize::try_from(count).ok().filter(|&count| count <= LONGEST_LIST)?;
        if count == 0 {
            return Some(Vec::new());
        }
        self.value(index)?.as_array()?.get(..count)?.iter().map(decode).collect()
    }

    /// Memory that may be missing.
    pub fn memory(self, index: usize) -> Option<Option<&'a [u8]>> {
        let value = self.value(index)?;
        match value.as_blob() {
            Some(bytes) => Some(Some(bytes)),
            None => value.is_null().then_some(None),
        }
    }

    /// Memory.
    pub fn bytes(self, index: usize) -> Option<&'a [u8]> {
        self.memory(index)?
    }

    /// Memory, an offset in a buffer, or null.
    pub fn pointer(self, index: usize) -> Option<Pointer> {
        pointer(self.value(index)?)
    }

    /// `count` of them.
    pub fn pointers(self, index: usize, count: i32) -> Option<Vec<Pointer>> {
        self.list(index, count, pointer)
    }
}

/// An address of the traced program means nothing here: a number is an offset in the buffer bound at the time.
fn pointer(value: &Value) -> Option<Pointer> {
    match value.as_blob() {
        Some(bytes) => Some(Pointer::Blob(bytes.clone())),
        None => {
            value.as_pointer().map(|offset| if offset == 0 { Pointer::Null } else { Pointer::Offset(offset) })
        }
    }
}

/// Up to four values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Few<T> {
    values: [T; 4],
    count: usize,
}

impl<T> Deref for Few<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.values[..self.count]
    }
}

/// GLenum, GLbitfield, GLuint.
#[inline]
pub fn uint(value: &Value) -> Option<u32> {
    value.as_u32()
}

/// GLuint64.
#[inline]
pub fn ulong(value: &Value) -> Option<u64> {
    value.as_u64()
}

/// GLint, GLsizei; a number of 32 bits that the tracer took for unsigned wraps.
#[inline]
pub fn int(value: &Value) -> Option<i32> {
    let wide = value.as_i64()?;
    i32::try_from(wide).ok().or_else(|| u32::try_from(wide).ok().map(|wide| wide as i32))
}

/// GLushort.
pub fn ushort(value: &Value) -> Option<u16> {
    value.as_i64().map(|value| value as u16)
}

/// GLintptr, GLsizeiptr.
pub fn size(value: &Value) -> Option<isize> {
    value.as_i64()?.try_into().ok()
}

/// GLboolean.
#[inline]
pub fn boolean(value: &Value) -> Option<bool> {
    value.as_bool()
}

/// Any number as GLfloat.
#[inline]
pub fn float(value: &Value) -> Option<f32> {
    value.as_f32()
}

/// GLdouble.
#[inline]
pub fn double(value: &Value) -> Option<f64> {
    value.as_f64()
}

/// GLubyte as a fraction (specification 2.14, table 2.9; so are the following).
#[inline]
pub fn unorm8(value: &Value) -> Option<f32> {
    Some(f32::from(value.as_i64()? as u8) / 255.0)
}

/// GLushort as a fraction.
pub fn unorm16(value: &Value) -> Option<f32> {
    Some(f32::from(value.as_i64()? as u16) / 65535.0)
}

/// GLuint as a fraction.
pub fn unorm32(value: &Value) -> Option<f32> {
    Some((f64::from(value.as_i64()? as u32) / f64::from(u32::MAX)) as f32)
}

/// GLbyte as a fraction.
pub fn snorm8(value: &Value) -> Option<f32> {
    Some((2.0 * f32::from(value.as_i64()? as i8) + 1.0) / 255.0)
}

/// GLshort as a fraction.
pub fn snorm16(value: &Value) -> Option<f32> {
    Some((2.0 * f32::from(value.as_i64()? as i16) + 1.0) / 65535.0)
}

/// GLint as a fraction.
pub fn snorm32(value: &Value) -> Option<f32> {
    Some(((2.0 * f64::from(value.as_i64()? as i32) + 1.0) / f64::from(u32::MAX)) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_become_fractions() {
        let of = |decode: fn(&Value) -> Option<f32>, value| decode(&Value::SInt(value)).unwrap();
        assert_eq!((of(unorm8, 0), of(unorm8, 255)), (0.0, 1.0));
        assert_eq!((of(snorm8, -128), of(snorm8, 127)), (-1.0, 1.0));
        assert_eq!((of(unorm16, 65535), of(snorm16, -32768)), (1.0, -1.0));
        assert_eq!((of(unorm32, u32::MAX.into()), of(snorm32, i32::MAX.into())), (1.0, 1.0));
        // What the tracer writes for GL_UNSIGNED_BYTE in a signed type.
        assert_eq!(of(unorm8, -1), 1.0);
    }

    #[test]
    fn arrays_must_be_long_enough() {
        let values = [Value::Array(vec![Value::Float(1.0), Value::SInt(2)])];
        let args = Args(&values);
        assert_eq!(args.vector(0, float), Some([1.0, 2.0]));
        assert_eq!(args.vector::<_, 3>(0, float), None);
        assert_eq!(args.few(0, float).as_deref(), Some(&[1.0, 2.0][..]));
        assert_eq!(args.list(0, 1, int), Some(vec![1]));
        assert_eq!(args.list(0, 3, int), None);
        assert_eq!(args.list(0, -1, int), None);
        assert_eq!(args.get(1, int), None);
        assert_eq!(args.vector::<_, 1>(1, int), None);
    }

    #[test]
    fn pointers_are_memory_or_offsets() {
        let values = [Value::Blob([1, 2][..].into()), Value::Pointer(4), Value::Null, Value::Float(1.0)];
        let args = Args(&values);
        assert!(matches!(args.pointer(0), Some(Pointer::Blob(bytes)) if *bytes == [1, 2]));
        assert!(matches!(args.pointer(1), Some(Pointer::Offset(4))));
        assert!(matches!(args.pointer(2), Some(Pointer::Null)));
        assert!(args.pointer(3).is_none());
        assert_eq!(args.memory(2), Some(None));
        assert_eq!(args.memory(1), None);
    }

    #[test]
    fn integers_of_32_bits_wrap() {
        assert_eq!(int(&Value::UInt(0xffff_ffff)), Some(-1));
        assert_eq!(int(&Value::UInt(1 << 32)), None);
        assert_eq!(uint(&Value::SInt(-1)), Some(u32::MAX));
    }
}
