//! Telling the containers apart by the first bytes of a file.
//!
//! Brotli and the uncompressed stream have no magic number. An uncompressed stream is recognised by its header and the
//! first name in it; what is nothing else is taken for Brotli.

use std::io::{BufReader, Cursor, Read};

use super::brotli::BrotliDecoder;
use super::inflate::{GZIP_MAGIC, InflateDecoder};
use super::raw::RawDecoder;
use super::snappy::{self, SnappyDecoder};
use super::{Container, Decode, Source, fill};
use crate::error::TraceError;
use crate::format::{self, NEWEST_VERSION};

/// Bytes looked at.
const PREFIX_BYTES: usize = 512;

/// Bytes read from the file at once.
const READ_BYTES: usize = 1 << 16;

const ZSTANDARD_MAGIC: [u8; 4] = 0xfd2f_b528u32.to_le_bytes();

/// Finds out the container of what `source` yields, and the decoder for it.
pub(crate) fn open(
    mut source: impl Read + Send + 'static,
) -> Result<(Container, Box<dyn Decode>), TraceError> {
    let (mut prefix, mut length) = (vec![0; PREFIX_BYTES], 0);
    fill(&mut source, &mut prefix, &mut length).map_err(TraceError::Io)?;
    prefix.truncate(length);
    let container = detect(&prefix)?;
    if container == Container::Snappy {
        prefix.drain(..snappy::MAGIC.len());
    }
    let whole = Cursor::new(prefix).chain(source);
    let source: Source = Box::new(BufReader::with_capacity(READ_BYTES, whole));
    let decoder: Box<dyn Decode> = match container {
        Container::Snappy => Box::new(SnappyDecoder::new(source)),
        Container::Gzip => Box::new(InflateDecoder::gzip(source)),
        Container::Zlib => Box::new(InflateDecoder::zlib(source)),
        Container::Brotli => Box::new(BrotliDecoder::new(source)),
        Container::Raw => Box::new(RawDecoder::new(source)),
    };
    Ok((container, decoder))
}

fn detect(prefix: &[u8]) -> Result<Container, TraceError> {
    match prefix {
        [] => Err(TraceError::NotATrace),
        _ if prefix.starts_with(&snappy::MAGIC) => Ok(Container::Snappy),
        _ if prefix.starts_with(&GZIP_MAGIC) => Ok(Container::Gzip),
        _ if prefix.starts_with(&ZSTANDARD_MAGIC) => Err(TraceError::UnsupportedContainer("Zstandard")),
        _ if is_zlib(prefix) => Ok(Container::Zlib),
        _ if looks_raw(prefix).unwrap_or(true) => Ok(Container::Raw),
        _ => Ok(Container::Brotli),
    }
}

/// RFC 1950, section 2.2: method 8 with its usual window, no dictionary, and a check sum that makes a multiple of 31.
fn is_zlib(prefix: &[u8]) -> bool {
    let [0x78, flags, ..] = *prefix else {
        return false;
    };
    flags & 0x20 == 0 && (0x7800 + u16::from(flags)).is_multiple_of(31)
}

/// Whether the bytes are the start of an uncompressed stream; `None` if they end before that is clear.
fn looks_raw(prefix: &[u8]) -> Option<bool> {
    let mut bytes = prefix.iter().copied();
    let version = u32::from(bytes.next()?);
    if version > NEWEST_VERSION {
        return Some(false);
    }
    if version >= format::VERSION_PROPERTIES {
        if u32::from(bytes.next()?) > NEWEST_VERSION {
            return Some(false);
        }
        match bytes.next()? {
            0 => {}
            length => return is_name(&mut bytes, length),
        }
    }
    if bytes.next()? != format::event::ENTER {
        return Some(false);
    }
    let numbers = if version >= format::VERSION_THREAD_IN_ENTER { 2 } else { 1 };
    for _ in 0..numbers {
        while bytes.next()? >= 0x80 {}
    }
    let length = bytes.next()?;
    is_name(&mut bytes, length)
}

/// Whether a string of fewer than 128 bytes is printable, as far as it goes.
fn is_name(bytes: &mut impl Iterator<Item = u8>, length: u8) -> Option<bool> {
    let plausible = (1..0x80).contains(&length);
    Some(plausible && bytes.take(length.into()).all(|byte| byte.is_ascii_graphic()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn containers_are_told_apart() {
        let of = |prefix: &[u8]| detect(prefix).unwrap();
        assert_eq!(of(b"at\x10\0\0\0"), Container::Snappy);
        assert_eq!(of(&[0x1f, 0x8b, 8]), Container::Gzip);
        for flags in [0x01, 0x5e, 0x9c, 0xda] {
            assert_eq!(of(&[0x78, flags, 0]), Container::Zlib);
        }
        assert_eq!(of(b"\x06\x06\x0cprocess.name"), Container::Raw);
        assert_eq!(of(b"\x06\x05\x00\x00\x00\x81\x01\x07glBegin"), Container::Raw);
        assert_eq!(of(b"\x02\x00\x05\x07glBegin"), Container::Raw);
        assert_eq!(of(&[0xcf, 0xff, 0xff, 0x7f]), Container::Brotli);
        assert_eq!(of(b"\x02\x01\x05\x07glBegin"), Container::Brotli);
        assert_eq!(of(b"\x05\x00\x05\x05\x07gl\nBegi"), Container::Brotli);
    }

    #[test]
    fn what_is_no_trace_is_refused() {
        assert!(matches!(detect(b""), Err(TraceError::NotATrace)));
        let zstandard = detect(&[0x28, 0xb5, 0x2f, 0xfd, 0]);
        assert!(matches!(zstandard, Err(TraceError::UnsupportedContainer("Zstandard"))));
    }
}
