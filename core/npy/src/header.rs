//! The header of an array: a Python dictionary as text.

use std::io::Read;

use half::f16;

use crate::error::NpyError;

/// What an `.npy` file begins with.
pub const MAGIC: &[u8; 6] = b"\x93NUMPY";
/// Longest header that is accepted, in bytes; that of a picture has 118.
const MAX_HEADER: usize = 1 << 14;
/// Dimensions of NumPy's arrays, at most.
const MAX_DIMENSIONS: usize = 32;

/// A number in a file, little-endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    F16,
    F32,
    F64,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
}

impl Element {
    fn of(descr: &str) -> Option<Self> {
        let text = descr.strip_prefix('\'')?.split_once('\'')?.0;
        Some(match text {
            "<f2" => Self::F16,
            "<f4" => Self::F32,
            "<f8" => Self::F64,
            "|i1" | "<i1" => Self::I8,
            "|u1" | "<u1" => Self::U8,
            "<i2" => Self::I16,
            "<u2" => Self::U16,
            "<i4" => Self::I32,
            "<u4" => Self::U32,
            "<i8" => Self::I64,
            "<u8" => Self::U64,
            _ => return None,
        })
    }

    /// Bytes of one.
    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::F16 | Self::I16 | Self::U16 => 2,
            Self::F32 | Self::I32 | Self::U32 => 4,
            Self::F64 | Self::I64 | Self::U64 => 8,
        }
    }

    /// Whether it is a floating-point number.
    pub fn is_float(self) -> bool {
        matches!(self, Self::F16 | Self::F32 | Self::F64)
    }

    /// The number in [`Element::bytes`] bytes, rounded to f32; NaN if there are not as many.
    pub fn float(self, bytes: &[u8]) -> f32 {
        match (self, bytes) {
            (Self::F16, &[a, b]) => f16::from_le_bytes([a, b]).to_f32(),
            (Self::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
            (Self::F64, &[a, b, c, d, e, f, g, h]) => f64::from_le_bytes([a, b, c, d, e, f, g, h]) as f32,
            (Self::F16 | Self::F32 | Self::F64, _) => f32::NAN,
            _ => self.integer(bytes).map_or(f32::NAN, |integer| integer as f32),
        }
    }

    /// The integer in [`Element::bytes`] bytes, at most `i64::MAX`; none if it is a floating-point number.
    pub fn integer(self, bytes: &[u8]) -> Option<i64> {
        let mut wide = [0; 8];
        wide.get_mut(..bytes.len())?.copy_from_slice(bytes);
        let unsigned = u64::from_le_bytes(wide);
        match self {
            Self::F16 | Self::F32 | Self::F64 => None,
            Self::U8 | Self::U16 | Self::U32 | Self::U64 => Some(i64::try_from(unsigned).unwrap_or(i64::MAX)),
            Self::I8 => Some((unsigned as i8).into()),
            Self::I16 => Some((unsigned as i16).into()),
            Self::I32 => Some((unsigned as i32).into()),
            Self::I64 => Some(unsigned as i64),
        }
    }
}

/// What an array is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    pub element: Element,
    /// The first index runs fastest.
    pub is_fortran_order: bool,
    /// Length along each axis.
    pub shape: Vec<usize>,
    /// As the file has it, for messages.
    text: String,
}

impl Header {
    /// Reads a header, and nothing of the numbers after it.
    ///
    /// # Errors
    /// If it is damaged or of elements that are not known.
    pub fn read(reader: &mut impl Read) -> Result<Self, NpyError> {
        Self::parse(header_text(reader)?)
    }

    /// Of a Python dictionary with the keys `descr`, `fortran_order` and `shape`, in any order.
    fn parse(text: String) -> Result<Self, NpyError> {
        let refused = |reason: &str| refused(reason, &text);
        let value = |key: &str| value_of(&text, key).ok_or_else(|| refused(&format!("no {key}")));
        let element = Element::of(value("descr")?);
        let element =
            element.ok_or_else(|| refused("only little-endian <f2, <f4, <f8 and integers are read"))?;
        let is_fortran_order = value("fortran_order")?.starts_with("True");
        let shape = shape(value("shape")?).ok_or_else(|| refused("no shape of an array"))?;
        Ok(Self { element, is_fortran_order, shape, text })
    }

