//! Colours: from what the program gave (sRGB, as its picture is shown) to linear light.

use glam::Vec3;

/// Linear RGB of an sRGB colour (IEC 61966-2-1); above one the curve goes on.
pub fn linear_from_srgb(color: Vec3) -> Vec3 {
    let curve = |c: f32| match c {
        c if c <= 0.04045 => c.max(0.0) / 12.92,
        c => ((c + 0.055) / 1.055).powf(2.4),
    };
    Vec3::new(curve(color.x), curve(color.y), curve(color.z))
}

/// The sRGB colour that shows linear RGB, the inverse of [`linear_from_srgb`]; negative light is black.
pub fn srgb_from_linear(light: Vec3) -> Vec3 {
    let curve = |c: f32| match c {
        c if c <= 0.003_130_8 => c.max(0.0) * 12.92,
        c => 1.055 * c.powf(1.0 / 2.4) - 0.055,
    };
    Vec3::new(curve(light.x), curve(light.y), curve(light.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        for value in [0.0, 0.002, 0.003_130_8, 0.02, 0.5, 1.0, 3.0] {
            let back = linear_from_srgb(srgb_from_linear(Vec3::splat(value)));
            assert!((back.x - value).abs() < 1e-5 * value.max(0.1), "{value}");
        }
    }
}
