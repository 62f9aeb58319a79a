//! A whole array in memory.

use crate::error::NpyError;
use crate::header::Header;

/// An array's numbers as the file has them.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    header: Header,
    bytes: Vec<u8>,
}

impl Array {
    /// The array that a file's bytes are.
    ///
    /// # Errors
    /// If the header is damaged, or there are more or fewer numbers than it says.
    pub fn parse(mut file: &[u8]) -> Result<Self, NpyError> {
        let header = Header::read(&mut file)?;
        let mut sides = header.shape.iter();
        let expected = sides.try_fold(header.element.bytes(), |bytes, side| bytes.checked_mul(*side));
        match expected {
            Some(expected) if expected == file.len() => Ok(Self { header, bytes: file.to_vec() }),
            expected => Err(NpyError::Length { expected: expected.unwrap_or(usize::MAX), found: file.len() }),
        }
    }

    /// Length along each axis.
    pub fn shape(&self) -> &[usize] {
        &self.header.shape
    }

    /// Rows of `N` floats, of an array of shape (any, N).
    ///
    /// # Errors
    /// If it has another shape.
    pub fn float_rows<const N: usize>(&self) -> Result<Vec<[f32; N]>, NpyError> {
        let element = self.header.element;
        self.rows("rows of numbers", |bytes| Some(element.float(bytes)))
    }

    /// Rows of `N` integers, of an array of shape (any, N).
    ///
    /// # Errors
    /// If it has another shape, or is of floats.
    pub fn integer_rows<const N: usize>(&self) -> Result<Vec<[i64; N]>, NpyError> {
        let element = self.header.element;
        self.rows("rows of integers", |bytes| element.integer(bytes))
    }

    /// Integers, of an array of one axis.
    ///
    /// # Errors
    /// If it has another shape, or is of floats.
    pub fn integers(&self) -> Result<Vec<i64>, NpyError> {
        let kind = || self.kind("integers");
        let [_] = self.shape() else { return Err(kind()) };
        let element = self.header.element;
        self.bytes
            .chunks_exact(element.bytes())
            .map(|bytes| element.integer(bytes))
            .collect::<Option<_>>()
            .ok_or_else(kind)
    }

    fn rows<T: Copy + Default, const N: usize>(
        &self,
        expected: &'static str,
        number: impl Fn(&[u8]) -> Option<T>,
    ) -> Result<Vec<[T; N]>, NpyError> {
        let &[count, width] = self.shape() else { return Err(self.kind(expected)) };
        if width != N {
            return Err(self.kind(expected));
        }
        let place = |row: usize, column: usize| match self.header.is_fortran_order {
            true => column * count + row,
            false => row * width + column,
        };
        let size = self.header.element.bytes();
        let mut rows = vec![[T::default(); N]; count];
        for (index, row) in rows.iter_mut().enumerate() {
            for (column, value) in row.iter_mut().enumerate() {
                let bytes = &self.bytes[place(index, column) * size..][..size];
                *value = number(bytes).ok_or_else(|| self.kind(expected))?;
            }
        }
        Ok(rows)
    }

    fn kind(&self, expected: &'static str) -> NpyError {
        let found = format!("{:?} of shape {:?}", self.header.element, self.header.shape);
        NpyError::Kind { expected, found }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::header::MAGIC;

    fn file(descr: &str, order: &str, shape: &str, numbers: &[u8]) -> Vec<u8> {
        let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n");
        let mut bytes = MAGIC.to_vec();
        bytes.extend([1, 0]);
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(numbers);
        bytes
    }

    #[test]
    fn both_orders_give_the_same_rows() {
        let by_rows = Array::parse(&file("|u1", "False", "(2, 3)", &[1, 2, 3, 4, 5, 6])).unwrap();
        let by_columns = Array::parse(&file("|u1", "True", "(2, 3)", &[1, 4, 2, 5, 3, 6])).unwrap();
        assert_eq!(by_rows.integer_rows::<3>().unwrap(), [[1, 2, 3], [4, 5, 6]]);
        assert_eq!(by_rows.integer_rows::<3>().unwrap(), by_columns.integer_rows::<3>().unwrap());
        assert_eq!(by_columns.float_rows::<3>().unwrap()[1], [4.0, 5.0, 6.0]);
    }

    #[test]
    fn other_shapes_and_lengths_are_errors() {
        let parse = |shape: &str, bytes: usize| Array::parse(&file("<f4", "False", shape, &vec![0; bytes]));
        assert!(parse("(2, 3)", 23).is_err() && parse("(2, 3)", 25).is_err());
        assert!(parse("(4000000000, 4000000000, 4000000000)", 24).is_err());
        let floats = parse("(2, 3)", 24).unwrap();
        assert!(floats.float_rows::<2>().is_err());
        assert!(floats.integer_rows::<3>().is_err() && floats.integers().is_err());
        assert!(parse("(0, 3)", 0).unwrap().float_rows::<3>().unwrap().is_empty());
    }
}
