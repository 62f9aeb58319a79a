//! Caps: the twin of `sampling.glsl`, second part.
//!
//! A cap of the unit sphere is all directions within an angle of its axis. It is named by the squared sine of that
//! angle, which is at most a right one, since that is what a sphere light (squared radius over squared distance) and
//! a sun have at hand, and since 1 - cos of a small angle has no digits left.

use crate::directions::{across, disc_point};
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// 1 - cos of the angle whose squared sine is given: sin^2 / (1 + cos), which never cancels.
pub fn cap_one_minus_cos(sin2: f32) -> f32 {
    let bounded = sin2.clamp(0.0, 1.0);
    bounded / (1.0 + (1.0 - bounded).sqrt())
}

/// In steradians.
pub fn cap_solid_angle(sin2: f32) -> f32 {
    TAU * cap_one_minus_cos(sin2)
}

/// A direction about +z, uniform in solid angle where 1 - cos of its angle to z is at most `one_minus_cos` (2: all
/// directions): heights over a cap are uniform, as squared radii over a disc are (Archimedes).
pub fn cap_direction_z(one_minus_cos: f32, random: Vec2) -> Vec3 {
    let disc = disc_point(random);
    let height = disc.dot(disc) * one_minus_cos;
    (disc * (one_minus_cos * (2.0 - height).max(0.0)).sqrt()).extend(1.0 - height)
}

/// A direction about a unit vector, uniform within the angle whose squared sine is `sin2_max`; its density is 1 over
/// [`cap_solid_angle`].
pub fn cap_direction(axis: Vec3, sin2_max: f32, random: Vec2) -> Vec3 {
    let local = cap_direction_z(cap_one_minus_cos(sin2_max), random);
    across(axis, local.truncate()) + axis * local.z
}

/// Any direction, with density 1 / (4 pi).
pub fn sphere_direction(random: Vec2) -> Vec3 {
    cap_direction_z(2.0, random)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Mean, draws};
    use std::f64::consts::PI;

    /// 2 pi (1 - cos), by the half angle's sine.
    fn solid_angle(angle: f64) -> f64 {
        4.0 * PI * (angle / 2.0).sin().powi(2)
    }

    #[test]
    fn solid_angles_of_small_caps_do_not_cancel() {
        for angle in [1e-8, 1e-5, 1e-4, 0.004_675, 0.1, 1.0, 1.5, PI / 2.0] {
            let sin2 = angle.sin().powi(2) as f32;
            // From the sine as f32 has it: near a right angle, that is most of the error.
            let exact = solid_angle(f64::from(sin2).sqrt().min(1.0).asin());
            let ratio = f64::from(cap_solid_angle(sin2)) / exact;
            assert!((ratio - 1.0).abs() < 1e-6, "{angle}: {ratio}");
        }
        let trap = std::f32::consts::TAU * (1.0 - 0.004_675f32.cos());
        assert!((f64::from(trap) / solid_angle(0.004_675) - 1.0).abs() > 1e-3, "the trap is none: {trap}");
    }

    #[test]
    fn no_sine_gives_more_than_a_hemisphere() {
        assert_eq!(cap_one_minus_cos(4.0), 1.0);
        assert_eq!(cap_one_minus_cos(f32::INFINITY), 1.0);
        assert_eq!(cap_one_minus_cos(-1.0), 0.0);
    }

    #[test]
    fn directions_are_uniform_within_the_cone() {
        // Heights 1 - cos are uniform: half the greatest on average, and a third of its square.
        for angle in [1e-5f32, 1e-3, 0.3, 1.5] {
            let sin2 = angle.sin() * angle.sin();
            let most = f64::from(cap_one_minus_cos(sin2));
            let mut means = [const { Mean::new() }; 4];
            for random in draws(4, 200_000) {
                let w = cap_direction(Vec3::Z, sin2, Vec2::new(random.x, random.y)).as_dvec3();
                // Of the vector's sine, since cosines of 1e-5 are 1.
                let height =
                    if angle < 0.1 { w.truncate().length_squared() / (1.0 + w.z) } else { 1.0 - w.z };
                assert!(height <= most * 1.000_001 && (w.length() - 1.0).abs() < 1e-6);
                let share = height / most;
                means[0].add(share);
                means[1].add(share * share);
                means[2].add(w.x / f64::from(angle));
                means[3].add(w.x * w.y / f64::from(sin2));
            }
            for (mean, expected) in means.iter().zip([0.5, 1.0 / 3.0, 0.0, 0.0]) {
                mean.assert_near(expected, 5.0);
            }
        }
    }

    #[test]
    fn a_turned_cone_is_about_its_axis() {
        let axis = Vec3::new(-0.48, 0.6, -0.64);
        let mut mean = Vec3::ZERO;
        for random in draws(5, 100_000) {
            let w = cap_direction(axis, 1e-4, Vec2::new(random.x, random.y));
            assert!(axis.cross(w).length() < 1.0001e-2 && axis.dot(w) > 0.0);
            mean += w / 100_000.0;
        }
        assert!((mean / mean.length() - axis).length() < 1e-4, "{mean}");
    }

    #[test]
    fn the_whole_sphere_is_even() {
        let mut means = [const { Mean::new() }; 5];
        for random in draws(6, 500_000) {
            let w = sphere_direction(Vec2::new(random.x, random.y));
            for (mean, value) in means.iter_mut().zip([w.x, w.y, w.z, w.x * w.x, w.z * w.z]) {
                mean.add(value.into());
            }
        }
        for (mean, expected) in means.iter().zip([0.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0]) {
            mean.assert_near(expected, 5.0);
        }
    }
}
