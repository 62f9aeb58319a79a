//! Arguments and results of any type as one word, so that one function records all commands.

/// A type of parameters or results.
pub trait Bits: Copy {
    /// Integers are extended as their sign says; floats are their representation, pointers their address.
    fn bits(self) -> u64;
}

impl Bits for () {
    #[inline(always)]
    fn bits(self) -> u64 {
        0
    }
}

macro_rules! bits {
    ($($ty:ty: $value:ident => $bits:expr;)*) => {$(
        impl Bits for $ty {
            #[inline(always)]
            fn bits(self) -> u64 {
                let $value = self;
                $bits
            }
        }
    )*};
}

bits! {
    u8: value => value.into();
    u16: value => value.into();
    u32: value => value.into();
    u64: value => value;
    usize: value => value as u64;
    i8: value => i64::from(value) as u64;
    i16: value => i64::from(value) as u64;
    i32: value => i64::from(value) as u64;
    isize: value => value as i64 as u64;
    f32: value => value.to_bits().into();
    f64: value => value.to_bits();
}

impl<T> Bits for *const T {
    #[inline(always)]
    fn bits(self) -> u64 {
        self as usize as u64
    }
}

impl<T> Bits for *mut T {
    #[inline(always)]
    fn bits(self) -> u64 {
        self as usize as u64
    }
}
