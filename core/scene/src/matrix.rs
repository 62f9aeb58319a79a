//! Matrices taken apart, in f64: what is perspective, what is rigid, what is flattened.

use glam::{DMat3, DMat4, DVec3, DVec4};

/// An OpenGL matrix (column-major f32) in f64.
pub fn from_columns(columns: &[[f32; 4]; 4]) -> DMat4 {
    DMat4::from_cols_array_2d(&columns.map(|column| column.map(f64::from)))
}

/// The bits of a matrix, to compare and hash it exactly.
pub fn bits(columns: &[[f32; 4]; 4]) -> [u32; 16] {
    // Adding zero makes -0 and +0 the same.
    bytemuck::cast(columns.map(|column| column.map(|x| x + 0.0)))
}

/// Whether all entries are numbers with which one can reckon in f32 as well.
pub fn is_sound(matrix: DMat4) -> bool {
    // Written so that what is not a number fails.
    matrix.to_cols_array().iter().all(|entry| entry.abs() < 1e15)
}

/// A perspective projection without what else the program put into its PROJECTION matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perspective {
    /// The projection alone: its last row is (0, 0, ±k, 0).
    pub projection: DMat4,
    /// The rigid transform (rotation, translation) that came before it; usually the identity.
    pub view: DMat4,
}

impl Perspective {
    /// Unit vector in eye space that points to the top of the screen.
    pub fn upward(&self) -> DVec3 {
        DVec3::Y * self.projection.y_axis.y.signum()
    }
}

/// Takes a projection matrix apart; `None` when it is orthographic or singular.
///
/// The rows x, y and w of `projection` are K [R | t] with upper triangular K (Hartley and Zisserman, *Multiple
/// View Geometry*, section 6.2.4), so R and t are the view that a program multiplied into its projection.
pub fn factor_perspective(projection: DMat4) -> Option<Perspective> {
    let w = projection.row(3);
    let scale = projection.row(0).truncate().length() + projection.row(1).truncate().length();
    let depth_weight = w.truncate().length();
    let is_orthographic = depth_weight <= 1e-9 * scale;
    if is_orthographic || !is_sound(projection) || projection.determinant() == 0.0 {
        return None;
    }
    let beside_axis = w.x.abs() + w.y.abs() + w.w.abs();
    if beside_axis <= 1e-6 * depth_weight {
        return Some(Perspective { projection, view: DMat4::IDENTITY });
    }
    factor_view(projection)
}

fn factor_view(projection: DMat4) -> Option<Perspective> {
    let [row_x, row_y, row_w] = [0, 1, 3].map(|i| projection.row(i));
    // Eye space looks along -z, as OpenGL's own projections have it.
    let axis_z = -row_w.truncate().normalize();
    let axis_y = (row_y.truncate() - axis_z * row_y.truncate().dot(axis_z)).try_normalize()?;
    let axis_x = axis_y.cross(axis_z);
    let rotation = DMat3::from_cols(axis_x, axis_y, axis_z).transpose();
    // The centre of projection is where x, y and w vanish.
    let rows = DMat3::from_cols(row_x.truncate(), row_y.truncate(), row_w.truncate()).transpose();
    if rows.determinant() == 0.0 {
        return None;
    }
    let centre = rows.inverse() * -DVec3::new(row_x.w, row_y.w, row_w.w);
    let view = DMat4::from_mat3(rotation) * DMat4::from_translation(-centre);
    let pure = projection * rigid_inverse(view);
    (is_sound(pure) && is_sound(view)).then_some(Perspective { projection: pure, view })
}

/// A transform as rotation (or reflection) and translation with one scale before them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    /// Rotation or reflection, and translation.
    pub rigid: DMat4,
    /// Factor of lengths, positive.
    pub scale: f64,
}

/// Reads a matrix as a similarity; `None` when it shears, scales unevenly or is projective.
pub fn similarity(matrix: DMat4) -> Option<Similarity> {
    let bottom = matrix.row(3);
    let axes = [0, 1, 2].map(|i| matrix.col(i).truncate());
    let scale = axes.iter().map(|axis| axis.length()).sum::<f64>() / 3.0;
    let even = axes.iter().all(|axis| (axis.length() - scale).abs() < 2e-3 * scale);
    let square =
        [(0, 1), (0, 2), (1, 2)].iter().all(|&(a, b)| axes[a].dot(axes[b]).abs() < 2e-3 * scale * scale);
    let affine = bottom.abs_diff_eq(DVec4::W, 1e-9);
    (matrix.is_finite() && scale > 0.0 && even && square && affine)
        .then(|| Similarity { rigid: orthonormal(matrix), scale: snapped(scale) })
}