    /// An error that shows the header.
    pub fn refused(&self, reason: &str) -> NpyError {
        refused(reason, &self.text)
    }
}

fn header_text(reader: &mut impl Read) -> Result<String, NpyError> {
    let mut start = [0u8; 8];
    reader.read_exact(&mut start)?;
    let [magic @ .., major, _minor] = start;
    if magic != *MAGIC {
        return Err(NpyError::Magic);
    }
    let length = match major {
        1 => {
            let mut bytes = [0u8; 2];
            reader.read_exact(&mut bytes)?;
            usize::from(u16::from_le_bytes(bytes))
        }
        2 | 3 => {
            let mut bytes = [0u8; 4];
            reader.read_exact(&mut bytes)?;
            u32::from_le_bytes(bytes) as usize
        }
        _ => return Err(NpyError::Version(major)),
    };
    if length > MAX_HEADER {
        return Err(NpyError::HeaderLength(length));
    }
    let mut header = vec![0u8; length];
    reader.read_exact(&mut header)?;
    String::from_utf8(header).map_err(|_| refused("it is no text", "something else"))
}

/// What follows `'key':`, up to the header's end.
fn value_of<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let quoted = format!("'{key}'");
    let after = text.find(&quoted)? + quoted.len();
    let value = text[after..].trim_start().strip_prefix(':');
    value.map(str::trim_start)
}

fn shape(value: &str) -> Option<Vec<usize>> {
    let (inside, _) = value.strip_prefix('(')?.split_once(')')?;
    let inside = inside.trim().trim_end_matches(',');
    if inside.is_empty() {
        return Some(Vec::new());
    }
    let sides: Vec<_> = inside.split(',').map(|side| side.trim().parse().ok()).collect::<Option<_>>()?;
    (sides.len() <= MAX_DIMENSIONS).then_some(sides)
}

fn refused(reason: &str, header: &str) -> NpyError {
    let header = header.trim().chars().take(200).collect();
    NpyError::Header { reason: reason.into(), header }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(version: u8, text: &str) -> Result<Header, NpyError> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend([version, 0]);
        match version {
            1 => bytes.extend((text.len() as u16).to_le_bytes()),
            _ => bytes.extend((text.len() as u32).to_le_bytes()),
        }
        bytes.extend(text.as_bytes());
        Header::read(&mut &bytes[..])
    }

    #[test]
    fn keys_come_in_any_order() {
        let found = header(2, "{'shape': (5,), 'fortran_order': True, 'descr': '|u1'}\n").unwrap();
        assert_eq!((found.element, found.is_fortran_order), (Element::U8, true));
        assert_eq!(found.shape, [5]);
        let scalar = header(1, "{'descr': '<i8', 'fortran_order': False, 'shape': (), }").unwrap();
        assert_eq!((scalar.element, scalar.shape), (Element::I64, vec![]));
    }

    #[test]
    fn what_is_not_understood_is_shown() {
        for (text, reason) in [
            ("{'descr': '<U13', 'fortran_order': False, 'shape': (1,)}", "little-endian"),
            ("{'descr': '>f4', 'fortran_order': False, 'shape': (1,)}", "little-endian"),
            ("{'fortran_order': False, 'shape': (1,)}", "no descr"),
            ("{'descr': '<f4', 'fortran_order': False, 'shape': (-1,)}", "no shape"),
            ("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2", "no shape"),
        ] {
            let said = header(1, text).unwrap_err().to_string();
            assert!(said.contains(reason) && said.contains("{'"), "{said}");
        }
        assert!(matches!(header(9, ""), Err(NpyError::Version(9))));
    }

    #[test]
    fn numbers_are_signed_where_they_should_be() {
        assert_eq!(Element::I8.integer(&[0xff]), Some(-1));
        assert_eq!(Element::U16.integer(&[0xff, 0xff]), Some(65535));
        assert_eq!(Element::I32.integer(&(-7i32).to_le_bytes()), Some(-7));
        assert_eq!(Element::U64.integer(&u64::MAX.to_le_bytes()), Some(i64::MAX));
        assert_eq!(Element::F32.integer(&[0; 4]), None);
        assert_eq!(Element::I16.float(&(-3i16).to_le_bytes()), -3.0);
        assert_eq!(Element::U8.integer(&[0; 9]), None);
    }
}
