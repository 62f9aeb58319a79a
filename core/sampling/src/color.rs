//! How bright colours are: the twin of part of `color.glsl`.

use glam::Vec3;

/// Luminance below this is black: devices may flush what comes of it.
pub const LEAST_LUMINANCE: f32 = 1e-20;

/// Luminance of linear light (Rec. 709).
pub fn luminance(linear: Vec3) -> f32 {
    linear.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}
