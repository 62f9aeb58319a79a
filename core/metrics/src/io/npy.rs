//! NumPy's `.npy` (NEP 1): a short text header and the bare numbers.

use std::io::{Read, Write};

use afterglow_npy::{Header, MAGIC};

use crate::error::FormatError;
use crate::image::{Encoding, Image, checked_pixel_count};

/// Reads linear light from an array of shape (H, W, 3), row 0 on top, of little-endian `f2`, `f4` or `f8` in C order. Bytes after it are
/// left unread, so members of archives can be given too.
///
/// # Errors
/// If the header is damaged or another kind of array, the picture is too large, or numbers are missing.
pub fn read(reader: &mut impl Read) -> Result<Image, FormatError> {
    let header = Header::read(reader)?;
    let element = header.element;
    if !element.is_float() || header.is_fortran_order {
        return Err(header.refused("only <f2, <f4 and <f8 in C order are read").into());
    }
    let &[height, width, 3] = header.shape.as_slice() else {
        return Err(header.refused("only arrays of shape (H, W, 3) are read").into());
    };
    let count = checked_pixel_count(width, height)?;

    // Row by row, so that memory grows with what is really there and not with what the header claims.
    let mut row = vec![0u8; width * 3 * element.bytes()];
    let mut pixels = Vec::new();
    for _ in 0..height {
        reader.read_exact(&mut row)?;
        pixels.extend(row.chunks_exact(3 * element.bytes()).map(|bytes| {
            let mut samples = bytes.chunks_exact(element.bytes());
            std::array::from_fn(|_| samples.next().map_or(f32::NAN, |s| element.float(s)))
        }));
    }
    debug_assert_eq!(pixels.len(), count);
    Image::new(width, height, Encoding::Linear, pixels)
}

/// Writes linear light as little-endian `f4` of shape (H, W, 3).
///
/// # Errors
/// If the writer fails.
pub fn write(image: &Image, writer: &mut impl Write) -> Result<(), FormatError> {
    let mut header = format!(
        "{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, 3), }}",
        image.height(),
        image.width()
    );
    // Magic, version and length are 10 bytes; the numbers begin at a multiple of 64, after a line's end.
    let padding = 63 - (10 + header.len()) % 64;
    header.extend(std::iter::repeat_n(' ', padding));
    header.push('\n');
    writer.write_all(MAGIC)?;
    writer.write_all(&[1, 0])?;
    writer.write_all(&(header.len() as u16).to_le_bytes())?;
    writer.write_all(header.as_bytes())?;
    for value in image.to_linear().pixels().iter().flatten() {
        writer.write_all(&value.to_le_bytes())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use half::f16;

    use super::*;
    use crate::test_images as synthetic;

    fn file(version: u8, header: &str, data: &[u8]) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend([version, 0]);
        match version {
            1 => bytes.extend((header.len() as u16).to_le_bytes()),
            _ => bytes.extend((header.len() as u32).to_le_bytes()),
        }
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        bytes
    }

    fn error(bytes: &[u8]) -> String {
        read(&mut &bytes[..]).unwrap_err().to_string()
    }

    #[test]
    fn writes_what_numpy_writes() {
        let image = Image::new(2, 1, Encoding::Linear, vec![[1.0; 3], [2.0; 3]]).unwrap();
        let mut bytes = Vec::new();
        write(&image, &mut bytes).unwrap();
        let text = "\u{93}NUMPY\u{1}\0v\0{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3), }";
        let expected: Vec<u8> = text.chars().map(|c| c as u8).collect();
        assert_eq!(bytes[..expected.len()], expected);
        assert_eq!(bytes[127], b'\n');
        assert_eq!(bytes.len(), 128 + 24);
        assert_eq!(bytes[128..132], 1.0f32.to_le_bytes());
    }

    #[test]
    fn reads_back_and_stops_at_the_end() {
        let image = synthetic::wide();
        let mut bytes = Vec::new();
        write(&image, &mut bytes).unwrap();
        bytes.extend(b"more");
        let mut rest = &bytes[..];
        assert_eq!(read(&mut rest).unwrap(), image);
        assert_eq!(rest, b"more");
    }

    #[test]
    fn reads_half_and_double_and_later_versions() {
        let header = "{'shape': (1, 1, 3), 'fortran_order': False, 'descr': '<f2'}\n";
        let halves: Vec<u8> =
            [0.5, 1.5, -2.0].into_iter().flat_map(|v| f16::from_f32(v).to_le_bytes()).collect();
        let image = read(&mut &file(2, header, &halves)[..]).unwrap();
        assert_eq!(image.pixel(0, 0), [0.5, 1.5, -2.0]);
        let header = header.replace("<f2", "<f8");
        let doubles: Vec<u8> = [0.25f64, 1e300, 3.0].into_iter().flat_map(f64::to_le_bytes).collect();
        let image = read(&mut &file(3, &header, &doubles)[..]).unwrap();
        assert_eq!(image.pixel(0, 0), [0.25, f32::INFINITY, 3.0]);
    }

    #[test]
    fn other_arrays_are_refused_with_a_reason() {
        let with = |descr: &str, order: &str, shape: &str| {
            let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n");
            error(&file(1, &header, &[0; 64]))
        };
        assert!(with("<i4", "False", "(1, 1, 3)").contains("<f4"));
        assert!(with(">f4", "False", "(1, 1, 3)").contains("<f4"));
        assert!(with("<f4", "True", "(1, 1, 3)").contains("C order"));
        for shape in ["(1, 1)", "(1, 1, 4)", "()", "(-1, 1, 3)", "(1, 1, 3", "3"] {
            assert!(with("<f4", "False", shape).contains("shape"), "{shape}");
        }
    }

    #[test]
    fn absurd_headers_are_refused() {
        let huge = "{'descr': '<f4', 'fortran_order': False, 'shape': (4000000000, 4000000000, 3)}";
        assert!(error(&file(1, huge, &[])).contains("refused"));
        let large = "{'descr': '<f4', 'fortran_order': False, 'shape': (1024, 32768, 3)}";
        assert!(matches!(read(&mut &file(1, large, &[0; 100])[..]), Err(FormatError::Io(_))));
        let mut endless = file(2, "", &[]);
        endless[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(error(&endless).contains("header"));
        assert!(error(b"\x93NUMPX\x01\0\0\0").contains("not an npy"));
        assert!(read(&mut &b"\x93NUM"[..]).is_err());
    }
}
