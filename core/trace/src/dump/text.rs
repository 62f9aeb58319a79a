//! Strings, quoted and escaped so that they stay on one line.

use std::fmt::{Formatter, Result, Write};

/// Writes a string's bytes.
pub(super) fn quote(f: &mut Formatter<'_>, bytes: &[u8]) -> Result {
    f.write_str("\"")?;
    for &byte in bytes {
        character(f, byte.into())?;
    }
    f.write_str("\"")
}

/// Writes a wide string's characters.
pub(super) fn quote_wide(f: &mut Formatter<'_>, characters: &[u32]) -> Result {
    f.write_str("L\"")?;
    for &code in characters {
        character(f, code)?;
    }
    f.write_str("\"")
}

fn character(f: &mut Formatter<'_>, code: u32) -> Result {
    match u8::try_from(code) {
        Ok(b'"') => f.write_str("\\\""),
        Ok(b'\\') => f.write_str("\\\\"),
        Ok(b'\n') => f.write_str("\\n"),
        Ok(b'\r') => f.write_str("\\r"),
        Ok(b'\t') => f.write_str("\t"),
        Ok(byte @ 0x20..0x7f) => f.write_char(byte.into()),
        Ok(byte) => write!(f, "\\{byte:03o}"),
        Err(_) => write!(f, "\\u{{{code:x}}}"),
    }
}
