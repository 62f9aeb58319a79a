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

/// What the elements of an array look like in memory.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// Bytes from one element to the next.
    pub stride: usize,
    /// Components.
    pub size: usize,
    /// GL_FLOAT and so on.
    pub kind: u32,
    /// Whether integers are mapped to [0, 1] or [-1, 1].
    pub normalized: bool,
}

impl Shape {
    /// Bytes that `count` elements need.
    pub fn bytes(&self, count: usize) -> Option<usize> {
        let element = self.size * component_bytes(self.kind);
        count.checked_sub(1).map_or(Some(0), |gaps| gaps.checked_mul(self.stride)?.checked_add(element))
    }

    /// The first `count` elements in `bytes`, or as many as there are.
    pub fn elements(self, bytes: &[u8], count: usize) -> Elements<'_> {
        let element = self.size * component_bytes(self.kind);
        let whole = bytes.len().checked_sub(element).map_or(0, |rest| rest / self.stride + 1);
        Elements { bytes, shape: self, count: count.min(whole) }
    }
}

/// Elements of one array.
#[derive(Debug, Clone, Copy)]
pub struct Elements<'a> {
    bytes: &'a [u8],
    shape: Shape,
    /// How many there are.
    pub count: usize,
}

impl Elements<'_> {
    /// Writes them at word `offset` of vertices of `stride` words.
    pub fn store(&self, format: Format, out: &mut [u32], offset: usize, stride: usize) {
        match (format, self.shape.kind, self.shape.size) {
            (Format::Unorm8x4, _, 4) => self.copy_words::<1>(out, offset, stride),
            (Format::Unorm8x4, ..) => {
                for (element, vertex) in self.pairs(out, stride) {
                    vertex[offset] = u32::from_le_bytes([element[0], element[1], element[2], 255]);
                }
            }
            (_, GL_FLOAT, 1) => self.copy_words::<1>(out, offset, stride),
            (_, GL_FLOAT, 2) => self.copy_words::<2>(out, offset, stride),
            (_, GL_FLOAT, 3) => self.copy_words::<3>(out, offset, stride),
            (_, GL_FLOAT, 4) => self.copy_words::<4>(out, offset, stride),
            _ => {
                for (element, vertex) in self.pairs(out, stride) {
                    for c in 0..self.shape.size {
                        vertex[offset + c] = self.component(element, c).to_bits();
                    }
                }
            }
        }
    }

    /// Appends them to vertices of `stride` words that consist of them alone, if they lie in memory as they are stored.
    /// Says whether it did.
    pub fn append_packed(&self, stride: usize, out: &mut Vec<u32>) -> bool {
        let is_packed =
            self.shape.kind == GL_FLOAT && self.shape.size == stride && self.shape.stride == 4 * stride;
        if is_packed {
            let (words, _) = self.bytes[..4 * stride * self.count].as_chunks::<4>();
            out.extend(words.iter().map(|bytes| u32::from_le_bytes(*bytes)));
        }
        is_packed
    }

    /// The first, missing components from (0, 0, 0, 1); `None` if there is none.
    pub fn first(&self) -> Option<[f32; 4]> {
        let mut value = [0.0, 0.0, 0.0, 1.0];
        for (c, v) in value.iter_mut().enumerate().take(self.shape.size) {
            *v = self.component(self.bytes, c);
        }
        (self.count > 0).then_some(value)
    }

    fn pairs<'a>(
        &'a self,
        out: &'a mut [u32],
        stride: usize,
    ) -> impl Iterator<Item = (&'a [u8], &'a mut [u32])> {
        (0..self.count).map(|i| &self.bytes[i * self.shape.stride..]).zip(out.chunks_exact_mut(stride))
    }

    fn copy_words<const N: usize>(&self, out: &mut [u32], offset: usize, stride: usize) {
        for (element, vertex) in self.pairs(out, stride) {
            let (words, _) = element[..4 * N].as_chunks::<4>();
            for (word, bytes) in vertex[offset..offset + N].iter_mut().zip(words) {
                *word = u32::from_le_bytes(*bytes);
            }
        }
    }

    fn component(&self, element: &[u8], c: usize) -> f32 {
        fn at<const N: usize>(element: &[u8], c: usize) -> [u8; N] {
            element.get(c * N..).and_then(<[u8]>::first_chunk).copied().unwrap_or([0; N])
        }
        let unsigned = |v: u32, max: u32| {
            if self.shape.normalized { (f64::from(v) / f64::from(max)) as f32 } else { v as f32 }
        };
        let signed = |v: i32, max: u32| {
            if self.shape.normalized {
                ((2.0 * f64::from(v) + 1.0) / f64::from(max)) as f32
            } else {
                v as f32
            }
        };
        match self.shape.kind {
            GL_BYTE => signed(i8::from_le_bytes(at(element, c)).into(), 255),
            GL_UNSIGNED_BYTE => unsigned(at::<1>(element, c)[0].into(), 255),
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

    fn shape(stride: usize, size: usize, kind: u32, normalized: bool) -> Shape {
        Shape { stride, size, kind, normalized }
    }

    #[test]
    fn shorts_become_floats_and_bytes_stay_packed() {
        let bytes: Vec<u8> = [1i16, -2, 3, 4].iter().flat_map(|v| v.to_le_bytes()).collect();
        let mut out = [0; 6];
        shape(4, 2, GL_SHORT, false).elements(&bytes, 2).store(Format::F2, &mut out, 1, 3);
        assert_eq!(out.map(f32::from_bits), [0.0, 1.0, -2.0, 0.0, 3.0, 4.0]);
        let colors = shape(3, 3, GL_UNSIGNED_BYTE, true);
        let mut out = [0; 2];
        colors.elements(&[1, 2, 3, 4, 5, 6], 2).store(Format::Unorm8x4, &mut out, 0, 1);
        assert_eq!(out.map(u32::to_le_bytes), [[1, 2, 3, 255], [4, 5, 6, 255]]);
    }

    #[test]
    fn normalized_integers_reach_their_ends() {
        let end = |byte: u8| shape(1, 1, GL_BYTE, true).elements(&[byte], 1).first().unwrap()[0];
        assert_eq!((end(127), end(128)), (1.0, -1.0));
    }

    #[test]
    fn arrays_that_end_early_have_fewer_elements() {
        let floats = shape(8, 2, GL_FLOAT, false);
        assert_eq!(floats.elements(&[0; 20], 9).count, 2);
        assert_eq!(floats.elements(&[0; 7], 9).count, 0);
        assert_eq!(floats.bytes(3), Some(24));
        assert_eq!(shape(16, 2, GL_FLOAT, false).elements(&[0; 24], 9).count, 2);
    }
}
