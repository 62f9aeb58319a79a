//! The readable start of a Snappy chunk that was cut or damaged.
//!
//! The library decodes a chunk whole or not at all, but a chunk may hold the last frames before a crash. This follows
//! Snappy's `format_description.txt` as far as the data go; it is not written for speed.

use crate::format::limits;

/// Replaces `output` with what `chunk` decodes to before its end or its first fault.
pub(super) fn decode_prefix(chunk: &[u8], output: &mut Vec<u8>) {
    output.clear();
    let Some((expected, mut rest)) = preamble(chunk) else {
        return;
    };
    let limit = expected.min(limits::SNAPPY_CHUNK as usize);
    while output.len() < limit && element(&mut rest, output, limit).is_some() {}
}

/// Decoded length, and what follows it.
fn preamble(chunk: &[u8]) -> Option<(usize, &[u8])> {
    let mut length = 0u64;
    for (index, &byte) in chunk.iter().enumerate().take(5) {
        length |= u64::from(byte & 0x7f) << (7 * index);
        if byte < 0x80 {
            return Some((length as usize, &chunk[index + 1..]));
        }
    }
    None
}

/// Decodes one literal or copy; a literal whose tail is missing yields what there is of it.
fn element(rest: &mut &[u8], output: &mut Vec<u8>, limit: usize) -> Option<()> {
    let tag = little_endian(rest, 1)?;
    let (short, high) = (tag >> 2, tag >> 5);
    match tag & 3 {
        0 => {
            let length = match short {
                0..60 => short,
                _ => little_endian(rest, short - 59)?,
            };
            literal(rest, length + 1, output, limit)
        }
        1 => {
            let offset = high << 8 | little_endian(rest, 1)?;
            copy(offset, (short & 7) + 4, output, limit)
        }
        kind => {
            let offset = little_endian(rest, if kind == 2 { 2 } else { 4 })?;
            copy(offset, short + 1, output, limit)
        }
    }
}

fn little_endian(rest: &mut &[u8], bytes: usize) -> Option<usize> {
    let (number, tail) = rest.split_at_checked(bytes)?;
    *rest = tail;
    Some(number.iter().rev().fold(0, |value, &byte| value << 8 | usize::from(byte)))
}

fn literal(rest: &mut &[u8], length: usize, output: &mut Vec<u8>, limit: usize) -> Option<()> {
    let present = length.min(rest.len()).min(limit - output.len());
    let (bytes, tail) = rest.split_at(present);
    output.extend_from_slice(bytes);
    *rest = tail;
    (present == length).then_some(())
}

fn copy(offset: usize, length: usize, output: &mut Vec<u8>, limit: usize) -> Option<()> {
    if offset == 0 || offset > output.len() || length > limit - output.len() {
        return None;
    }
    for _ in 0..length {
        // A copy may read what it writes: that is how runs are encoded.
        output.push(output[output.len() - offset]);
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Vec<u8> {
        let mut data: Vec<u8> = (0..70_000u32).map(|i| (i.wrapping_mul(i) >> 9) as u8).collect();
        data.extend([7; 5000]);
        data.extend_from_within(100..40_000);
        data
    }

    #[test]
    fn a_whole_chunk_decodes_as_the_library_decodes_it() {
        let data = sample();
        let chunk = snap::raw::Encoder::new().compress_vec(&data).unwrap();
        let mut output = Vec::new();
        decode_prefix(&chunk, &mut output);
        assert!(output == data);
    }

    #[test]
    fn a_cut_chunk_decodes_to_a_growing_prefix() {
        let data = sample();
        let chunk = snap::raw::Encoder::new().compress_vec(&data).unwrap();
        let (mut output, mut before) = (Vec::new(), 0);
        for length in (0..chunk.len()).step_by(97) {
            decode_prefix(&chunk[..length], &mut output);
            assert!(data.starts_with(&output) && output.len() >= before);
            before = output.len();
        }
        assert!(before > data.len() / 2);
    }

    #[test]
    fn a_damaged_chunk_ends_at_the_damage() {
        // Five bytes promised; a literal of two, then a copy from before the start.
        let mut output = Vec::new();
        decode_prefix(&[5, 1 << 2, b'a', b'b', 2 << 2 | 2, 9, 0], &mut output);
        assert_eq!(output, b"ab");
        decode_prefix(&[0xff; 9], &mut output);
        assert!(output.is_empty());
    }
}
