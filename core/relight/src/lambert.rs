//! Irradiance from a uniform polygon, in closed form: Lambert's formula (Photometria, 1760; Baum, Rushmeier and
//! Winget, Improving Radiosity Solutions Through the Use of Analytically Determined Form-Factors, 1989).

use glam::Vec3;

/// Irradiance at the origin of a surface facing `normal` (unit) from a triangle of radiance 1, seen from either side; what is
/// below the horizon is cut off.
pub(crate) fn irradiance(normal: Vec3, triangle: [Vec3; 3]) -> f32 {
    let mut corners = [Vec3::ZERO; 4];
    let mut count = 0;
    for i in 0..3 {
        let (from, to) = (triangle[i], triangle[(i + 1) % 3]);
        let (height, next) = (from.dot(normal), to.dot(normal));
        if height > 0.0 {
            corners[count] = from;
            count += 1;
        }
        if (height > 0.0) != (next > 0.0) && count < 4 {
            corners[count] = from + (to - from) * (height / (height - next));
            count += 1;
        }
    }
    let corners = &corners[..count];
    let edge = |i: usize| {
        let (a, b) = (corners[i].normalize_or_zero(), corners[(i + 1) % count].normalize_or_zero());
        let across = a.cross(b);
        let sine = across.length();
        // The angle by both sine and cosine: exact for small ones.
        if sine > 0.0 { across.dot(normal) / sine * sine.atan2(a.dot(b)) } else { 0.0 }
    };
    let sum: f32 = (0..count).map(edge).sum();
    (0.5 * sum).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_above_is_as_tables_have_it() {
        // Parallel unit squares, differential element below the centre, distance 0.5: four times the
        // corner formula of Howell's catalogue, B-4, with a = b = 1.
        let (a, h) = (0.5f32, 0.5f32);
        let (x, y) = (a / h, a / h);
        let corner = (x / (1.0 + x * x).sqrt() * (y / (1.0 + x * x).sqrt()).atan()
            + y / (1.0 + y * y).sqrt() * (x / (1.0 + y * y).sqrt()).atan())
            / std::f32::consts::TAU;
        let at = |x: f32, y: f32| Vec3::new(x, y, h);
        let quad = [at(-a, -a), at(a, -a), at(a, a), at(-a, a)];
        let got = irradiance(Vec3::Z, [quad[0], quad[1], quad[2]])
            + irradiance(Vec3::Z, [quad[0], quad[2], quad[3]]);
        assert!((got / std::f32::consts::PI - 4.0 * corner).abs() < 1e-5, "{got} {corner}");
    }

    #[test]
    fn an_endless_plane_gives_pi_and_half_of_it_half() {
        let far = 1e4;
        let triangle =
            [Vec3::new(-far, -far, 1.0), Vec3::new(far * 3.0, -far, 1.0), Vec3::new(-far, far * 3.0, 1.0)];
        assert!((irradiance(Vec3::Z, triangle) - std::f32::consts::PI).abs() < 1e-3);
        // Seen from a wall: half of the hemisphere.
        assert!((irradiance(Vec3::X, triangle) - std::f32::consts::FRAC_PI_2).abs() < 1e-3);
        assert!(irradiance(Vec3::NEG_Z, triangle) == 0.0);
    }
}
