//! Indirect light in two bands of spherical harmonics: the twin of `spherical_harmonics.glsl`.

use glam::Vec3;

use crate::color::luminance;

/// From the mean of luminance times [`aside_of`] to the second band: of radiance a + b . w over a hemisphere,
/// cosine-distributed directions w have mean radiance times w of b / 4 aside of the normal, and irradiance over pi grows
/// by 2/3 b along the normal.
pub const TOWARDS_SCALE: f32 = 8.0 / 3.0;

/// What a direction in which light was found adds to the second band: its part aside of the normal.
pub fn aside_of(direction: Vec3, normal: Vec3) -> Vec3 {
    direction - normal * normal.dot(direction)
}

/// Irradiance over pi where a surface faces along a unit vector: `color` is the first band, linear RGB, `towards` how its
/// luminance grows along each axis; limited to a quarter and four times the first.
pub fn irradiance_facing(color: Vec3, towards: Vec3, normal: Vec3) -> Vec3 {
    let brightness = luminance(color);
    match brightness > 0.0 {
        true => color * (1.0 + towards.dot(normal) / brightness).clamp(0.25, 4.0),
        false => color,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::directions::cosine_direction;
    use glam::Vec2;

    /// Both bands of radiance 1 + b . w, gathered along a normal by a grid of cosine-distributed directions.
    fn gathered(b: Vec3, normal: Vec3) -> (Vec3, Vec3) {
        const SIDE: u32 = 256;
        let (mut sum, mut towards) = (0.0, Vec3::ZERO);
        for i in 0..SIDE * SIDE {
            let random = (Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) + 0.5) / SIDE as f32;
            let w = cosine_direction(normal, random);
            let radiance = 1.0 + b.dot(w);
            sum += radiance;
            towards += radiance * aside_of(w, normal);
        }
        let share = 1.0 / (SIDE * SIDE) as f32;
        (Vec3::splat(sum * share), TOWARDS_SCALE * share * towards)
    }

    #[test]
    fn light_is_exact_along_the_normal_and_grows_aside_as_its_irradiance_does() {
        let normal = Vec3::new(0.36, 0.48, 0.8);
        let b = Vec3::new(0.3, -0.2, 0.25);
        let (color, towards) = gathered(b, normal);
        // Irradiance over pi of a + b . w is a + 2/3 b . n.
        let exact = |n: Vec3| 1.0 + 2.0 / 3.0 * b.dot(n);
        assert!((irradiance_facing(color, towards, normal).x - exact(normal)).abs() < 1e-4);
        assert!((towards - 2.0 / 3.0 * aside_of(b, normal)).abs().max_element() < 1e-3, "{towards}");
        // A little aside: what the tilt adds along the normal is of the second order.
        let tilted = (normal + 0.02 * normal.cross(Vec3::X).normalize()).normalize();
        let found = irradiance_facing(color, towards, tilted).x;
        assert!((found - exact(tilted)).abs() < 4e-4, "{found} {}", exact(tilted));
    }

    #[test]
    fn light_is_never_negative_and_nothing_stays_nothing() {
        let loud = Vec3::new(-90.0, 0.0, 0.0);
        assert_eq!(irradiance_facing(Vec3::ONE, loud, Vec3::X), Vec3::splat(0.25));
        assert_eq!(irradiance_facing(Vec3::ONE, loud, Vec3::NEG_X), Vec3::splat(4.0));
        assert_eq!(irradiance_facing(Vec3::ZERO, loud, Vec3::X), Vec3::ZERO);
    }
}
