//! Where the corners of a mesh are taken relative to, so that rays lose no digits in it.
//!
//! Programs may have their world a million units from its origin, where f32 has 1/16 of a unit. Differences of such
//! coordinates are still exact: a mesh that is small for how far it is away is built about a place of its own, and that place
//! is subtracted from the camera's in f64.

use glam::Vec3;

/// A mesh is built about a place of its own if that is so many times as far from its origin as the mesh is large. Below that
/// little is gained, and meshes that meet at an edge are better off in the same coordinates.
const FAR: f32 = 64.0;

/// The box of corners in object space, those left out that are no numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reach {
    least: Vec3,
    greatest: Vec3,
}

impl Reach {
    pub(crate) const NOTHING: Self = Self { least: Vec3::INFINITY, greatest: Vec3::NEG_INFINITY };

    pub(crate) fn of(corners: &[[f32; 3]]) -> Self {
        corners
            .iter()
            .map(|corner| Vec3::from(*corner))
            .filter(|corner| corner.is_finite())
            .fold(Self::NOTHING, |sum, corner| sum.union(Self { least: corner, greatest: corner }))
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self { least: self.least.min(other.least), greatest: self.greatest.max(other.greatest) }
    }
}

/// What a mesh's corners are relative to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Anchor {
    /// In object space.
    pub(crate) place: Vec3,
    /// How far, along an axis, corners are from there at most; infinite where they are as the program has them.
    pub(crate) reach: f32,
}

impl Anchor {
    pub(crate) const ORIGIN: Self = Self { place: Vec3::ZERO, reach: f32::INFINITY };

    /// The place for corners that reach so far.
    pub(crate) fn of(reach: Reach) -> Self {
        let middle = 0.5 * reach.least + 0.5 * reach.greatest;
        let half = (0.5 * reach.greatest - 0.5 * reach.least).max_element();
        let is_far = middle.is_finite() && middle.abs().max_element() > FAR * half;
        if !is_far {
            return Self::ORIGIN;
        }
        // Differences of numbers within a factor of two are exact; where corners lie about 0 they stay as they are.
        let place = Vec3::select(middle.abs().cmpge(Vec3::splat(2.0 * half)), middle, Vec3::ZERO);
        Self { place, reach: 3.0 * half }
    }

    pub(crate) fn subtract_from(&self, corners: &mut [[f32; 3]]) {
        if self.place != Vec3::ZERO {
            for corner in corners {
                *corner = (Vec3::from(*corner) - self.place).to_array();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_far_for_its_size_is_exact_about_a_place_of_its_own() {
        let mut corners = [[1e6, -1e6, -3.3], [1e6 + 0.0625, -1e6 + 7.25, 4.1], [f32::NAN, 0.0, 0.0]];
        let before = corners;
        let anchor = Anchor::of(Reach::of(&corners));
        anchor.subtract_from(&mut corners);
        for (corner, before) in corners.iter().zip(before).take(2) {
            assert!(corner.iter().all(|at| at.abs() <= anchor.reach));
            assert_eq!(
                (Vec3::from(*corner).as_dvec3() + anchor.place.as_dvec3()).as_vec3().to_array(),
                before
            );
        }
        assert!(anchor.reach < 20.0 && corners[2][0].is_nan());
    }

    #[test]
    fn what_is_near_or_nowhere_stays() {
        for corners in
            [vec![[10.0, 0.0, 0.0], [11.0, 0.0, 0.0]], vec![], vec![[f32::INFINITY; 3]], vec![[0.0; 3]]]
        {
            assert_eq!(Anchor::of(Reach::of(&corners)), Anchor::ORIGIN);
        }
        assert_eq!(Anchor::of(Reach::of(&[[f32::MAX; 3], [f32::MIN; 3]])), Anchor::ORIGIN);
    }
}
