//! The program's memory. A null pointer reads as zeros or as nothing, and nothing is written to it.
//!
//! All functions that are unsafe have one contract: what the pointer points to can be read, or written, as far as
//! the function says. That is what OpenGL's specification asks of the program.

use std::ffi::c_void;
use std::ops::Deref;

use afterglow_gl::{Pointer, Value, parameter_values};

/// An array of `N` elements.
#[inline(always)]
pub unsafe fn vector<E: Copy, T: Copy + Default, const N: usize>(
    from: *const E,
    convert: impl Fn(E) -> T,
) -> [T; N] {
    let mut vector = [T::default(); N];
    if !from.is_null() {
        for (i, element) in vector.iter_mut().enumerate() {
            // SAFETY: `N` elements can be read.
            *element = convert(unsafe { from.add(i).read_unaligned() });
        }
    }
    vector
}

/// One element.
#[inline(always)]
pub unsafe fn first<E: Copy, T: Copy + Default>(from: *const E, convert: impl Fn(E) -> T) -> T {
    // SAFETY: one element can be read.
    let [first] = unsafe { vector(from, convert) };
    first
}

/// Up to four values.
#[derive(Debug, Clone, Copy)]
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

/// As many elements as the parameter `pname` has.
pub unsafe fn few<E: Copy, T: Copy + Default>(
    from: *const E,
    pname: u32,
    convert: impl Fn(E) -> T,
) -> Few<T> {
    let mut few = Few { values: [T::default(); 4], count: parameter_values(pname).min(4) };
    if !from.is_null() {
        for (i, value) in few.values[..few.count].iter_mut().enumerate() {
            // SAFETY: as many elements as the parameter has can be read.
            *value = convert(unsafe { from.add(i).read_unaligned() });
        }
    }
    few
}

/// `count` elements.
pub unsafe fn list<E: Copy, T>(from: *const E, count: i32, convert: impl Fn(E) -> T) -> Vec<T> {
    let count = usize::try_from(count).unwrap_or(0);
    if from.is_null() {
        return Vec::new();
    }
    // SAFETY: `count` elements can be read.
    (0..count).map(|i| convert(unsafe { from.add(i).read_unaligned() })).collect()
}

/// `count` bytes.
pub unsafe fn bytes<'a>(from: *const c_void, count: usize) -> &'a [u8] {
    if from.is_null() || count > isize::MAX as usize {
        return &[];
    }
    // SAFETY: `count` bytes can be read while the call lasts.
    unsafe { std::slice::from_raw_parts(from.cast(), count) }
}

/// `count` bytes that are written.
pub unsafe fn bytes_mut<'a>(to: *mut c_void, count: usize) -> &'a mut [u8] {
    if to.is_null() || count > isize::MAX as usize {
        return &mut [];
    }
    // SAFETY: `count` bytes can be written while the call lasts, and nobody else uses them.
    unsafe { std::slice::from_raw_parts_mut(to.cast(), count) }
}

/// An address to be read when something is drawn, or an offset if a buffer is bound.
pub fn pointer(address: *const c_void) -> Pointer {
    if address.is_null() { Pointer::Null } else { Pointer::Memory(address as usize) }
}

/// Writes what a command gives. After an error that is nothing.
pub unsafe fn store<T: Copy>(results: impl Results<T>, to: *mut T) {
    if to.is_null() {
        return;
    }
    for (i, value) in results.results().into_iter().enumerate() {
        // SAFETY: as many elements as the command gives can be written.
        unsafe { to.add(i).write_unaligned(value) };
    }
}

/// What a command gives, as elements of a type.
pub trait Results<T> {
    /// The elements.
    fn results(self) -> impl IntoIterator<Item = T>;
}

impl<T, R: Results<T>> Results<T> for Option<R> {
    fn results(self) -> impl IntoIterator<Item = T> {
        self.into_iter().flat_map(R::results)
    }
}

impl<T> Results<T> for Vec<T> {
    fn results(self) -> impl IntoIterator<Item = T> {
        self
    }
}

impl<T, const N: usize> Results<T> for [T; N] {
    fn results(self) -> impl IntoIterator<Item = T> {
        self
    }
}

impl Results<u8> for Vec<bool> {
    fn results(self) -> impl IntoIterator<Item = u8> {
        self.into_iter().map(u8::from)
    }
}

macro_rules! results {
    ($($from:ty => $to:ty: $convert:expr;)*) => {$(
        impl Results<$to> for $from {
            fn results(self) -> impl IntoIterator<Item = $to> {
                let convert: fn($from) -> _ = $convert;
                convert(self)
            }
        }
    )*};
}

results! {
    Value => i32: |value| value.integers();
    Value => f32: |value| value.floats();
    Value => f64: |value| value.doubles();
    i32 => i32: |value| [value];
    i32 => f32: |value| [value as f32];
    u32 => i32: |value| [i32::try_from(value).unwrap_or(i32::MAX)];
    u32 => u32: |value| [value];
    usize => *mut c_void: |address| [address as *mut c_void];
}

#[cfg(test)]
mod tests {
    use std::ptr::{null, null_mut};

    use afterglow_api::constants::{GL_AMBIENT, GL_SHININESS};

    use super::*;

    #[test]
    fn memory_is_read_as_far_as_is_said() {
        let shorts = [1i16, -2, 3, 4];
        // SAFETY: there are four.
        unsafe {
            assert_eq!(vector(shorts.as_ptr(), crate::number::float), [1.0, -2.0, 3.0]);
            assert_eq!(*few(shorts.as_ptr(), GL_SHININESS, crate::number::int), [1]);
            assert_eq!(*few(shorts.as_ptr(), GL_AMBIENT, crate::number::int), [1, -2, 3, 4]);
            assert_eq!(list(shorts.as_ptr(), 2, crate::number::int), [1, -2]);
            assert_eq!(list(shorts.as_ptr(), -1, crate::number::int), []);
        }
    }

    #[test]
    fn null_pointers_are_harmless() {
        // SAFETY: they are not followed.
        unsafe {
            assert_eq!(vector(null::<f32>(), crate::number::float), [0.0; 4]);
            assert!(list(null::<u32>(), 3, crate::number::uint).is_empty());
            assert!(bytes(null(), 3).is_empty());
            assert!(bytes_mut(null_mut(), 3).is_empty());
            store(vec![1u32], null_mut());
        }
        assert!(matches!(pointer(null()), Pointer::Null));
    }

    #[test]
    fn results_have_the_type_that_is_asked_for() {
        let mut ints = [0; 3];
        // SAFETY: there are three.
        unsafe {
            store(Some(Value::Floats(vec![1.6, -2.0])), ints.as_mut_ptr());
            store(None::<i32>, ints.as_mut_ptr());
        }
        assert_eq!(ints, [2, -2, 0]);
    }
}
