//! What a triangle is known by: its corners' positions, whichever of them comes first.

use afterglow_gl::frame::{Format, Slot, VertexLayout};

/// Odd numbers without structure: the fractional parts of the square roots of 2, 3 and 5.
const MIX: [u64; 3] = [0x6a09_e667_f3bc_c909, 0xbb67_ae85_84ca_a73b, 0x3c6e_f372_fe94_f82b];
const ONE: u32 = 1.0_f32.to_bits();

/// Reads object-space positions out of vertices, as bits: x, y, z, w, with -0 as +0.
#[derive(Clone, Copy)]
pub struct Positions<'a> {
    words: &'a [u32],
    stride: usize,
    components: usize,
}

impl<'a> Positions<'a> {
    /// Of vertices that are stored so; a position is the first attribute of a vertex.
    pub fn new(words: &'a [u32], layout: VertexLayout) -> Positions<'a> {
        let components = match layout.format(Slot::Position as usize) {
            Format::Absent | Format::Unorm8x4 => 0,
            format => format.words(),
        };
        Positions { words, stride: layout.stride(), components }
    }

    /// The position of a vertex; none if there is no such vertex.
    #[inline]
    pub fn bits(&self, vertex: u32) -> Option<[u32; 4]> {
        let start = vertex as usize * self.stride;
        let mut position = [0, 0, 0, ONE];
        match *self.words.get(start..start + self.components)? {
            [x, y, z] => (position[0], position[1], position[2]) = (positive(x), positive(y), positive(z)),
            [] => return None,
            ref words => {
                for (to, from) in position.iter_mut().zip(words) {
                    *to = positive(*from);
                }
            }
        }
        Some(position)
    }

    /// The corners of a triangle; none if it has no area or lies at infinity.
    #[inline]
    pub fn corners(&self, indices: &[u32]) -> Option<[[u32; 4]; 3]> {
        let &[a, b, c] = indices else { return None };
        let corners = [self.bits(a)?, self.bits(b)?, self.bits(c)?];
        let is_sound = |corner: &[u32; 4]| {
            let reach = f32::from_bits(corner[0]).abs()
                + f32::from_bits(corner[1]).abs()
                + f32::from_bits(corner[2]).abs();
            // Written so that what is not a number fails.
            reach < 1e15 && corner[3] != 0
        };
        let has_area = corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
        (has_area && corners.iter().all(is_sound)).then_some(corners)
    }
}

/// Bits of a float; -0 is +0.
#[inline]
fn positive(bits: u32) -> u32 {
    if bits == 1 << 31 { 0 } else { bits }
}

/// The position of a corner.
pub fn position([x, y, z, w]: [u32; 4]) -> glam::Vec3 {
    let position = glam::Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z));
    if w == ONE { position } else { position / f32::from_bits(w) }
}

/// Key of a triangle at a place: the same from whichever corner it is begun, another from behind.
#[inline]
pub fn triangle_key(corners: [[u32; 4]; 3], place: u32) -> u64 {
    let [a, b, c] = corners.map(corner_hash);
    // The smallest first, winding kept.
    let [a, b, c] = match (a <= b, b <= c, a <= c) {
        (true, _, true) => [a, b, c],
        (false, true, _) => [b, c, a],
        _ => [c, a, b],
    };
    fold(fold(a ^ u64::from(place), b), c ^ MIX[2])
}

#[inline]
fn corner_hash([x, y, z, w]: [u32; 4]) -> u64 {
    let pair = |low: u32, high: u32| u64::from(low) | u64::from(high) << 32;
    fold(pair(x, y) ^ MIX[0], pair(z, w) ^ MIX[1])
}

/// Both halves of the product of two numbers.
#[inline]
pub fn fold(a: u64, b: u64) -> u64 {
    let product = u128::from(a ^ MIX[1]) * u128::from(b ^ MIX[0]);
    product as u64 ^ (product >> 64) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f32, y: f32, z: f32) -> [u32; 4] {
        [x, y, z, 1.0].map(|c| positive(c.to_bits()))
    }

    #[test]
    fn a_triangle_is_the_same_from_any_corner_but_not_from_behind() {
        let [a, b, c] = [corner(1.0, 0.0, -0.0), corner(0.0, 2.0, 0.0), corner(3.0, 3.0, 3.0)];
        let key = triangle_key([a, b, c], 0);
        assert_eq!(key, triangle_key([c, a, b], 0));
        assert_eq!(key, triangle_key([b, c, corner(1.0, 0.0, 0.0)], 0));
        assert_ne!(key, triangle_key([a, c, b], 0));
        assert_ne!(key, triangle_key([a, b, c], 1));
    }

    #[test]
    fn what_has_no_area_or_is_not_a_number_has_no_corners() {
        let layout = VertexLayout::default().with(Slot::Position as usize, Format::F3);
        let words = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, f32::NAN, 0.0, 0.0].map(f32::to_bits);
        let positions = Positions::new(&words, layout);
        assert!(positions.corners(&[0, 1, 2]).is_some());
        for indices in [[0, 1, 1], [0, 1, 3], [0, 1, 9]] {
            assert!(positions.corners(&indices).is_none());
        }
        assert!(Positions::new(&words, VertexLayout::default()).corners(&[0, 1, 2]).is_none());
    }
}
