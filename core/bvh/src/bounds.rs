//! Axis-aligned boxes in f32, exact: a box built from points never loses one to rounding.

use glam::{DMat3, DVec3, Vec3};

/// An axis-aligned box; empty when a minimum exceeds its maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least corner.
    pub min: Vec3,
    /// Greatest corner.
    pub max: Vec3,
}

impl Aabb {
    /// The box without points; the identity of [`Aabb::union`].
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The least box around `points`.
    pub fn around(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &point| Self {
            min: bounds.min.min(point),
            max: bounds.max.max(point),
        })
    }

    /// The least box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether no point is inside (NaN corners count as empty).
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Half the surface area, the measure of the surface-area heuristic; 0 when empty.
    pub fn half_area(&self) -> f32 {
        let extent = (self.max - self.min).max(Vec3::ZERO);
        extent.x * extent.y + extent.y * extent.z + extent.z * extent.x
    }

    /// Twice the centre: cheaper than the centre and as good for sorting.
    pub(crate) fn centroid_doubled(&self) -> Vec3 {
        self.min + self.max
    }

    /// The box of this box after the affine map `rows` (3x4, row-major), enlarged by about 2^-20 of
    /// its largest coordinate so that it holds whatever rays transformed in f32 can hit (Arvo,
    /// Transforming Axis-Aligned Bounding Boxes, Graphics Gems, 1990).
    #[must_use]
    pub fn transformed(&self, rows: &[[f32; 4]; 3]) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        let (linear, offset) = affine_parts(rows);
        let centre = (self.min.as_dvec3() + self.max.as_dvec3()) * 0.5;
        let half = (self.max.as_dvec3() - self.min.as_dvec3()) * 0.5;
        let absolute = DMat3::from_cols(linear.x_axis.abs(), linear.y_axis.abs(), linear.z_axis.abs());
        let (centre_out, half_out) = (linear * centre + offset, absolute * half);
        let magnitude = absolute * (centre.abs() + half) + offset.abs();
        let half_padded = half_out + magnitude / f64::from(1 << 20);
        Self { min: (centre_out - half_padded).as_vec3(), max: (centre_out + half_padded).as_vec3() }
    }
}

/// Linear part and translation of a row-major 3x4 matrix, in f64.
pub(crate) fn affine_parts(rows: &[[f32; 4]; 3]) -> (DMat3, DVec3) {
    let row = |i: usize| Vec3::new(rows[i][0], rows[i][1], rows[i][2]).as_dvec3();
    let linear = DMat3::from_cols(row(0), row(1), row(2)).transpose();
    let offset = Vec3::new(rows[0][3], rows[1][3], rows[2][3]).as_dvec3();
    (linear, offset)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transformed_box_holds_the_transformed_corners() {
        let bounds = Aabb::around(&[Vec3::new(-1.0, 2.0, 3.0), Vec3::new(4.0, 5.0, 6.0)]);
        let rows = [[0.0, -2.0, 0.0, 10.0], [3.0, 0.0, 0.5, -20.0], [0.0, 0.0, 1.0, 1e4]];
        let out = bounds.transformed(&rows);
        assert!((out.min - Vec3::new(0.0, -21.5, 10_003.0)).abs().max_element() < 0.05);
        assert!((out.max - Vec3::new(6.0, -5.0, 10_006.0)).abs().max_element() < 0.05);
        assert!(out.min.cmplt(Vec3::new(0.0, -21.5, 10_003.0)).all());
    }

    #[test]
    fn empty_stays_empty() {
        let rows = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        assert!(Aabb::EMPTY.transformed(&rows).is_empty());
        assert_eq!(Aabb::EMPTY.half_area(), 0.0);
    }
}
