//! One number in memory, as a component between 0 and 1 or as an index (specification, tables 2.6 and 4.7).

/// A type of component, in the machine's byte order.
pub trait Element: Copy {
    /// Its bytes.
    type Bytes: Copy + Default + AsRef<[u8]> + AsMut<[u8]>;

    /// The element in memory.
    fn from_bytes(bytes: Self::Bytes) -> Self;
    /// Memory of the element.
    fn to_bytes(self) -> Self::Bytes;
    /// Unsigned types: c / (2^b - 1); signed: (2c + 1) / (2^b - 1); floats as they are.
    fn normalized(self) -> f32;
    /// The inverse of `normalized`, rounded to the nearest and clamped.
    fn from_normalized(value: f32) -> Self;
    /// As an integer; floats lose their fraction.
    fn index(self) -> i64;
    /// An index reduced to the type's bits.
    fn from_index(index: i64) -> Self;
}

macro_rules! unsigned {
    ($type:ty, $bytes:literal) => {
        impl Element for $type {
            type Bytes = [u8; $bytes];

            fn from_bytes(bytes: Self::Bytes) -> Self {
                <$type>::from_ne_bytes(bytes)
            }

            fn to_bytes(self) -> Self::Bytes {
                self.to_ne_bytes()
            }

            fn normalized(self) -> f32 {
                (f64::from(self) / f64::from(<$type>::MAX)) as f32
            }

            fn from_normalized(value: f32) -> Self {
                (f64::from(value) * f64::from(<$type>::MAX)).round_ties_even() as $type
            }

            fn index(self) -> i64 {
                self.into()
            }

            fn from_index(index: i64) -> Self {
                index as $type
            }
        }
    };
}

macro_rules! signed {
    ($type:ty, $unsigned:ty, $bytes:literal) => {
        impl Element for $type {
            type Bytes = [u8; $bytes];

            fn from_bytes(bytes: Self::Bytes) -> Self {
                <$type>::from_ne_bytes(bytes)
            }

            fn to_bytes(self) -> Self::Bytes {
                self.to_ne_bytes()
            }

            fn normalized(self) -> f32 {
                ((2.0 * f64::from(self) + 1.0) / f64::from(<$unsigned>::MAX)) as f32
            }

            fn from_normalized(value: f32) -> Self {
                ((f64::from(value) * f64::from(<$unsigned>::MAX) - 1.0) / 2.0).round_ties_even() as $type
            }

            fn index(self) -> i64 {
                self.into()
            }

            fn from_index(index: i64) -> Self {
                // Table 4.7 masks with 2^(b-1) - 1, so that the sign bit stays clear.
                (index & i64::from(<$type>::MAX)) as $type
            }
        }
    };
}

unsigned!(u8, 1);
unsigned!(u16, 2);
unsigned!(u32, 4);
signed!(i8, u8, 1);
signed!(i16, u16, 2);
signed!(i32, u32, 4);

impl Element for f32 {
    type Bytes = [u8; 4];

    fn from_bytes(bytes: Self::Bytes) -> Self {
        f32::from_ne_bytes(bytes)
    }

    fn to_bytes(self) -> Self::Bytes {
        self.to_ne_bytes()
    }

    fn normalized(self) -> f32 {
        self
    }

    fn from_normalized(value: f32) -> Self {
        value
    }

    fn index(self) -> i64 {
        self as i64
    }

    fn from_index(index: i64) -> Self {
        index as f32
    }
}

/// The elements that lie in `row`.
pub fn elements<T: Element>(row: &[u8]) -> impl Iterator<Item = T> {
    row.chunks_exact(size_of::<T>()).map(|chunk| {
        let mut bytes = T::Bytes::default();
        bytes.as_mut().copy_from_slice(chunk);
        T::from_bytes(bytes)
    })
}

/// Writes elements to `row`, as many as both have.
pub fn write_elements<T: Element>(values: impl Iterator<Item = T>, row: &mut [u8]) {
    for (chunk, value) in row.chunks_exact_mut(size_of::<T>()).zip(values) {
        chunk.copy_from_slice(value.to_bytes().as_ref());
    }
}

/// A component between 0 and 1 as a byte, rounded to the nearest.
pub fn unorm8(value: f32) -> u8 {
    (value * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        assert_eq!(255u8.normalized(), 1.0);
        assert_eq!(0x8000u16.normalized(), 32768.0 / 65535.0);
        assert_eq!(u32::MAX.normalized(), 1.0);
        assert_eq!(127i8.normalized(), 1.0);
        assert_eq!((-128i8).normalized(), -1.0);
        assert_eq!(0i8.normalized(), 1.0 / 255.0);
        assert_eq!(u16::from_normalized(2.0), 65535);
        assert_eq!(u32::from_normalized(1.0), u32::MAX);
        assert_eq!(i32::from_normalized(1.0), i32::MAX);
        assert_eq!(i8::from_normalized(0.0), 0);
        assert_eq!(i8::from_index(-1), 127);
        assert_eq!(u8::from_index(257), 1);
        assert_eq!((7.9f32).index(), 7);
        assert_eq!([unorm8(-1.0), unorm8(0.5), unorm8(3.0), unorm8(f32::NAN)], [0, 128, 255, 0]);
    }

    #[test]
    fn every_short_survives() {
        for bits in 0..=u16::MAX {
            assert_eq!(u16::from_normalized(bits.normalized()), bits);
            let signed = bits as i16;
            assert_eq!(i16::from_normalized(signed.normalized()), signed);
        }
    }
}
