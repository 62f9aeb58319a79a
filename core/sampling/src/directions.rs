//! Directions and points from random numbers: the twin of `sampling.glsl`, first part.

use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_PI_4;

/// Two vectors that make a right-handed orthonormal basis with a unit vector (Duff and others, Building an
/// Orthonormal Basis, Revisited, JCGT 2017).
pub fn tangents(normal: Vec3) -> [Vec3; 2] {
    let side = if normal.z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (side + normal.z);
    let b = normal.x * normal.y * a;
    [
        Vec3::new(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x),
        Vec3::new(b, side + normal.y * normal.y * a, -normal.y),
    ]
}

/// A vector of a plane in the basis that [`tangents`] makes.
pub(crate) fn across(normal: Vec3, plane: Vec2) -> Vec3 {
    let [tangent, bitangent] = tangents(normal);
    tangent * plane.x + bitangent * plane.y
}

/// A point of the unit disc, uniform (Shirley and Chiu's concentric map).
pub fn disc_point(random: Vec2) -> Vec2 {
    let square = 2.0 * random - 1.0;
    if square == Vec2::ZERO {
        return Vec2::ZERO;
    }
    let wide = square.x.abs() > square.y.abs();
    let radius = if wide { square.x } else { square.y };
    let angle = if wide {
        FRAC_PI_4 * (square.y / square.x)
    } else {
        2.0 * FRAC_PI_4 - FRAC_PI_4 * (square.x / square.y)
    };
    radius * Vec2::new(angle.cos(), angle.sin())
}

/// A direction about a unit vector, its density proportional to the cosine: cos / pi.
pub fn cosine_direction(normal: Vec3, random: Vec2) -> Vec3 {
    let disc = disc_point(random);
    across(normal, disc) + normal * (1.0 - disc.dot(disc)).max(0.0).sqrt()
}

/// Weights of the second and third corner of a point that is uniform over a triangle (Heitz, A Low-Distortion Map
/// Between Triangle and Square, 2019).
pub fn triangle_barycentrics(random: Vec2) -> Vec2 {
    if random.y > random.x {
        Vec2::new(0.5 * random.x, random.y - 0.5 * random.x)
    } else {
        Vec2::new(random.x - 0.5 * random.y, 0.5 * random.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Mean, draws};

    #[test]
    fn bases_are_orthonormal_and_right_handed() {
        let normals = draws(1, 100_000).map(|r| crate::caps::sphere_direction(Vec2::new(r.x, r.y)));
        for normal in normals.chain([Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_Y]) {
            let [tangent, bitangent] = tangents(normal);
            assert!((tangent.cross(bitangent) - normal).length() < 1e-6, "{normal}");
            assert!(tangent.dot(normal).abs() < 1e-6 && (tangent.length() - 1.0).abs() < 1e-6, "{normal}");
        }
    }

    #[test]
    fn cosine_directions_have_the_moments_of_a_cosine() {
        let mut means = [const { Mean::new() }; 7];
        for random in draws(2, 1_000_000) {
            let w = cosine_direction(Vec3::Z, Vec2::new(random.x, random.y));
            let powers = [w.z, w.z * w.z, w.z * w.z * w.z, w.x, w.y, w.x * w.x, w.x.powi(4)];
            for (mean, power) in means.iter_mut().zip(powers) {
                mean.add(power.into());
            }
        }
        for (mean, expected) in means.iter().zip([2.0 / 3.0, 0.5, 0.4, 0.0, 0.0, 0.25, 0.125]) {
            mean.assert_near(expected, 5.0);
        }
        let variance = means[0].variance();
        assert!((variance - 1.0 / 18.0).abs() < 3e-4, "{variance}");
    }

    #[test]
    fn points_are_uniform_over_discs_and_triangles() {
        // E[x] = 0, E[x^2] = 1/4 over the disc; E[u] = E[v] = 1/3, E[u^2] = 1/6, E[u v] = 1/12 over the triangle.
        let mut means = [const { Mean::new() }; 6];
        for random in draws(3, 1_000_000) {
            let random = Vec2::new(random.x, random.y);
            let (disc, weights) = (disc_point(random), triangle_barycentrics(random));
            assert!(weights.min_element() >= 0.0 && weights.x + weights.y <= 1.0, "{random}");
            let values = [disc.x, disc.x * disc.x, weights.x, weights.y, weights.x * weights.x];
            for (mean, value) in means.iter_mut().zip(values.into_iter().chain([weights.x * weights.y])) {
                mean.add(value.into());
            }
        }
        for (mean, expected) in means.iter().zip([0.0, 0.25, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 1.0 / 12.0]) {
            mean.assert_near(expected, 5.0);
        }
    }
}