/// A scale that is 1 but for rounding is 1.
fn snapped(scale: f64) -> f64 {
    if (scale - 1.0).abs() < 1e-4 { 1.0 } else { scale }
}

/// The rotation (or reflection) nearest to a matrix's axes taken in order z, y, x, with its translation.
pub fn orthonormal(matrix: DMat4) -> DMat4 {
    let [x, y, z] = [0, 1, 2].map(|i| matrix.col(i).truncate());
    let axis_z = z.normalize_or(DVec3::Z);
    let axis_y = (y - axis_z * y.dot(axis_z)).normalize_or(axis_z.any_orthonormal_vector());
    let right = axis_y.cross(axis_z);
    let axis_x = if right.dot(x) < 0.0 { -right } else { right };
    let translation = matrix.col(3).truncate();
    DMat4::from_cols(axis_x.extend(0.0), axis_y.extend(0.0), axis_z.extend(0.0), translation.extend(1.0))
}

/// Inverse of a rotation (or reflection) with translation, exact but for rounding.
pub fn rigid_inverse(rigid: DMat4) -> DMat4 {
    let rotation = DMat3::from_mat4(rigid).transpose();
    DMat4::from_mat3(rotation) * DMat4::from_translation(-rigid.col(3).truncate())
}

/// Whether a matrix flattens what it transforms (a planar shadow's projection).
pub fn is_flattening(matrix: DMat4) -> bool {
    if matrix.row(3).abs_diff_eq(DVec4::W, 1e-9) {
        let linear = DMat3::from_mat4(matrix);
        let lengths: f64 = [0, 1, 2].iter().map(|&i| linear.col(i).length()).product();
        return linear.determinant().abs() <= 1e-5 * lengths;
    }
    let lengths: f64 = [0, 1, 2, 3].iter().map(|&i| matrix.col(i).length()).product();
    matrix.determinant().abs() <= 1e-6 * lengths
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frustum() -> DMat4 {
        glam::dcamera::rh::proj::opengl::perspective(1.0, 1.5, 0.5, 100.0)
    }

    #[test]
    fn a_plain_projection_has_no_view() {
        let parts = factor_perspective(frustum()).unwrap();
        assert_eq!(parts.view, DMat4::IDENTITY);
        assert!(
            factor_perspective(glam::dcamera::rh::proj::opengl::orthographic(0., 1., 0., 1., -1., 1.))
                .is_none()
        );
    }

    #[test]
    fn a_left_handed_projection_is_perspective() {
        let parts =
            factor_perspective(glam::dcamera::lh::proj::opengl::perspective(1.0, 1.5, 0.5, 100.0)).unwrap();
        assert_eq!(parts.view, DMat4::IDENTITY);
    }

    #[test]
    fn a_view_inside_the_projection_is_factored_out() {
        let view = DMat4::from_rotation_y(0.4)
            * DMat4::from_rotation_x(-0.2)
            * DMat4::from_translation(DVec3::new(3.0, -2.0, 7.0));
        let parts = factor_perspective(frustum() * view).unwrap();
        assert!(parts.view.abs_diff_eq(view, 1e-9), "{}", parts.view);
        assert!(parts.projection.abs_diff_eq(frustum(), 1e-9));
    }

    #[test]
    fn similarities_are_told_from_shears() {
        let rigid = DMat4::from_rotation_z(0.3) * DMat4::from_translation(DVec3::ONE);
        let found = similarity(rigid * DMat4::from_scale(DVec3::splat(2.0))).unwrap();
        assert!(found.rigid.abs_diff_eq(rigid, 1e-9));
        assert!((found.scale - 2.0).abs() < 1e-9);
        assert!(similarity(rigid * DMat4::from_scale(DVec3::new(1.0, 2.0, 1.0))).is_none());
        assert!(rigid_inverse(rigid).abs_diff_eq(rigid.inverse(), 1e-12));
    }

    #[test]
    fn reflections_are_rigid_too() {
        let mirror = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
        let found = similarity(mirror).unwrap();
        assert!(found.rigid.abs_diff_eq(mirror, 1e-12));
    }

    #[test]
    fn planar_shadow_matrices_flatten() {
        let light = DVec4::new(2.0, 8.0, 3.0, 1.0);
        let plane = DVec4::new(0.0, 1.0, 0.0, 0.5);
        let outer = DMat4::from_cols(light * plane.x, light * plane.y, light * plane.z, light * plane.w);
        let shadow = DMat4::from_diagonal(DVec4::splat(plane.dot(light))) - outer;
        let view = DMat4::from_rotation_x(0.5) * DMat4::from_translation(DVec3::splat(4.0));
        assert!(is_flattening(view * shadow));
        assert!(is_flattening(view * DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0))));
        assert!(!is_flattening(view * DMat4::from_translation(DVec3::splat(1e4))));
    }
}
