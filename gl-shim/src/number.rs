//! Numbers in the types that the context takes. Names are those that the generator uses.

/// A type of numbers in OpenGL's interface.
pub trait Number: Copy {
    /// The number, rounded to the nearest.
    fn to_f32(self) -> f32;
}

macro_rules! numbers {
    ($($ty:ty)*) => {$(
        impl Number for $ty {
            #[inline(always)]
            fn to_f32(self) -> f32 {
                self as f32
            }
        }
    )*};
}

numbers! { i8 u8 i16 u16 i32 u32 f32 f64 }

/// Any number as GLfloat.
#[inline(always)]
pub fn float(value: impl Number) -> f32 {
    value.to_f32()
}

/// GLdouble.
#[inline(always)]
pub fn double(value: f64) -> f64 {
    value
}

/// GLenum, GLuint and smaller ones.
#[inline(always)]
pub fn uint(value: impl Into<u32>) -> u32 {
    value.into()
}

/// GLint and smaller ones.
#[inline(always)]
pub fn int(value: impl Into<i32>) -> i32 {
    value.into()
}

/// GLboolean.
#[inline(always)]
pub fn boolean(value: u8) -> bool {
    value != 0
}

/// GLubyte as a fraction (specification 2.14, table 2.9; so are the following).
#[inline(always)]
pub fn unorm8(value: u8) -> f32 {
    f32::from(value) / 255.0
}

/// GLushort as a fraction.
#[inline(always)]
pub fn unorm16(value: u16) -> f32 {
    f32::from(value) / 65535.0
}

/// GLuint as a fraction.
#[inline(always)]
pub fn unorm32(value: u32) -> f32 {
    (f64::from(value) / f64::from(u32::MAX)) as f32
}

/// GLbyte as a fraction.
#[inline(always)]
pub fn snorm8(value: i8) -> f32 {
    (2.0 * f32::from(value) + 1.0) / 255.0
}

/// GLshort as a fraction.
#[inline(always)]
pub fn snorm16(value: i16) -> f32 {
    (2.0 * f32::from(value) + 1.0) / 65535.0
}

/// GLint as a fraction.
#[inline(always)]
pub fn snorm32(value: i32) -> f32 {
    ((2.0 * f64::from(value) + 1.0) / f64::from(u32::MAX)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_become_fractions() {
        assert_eq!((unorm8(0), unorm8(255)), (0.0, 1.0));
        assert_eq!((snorm8(-128), snorm8(127)), (-1.0, 1.0));
        assert_eq!((unorm16(65535), snorm16(-32768)), (1.0, -1.0));
        assert_eq!((unorm32(u32::MAX), snorm32(i32::MAX)), (1.0, 1.0));
    }
}
