//! Numbers that look random and repeat: hashes of what they are for.

use glam::{Vec2, Vec3};

/// A well-mixed hash of two numbers (the finaliser of SplitMix64, Steele, Lea and Flood 2014).
pub(crate) fn hash(a: u64, b: u64) -> u64 {
    let mut z = a.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(b).wrapping_add(0x632b_e59b_d9b4_e019);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// In [0, 1).
pub(crate) fn unit(hash: u64) -> f32 {
    (hash >> 40) as f32 / (1u32 << 24) as f32
}

/// Point `index` of the R2 sequence (Roberts 2018), turned by a hash: evenly spread over the unit square.
pub(crate) fn spread(index: u32, turn: u64) -> Vec2 {
    let along = |step: f64, start: u64| ((f64::from(index) * step + f64::from(unit(start))).fract()) as f32;
    Vec2::new(along(0.754_877_666_246_692_8, turn), along(0.569_840_290_998_053_3, hash(turn, 1)))
}

/// `count` directions spread evenly over the sphere (the spherical Fibonacci lattice), number `index`.
pub(crate) fn direction(index: usize, count: usize) -> Vec3 {
    let z = 1.0 - (2.0 * index as f64 + 1.0) / count as f64;
    let angle = index as f64 * std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let across = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new((across * angle.cos()) as f32, (across * angle.sin()) as f32, z as f32)
}

/// A direction about `normal` with density cosine / pi.
pub(crate) fn cosine_direction(normal: Vec3, square: Vec2) -> Vec3 {
    let angle = square.x * std::f32::consts::TAU;
    let across = square.y.sqrt();
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    let flat = tangent * (across * angle.cos()) + bitangent * (across * angle.sin());
    (flat + normal * (1.0 - square.y).max(0.0).sqrt()).normalize_or(normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_even() {
        let sum: Vec3 = (0..500).map(|i| direction(i, 500)).sum();
        assert!(sum.length() < 1.0, "{sum}");
    }

    #[test]
    fn cosine_directions_have_the_mean_of_a_cosine() {
        let normal = Vec3::new(0.6, 0.0, 0.8);
        let mean =
            (0..4096).map(|i| cosine_direction(normal, spread(i, 7)).dot(normal)).sum::<f32>() / 4096.0;
        assert!((mean - 2.0 / 3.0).abs() < 1e-3, "{mean}");
    }
}
