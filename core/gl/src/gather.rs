//! Elements of client arrays become vertices of the frame's layout.

use afterglow_api::constants::*;

use crate::frame::Format;

/// Bytes of one component.
pub fn component_bytes(kind: u32) -> usize {
    match kind {
        GL_BYTE | GL_UNSIGNED_BYTE => 1,
        GL_SHORT | GL_UNSIGNED_SHORT => 2,
        GL_DOUBLE => 8,
        _ => 4,
    }
}

/// How the elements of an array are stored.
pub fn stored_format(size: u8, kind: u32, normalized: bool) -> Format {
    match size {
        3 | 4 if kind == GL_UNSIGNED_BYTE && normalized => Format::Unorm8x4,
        1 => Format::F1,
        2 => Format::F2,
        3 => Format::F3,
        _ => Format::F4,
    }
}

/// Elements of one array: `bytes` starts with the first to be read, and holds all of them.
#[derive(Debug, Clone, Copy)]
pub struct Elements<'a> {
    /// The bytes.
    pub bytes: &'a [u8],
    /// Bytes from one element to the next.
    pub stride: usize,
    /// Components.
    pub size: usize,
    /// GL_FLOAT and so on.
    pub kind: u32,
    /// Whether integers are mapped to [0, 1] or [-1, 1].
    pub normalized: bool,
}

impl Elements<'_> {
    /// Bytes that `count` elements need.
    pub fn needed(stride: usize, size: usize, kind: u32, count: usize) -> Option<usize> {
        if count == 0 {
            return Some(0);
        }
        (count - 1).checked_mul(stride)?.checked_add(size * component_bytes(kind))
    }

    /// Writes `count` elements at word `offset` of vertices of `stride` words.
    pub fn store(&self, count: usize, format: Format, out: &mut [u32], offset: usize, stride: usize) {
        match (format, self.kind, self.size) {
            (Format::Unorm8x4, _, 4) => self.copy_words::<1>(count, out, offset, stride),
            (Format::Unorm8x4, ..) => {
                for (element, vertex) in self.pairs(count, out, stride) {
                    vertex[offset] = u32::from_le_bytes([element[0], element[1], element[2], 255]);
                }
            }
            (_, GL_FLOAT, 1) => self.copy_words::<1>(count, out, offset, stride),
            (_, GL_FLOAT, 2) => self.copy_words::<2>(count, out, offset, stride),
            (_, GL_FLOAT, 3) => self.copy_words::<3>(count, out, offset, stride),
            (_, GL_FLOAT, 4) => self.copy_words::<4>(count, out, offset, stride),
            _ => {
                for (element, vertex) in self.pairs(count, out, stride) {
                    for c in 0..self.size {
                        vertex[offset + c] = self.component(element, c).to_bits();
                    }
                }
            }
        }
    }

    /// Element `i`, missing components from (0, 0, 0, 1).
    pub fn get(&self, i: usize) -> [f32; 4] {
        let mut value = [0.0, 0.0, 0.0, 1.0];
        let element = &self.bytes[i * self.stride..];
        for (c, v) in value.iter_mut().enumerate().take(self.size) {
            *v = self.component(element, c);
        }
        value
    }

    fn pairs<'a>(
        &'a self,
        count: usize,
        out: &'a mut [u32],
        stride: usize,
    ) -> impl Iterator<Item = (&'a [u8], &'a mut [u32])> {
        (0..count).map(|i| &self.bytes[i * self.stride..]).zip(out.chunks_exact_mut(stride))
    }

    fn copy_words<const N: usize>(&self, count: usize, out: &mut [u32], offset: usize, stride: usize) {
        for (element, vertex) in self.pairs(count, out, stride) {
            let (words, _) = element[..4 * N].as_chunks::<4>();
            for (word, bytes) in vertex[offset..offset + N].iter_mut().zip(words) {
                *word = u32::from_le_bytes(*bytes);
            }
        }
    }

    fn component(&self, element: &[u8], c: usize) -> f32 {
        fn at<const N: usize>(element: &[u8], c: usize) -> [u8; N] {
            element[c * N..].first_chunk().copied().unwrap_or([0; N])
        }
        let unsigned = |v: u32, max: u32| if self.normalized { (f64::from(v) / f64::from(max)) as f32 } else { v as f32 };
        let signed = |v: i32, max: u32| {
            if self.normalized { ((2.0 * f64::from(v) + 1.0) / f64::from(max)) as f32 } else { v as f32 }
        };
        match self.kind {
            GL_BYTE => signed(i8::from_le_bytes(at(element, c)).into(), 255),
            GL_UNSIGNED_BYTE => unsigned(element[c].into(), 255),
            GL_SHORT => signed(i16::from_le_bytes(at(element, c)).into(), 65535),
            GL_UNSIGNED_SHORT => unsigned(u16::from_le_bytes(at(element, c)).into(), 65535),
            GL_INT => signed(i32::from_le_bytes(at(element, c)), u32::MAX),
            GL_UNSIGNED_INT => unsigned(u32::from_le_bytes(at(element, c)), u32::MAX),
            GL_DOUBLE => f64::from_le_bytes(at(element, c)) as f32,
            _ => f32::from_le_bytes(at(element, c)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shorts_become_floats_and_bytes_stay_packed() {
        let bytes: Vec<u8> = [1i16, -2, 3, 4].iter().flat_map(|v| v.to_le_bytes()).collect();
        let elements = Elements { bytes: &bytes, stride: 4, size: 2, kind: GL_SHORT, normalized: false };
        let mut out = [0; 6];
        elements.store(2, Format::F2, &mut out, 1, 3);
        assert_eq!(out.map(f32::from_bits), [0.0, 1.0, -2.0, 0.0, 3.0, 4.0]);
        let colors = [1, 2, 3, 4, 5, 6];
        let elements =
            Elements { bytes: &colors, stride: 3, size: 3, kind: GL_UNSIGNED_BYTE, normalized: true };
        let mut out = [0; 2];
        elements.store(2, Format::Unorm8x4, &mut out, 0, 1);
        assert_eq!(out.map(u32::to_le_bytes), [[1, 2, 3, 255], [4, 5, 6, 255]]);
    }

    #[test]
    fn normalized_integers_reach_their_ends() {
        let bytes = [127u8, 128];
        let elements = Elements { bytes: &bytes, stride: 1, size: 1, kind: GL_BYTE, normalized: true };
        assert_eq!((elements.get(0)[0], elements.get(1)[0]), (1.0, -1.0));
    }
}
