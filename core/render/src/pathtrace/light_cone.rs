//! Cones that hold directions, for what shines to one side only.

use glam::Vec3;

/// All directions within an angle of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cone {
    /// Unit vector.
    pub(crate) axis: Vec3,
    /// Cosine of the angle; above 1 in an empty cone, -1 where all directions are.
    pub(crate) cos_spread: f32,
}

impl Cone {
    pub(crate) const EMPTY: Self = Self { axis: Vec3::Z, cos_spread: 2.0 };
    pub(crate) const EVERYWHERE: Self = Self { axis: Vec3::Z, cos_spread: -1.0 };

    /// One direction.
    pub(crate) fn along(axis: Vec3) -> Self {
        Self { axis, cos_spread: 1.0 }
    }

    fn spread(&self) -> f32 {
        self.cos_spread.clamp(-1.0, 1.0).acos()
    }

    /// A cone around both.
    pub(crate) fn union(self, other: Self) -> Self {
        if self.cos_spread > 1.0 || other.cos_spread > 1.0 {
            return if self.cos_spread > 1.0 { other } else { self };
        }
        let (wide, narrow) = if self.cos_spread <= other.cos_spread { (self, other) } else { (other, self) };
        let between = wide.axis.angle_between(narrow.axis);
        if !between.is_finite() || wide.cos_spread <= -1.0 {
            return Self::EVERYWHERE;
        }
        if between + narrow.spread() <= wide.spread() {
            return wide;
        }
        // A little wider than exact, so that rounding leaves nothing out.
        let spread = 0.5 * (wide.spread() + between + narrow.spread()) + 1e-4;
        let aside = wide.axis.cross(narrow.axis);
        if spread >= std::f32::consts::PI || aside.length_squared() < 1e-12 {
            return match between < 1e-3 {
                true => Self { axis: wide.axis, cos_spread: spread.min(std::f32::consts::PI).cos() },
                false => Self::EVERYWHERE,
            };
        }
        let turn = glam::Quat::from_axis_angle(aside.normalize(), spread - wide.spread());
        Self { axis: (turn * wide.axis).normalize(), cos_spread: spread.cos() }
    }

    /// How much of all directions what shines from here within 90 degrees reaches, weighed as Conty Estevez and Kulla have
    /// it (equation 1): 2 pi to 4 pi.
    pub(crate) fn measure(&self) -> f32 {
        use std::f32::consts::{FRAC_PI_2, PI, TAU};
        let spread = self.spread();
        let reach = (spread + FRAC_PI_2).min(PI);
        let (sin, cos) = (spread.sin(), spread.cos());
        TAU * (1.0 - cos)
            + FRAC_PI_2 * (2.0 * reach * sin - (spread - 2.0 * reach).cos() - 2.0 * spread * sin + cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_union_holds_both() {
        let a = Cone { axis: Vec3::X, cos_spread: 0.9 };
        let b = Cone { axis: Vec3::new(1.0, 1.0, 0.2).normalize(), cos_spread: 0.97 };
        let both = a.union(b);
        for cone in [a, b] {
            let farthest = both.axis.angle_between(cone.axis) + cone.spread();
            assert!(farthest <= both.spread() + 1e-5);
        }
        assert_eq!(Cone::EMPTY.union(a), a);
        assert_eq!(a.union(Cone::EVERYWHERE), Cone::EVERYWHERE);
        assert_eq!(Cone::along(Vec3::X).union(Cone::along(-Vec3::X)), Cone::EVERYWHERE);
    }

    #[test]
    fn one_direction_shines_on_a_half_space_and_all_on_everything() {
        let pi = std::f32::consts::PI;
        assert!((Cone::along(Vec3::Y).measure() - pi).abs() < 1e-4, "{}", Cone::along(Vec3::Y).measure());
        assert!((Cone::EVERYWHERE.measure() - 4.0 * pi).abs() < 1e-3);
    }
}
