//! Arrays whose elements another argument describes: lists' names, buffers' bytes.

use afterglow_api::constants::*;
use afterglow_gl::Context;

use crate::args::*;

/// glCallLists: memory that holds `n` offsets.
pub fn call_lists(gl: &mut Context, a: Args) -> Option<()> {
    let (count, kind) = (usize::try_from(a.get(0, int)?).ok()?, a.get(1, uint)?);
    if count > 0 {
        gl.call_lists(&list_offsets(kind, a.bytes(2)?, count)?);
    }
    Some(())
}

/// Offsets of lists as the specification 5.4 decodes them; signed ones wrap.
fn list_offsets(kind: u32, bytes: &[u8], count: usize) -> Option<Vec<u32>> {
    fn all<const N: usize>(bytes: &[u8], count: usize, decode: fn([u8; N]) -> u32) -> Option<Vec<u32>> {
        let (elements, _) = bytes.as_chunks::<N>();
        Some(elements.get(..count)?.iter().map(|&element| decode(element)).collect())
    }
    match kind {
        GL_BYTE => all(bytes, count, |[b]| b as i8 as u32),
        GL_UNSIGNED_BYTE => all(bytes, count, |[b]| b.into()),
        GL_SHORT => all(bytes, count, |b| i16::from_le_bytes(b) as u32),
        GL_UNSIGNED_SHORT => all(bytes, count, |b| u16::from_le_bytes(b).into()),
        GL_INT | GL_UNSIGNED_INT => all(bytes, count, u32::from_le_bytes),
        GL_FLOAT => all(bytes, count, |b| f32::from_le_bytes(b).floor() as i64 as u32),
        GL_2_BYTES => all(bytes, count, |[a, b]| u32::from_be_bytes([0, 0, a, b])),
        GL_3_BYTES => all(bytes, count, |[a, b, c]| u32::from_be_bytes([0, a, b, c])),
        GL_4_BYTES => all(bytes, count, u32::from_be_bytes),
        _ => None,
    }
}

/// glBufferData; without data the bytes are undefined.
pub fn buffer_data(gl: &mut Context, a: Args) -> Option<()> {
    gl.buffer_data(a.get(0, uint)?, a.get(1, size)?, a.memory(2)?, a.get(3, uint)?);
    Some(())
}

/// glBufferSubData.
pub fn buffer_sub_data(gl: &mut Context, a: Args) -> Option<()> {
    let count = usize::try_from(a.get(2, size)?).ok()?;
    let bytes = if count == 0 { &[] } else { a.bytes(3)?.get(..count)? };
    gl.buffer_sub_data(a.get(0, uint)?, a.get(1, size)?, bytes);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_of_lists_have_many_types() {
        assert_eq!(list_offsets(GL_BYTE, &[255, 1], 2), Some(vec![u32::MAX, 1]));
        assert_eq!(list_offsets(GL_SHORT, &[0xfe, 0xff], 1), Some(vec![u32::MAX - 1]));
        assert_eq!(list_offsets(GL_2_BYTES, &[1, 2, 0, 3], 2), Some(vec![0x102, 3]));
        assert_eq!(list_offsets(GL_3_BYTES, &[1, 2, 3], 1), Some(vec![0x010203]));
        assert_eq!(list_offsets(GL_FLOAT, &(-1.5f32).to_le_bytes(), 1), Some(vec![u32::MAX - 1]));
        assert_eq!(list_offsets(GL_UNSIGNED_SHORT, &[1, 0, 2], 2), None);
        assert_eq!(list_offsets(GL_DOUBLE, &[0; 8], 1), None);
    }
}
