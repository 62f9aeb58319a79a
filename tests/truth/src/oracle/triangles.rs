//! Triangles of primitives, as OpenGL makes them (specification 2.6.1), and what tells them apart.

use afterglow_api::constants::*;
use glam::Vec3;

/// Corners of each triangle, by index.
pub fn corners(mode: u32, count: usize) -> Vec<[usize; 3]> {
    match mode {
        GL_TRIANGLES => (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        // Every other one is turned, so that all turn alike.
        GL_TRIANGLE_STRIP => {
            let turned = |i: usize| if i.is_multiple_of(2) { [i - 2, i - 1, i] } else { [i - 1, i - 2, i] };
            (2..count).map(turned).collect()
        }
        GL_TRIANGLE_FAN | GL_POLYGON => (2..count).map(|i| [0, i - 1, i]).collect(),
        GL_QUADS => {
            let quads = (0..count / 4).map(|i| 4 * i);
            quads.flat_map(|i| [[i, i + 1, i + 2], [i, i + 2, i + 3]]).collect()
        }
        GL_QUAD_STRIP => {
            let quads = (0..(count / 2).saturating_sub(1)).map(|i| 2 * i);
            quads.flat_map(|i| [[i, i + 1, i + 3], [i, i + 3, i + 2]]).collect()
        }
        _ => Vec::new(),
    }
}

fn mix(hash: u64, value: u64) -> u64 {
    let mixed = (hash ^ value).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed ^ (mixed >> 29)
}

fn bits(position: Vec3) -> u64 {
    // Adding zero makes -0 and +0 the same.
    position.to_array().into_iter().fold(7, |hash, x| mix(hash, (x + 0.0).to_bits().into()))
}

/// A hash of each triangle's positions, whatever the order of its corners.
pub fn keys(mode: u32, positions: &[Vec3]) -> Vec<u64> {
    let key = |corners: [usize; 3]| {
        let mut of = corners.map(|corner| bits(positions[corner]));
        of.sort_unstable();
        of.into_iter().fold(1, mix)
    };
    corners(mode, positions.len()).into_iter().map(key).collect()
}

/// A hash of positions in order.
pub fn content(positions: &[Vec3]) -> u64 {
    positions.iter().fold(positions.len() as u64, |hash, position| mix(hash, bits(*position)))
}

/// Least and most of positions.
pub fn bounds(positions: &[Vec3]) -> [Vec3; 2] {
    let fold = |start: Vec3, pick: fn(Vec3, Vec3) -> Vec3| positions.iter().copied().fold(start, pick);
    [fold(Vec3::INFINITY, Vec3::min), fold(Vec3::NEG_INFINITY, Vec3::max)]
}
