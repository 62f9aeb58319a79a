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
