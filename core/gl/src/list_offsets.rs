//! The many types that glCallLists takes (specification 5.4).

use afterglow_api::constants::*;

/// Bytes of one offset of that type; `None` if the type is none.
pub fn list_offset_bytes(kind: u32) -> Option<usize> {
    Some(match kind {
        GL_BYTE | GL_UNSIGNED_BYTE => 1,
        GL_SHORT | GL_UNSIGNED_SHORT | GL_2_BYTES => 2,
        GL_3_BYTES => 3,
        GL_INT | GL_UNSIGNED_INT | GL_FLOAT | GL_4_BYTES => 4,
        _ => return None,
    })
}

/// `count` offsets of lists as the specification 5.4 decodes them; signed ones wrap. `None` if the type is none, or
/// there are too few bytes.
pub fn list_offsets(kind: u32, bytes: &[u8], count: usize) -> Option<Vec<u32>> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_of_lists_have_many_types() {
        for kind in [GL_BYTE, GL_UNSIGNED_SHORT, GL_3_BYTES, GL_FLOAT] {
            let bytes = list_offset_bytes(kind).unwrap();
            assert!(list_offsets(kind, &vec![0; bytes], 1).is_some());
            assert!(list_offsets(kind, &vec![0; bytes - 1], 1).is_none());
        }
        assert_eq!(list_offset_bytes(GL_DOUBLE), None);
        assert_eq!(list_offsets(GL_BYTE, &[255, 1], 2), Some(vec![u32::MAX, 1]));
        assert_eq!(list_offsets(GL_SHORT, &[0xfe, 0xff], 1), Some(vec![u32::MAX - 1]));
        assert_eq!(list_offsets(GL_2_BYTES, &[1, 2, 0, 3], 2), Some(vec![0x102, 3]));
        assert_eq!(list_offsets(GL_3_BYTES, &[1, 2, 3], 1), Some(vec![0x010203]));
        assert_eq!(list_offsets(GL_FLOAT, &(-1.5f32).to_le_bytes(), 1), Some(vec![u32::MAX - 1]));
        assert_eq!(list_offsets(GL_UNSIGNED_SHORT, &[1, 0, 2], 2), None);
        assert_eq!(list_offsets(GL_DOUBLE, &[0; 8], 1), None);
    }
}
