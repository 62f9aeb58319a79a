//! Where pixels are, seen from the camera, and where they look.

use afterglow_scene::Camera;
use glam::{DVec3, DVec4, Vec3};

/// Positions of pixels at depth 1 or, where they look side by side, on the near plane; in the world relative to the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PixelRays {
    /// A position's product with this is its depth: clip space's w. Where pixels look side by side, the unit vector along
    /// which they do.
    pub(crate) forward: [f32; 3],
    /// The projection is orthographic: all pixels look along `forward`.
    pub(crate) is_parallel: bool,
    /// The upper left pixel's centre.
    pub(crate) origin: [f32; 3],
    /// From a pixel to the next one to the right.
    pub(crate) right: [f32; 3],
    /// From a pixel to the next one below.
    pub(crate) down: [f32; 3],
}

impl PixelRays {
    /// Of a window of this size that the camera's picture fills.
    pub(crate) fn new(camera: &Camera, [width, height]: [u32; 2]) -> Self {
        let projection = camera.projection.as_dmat4();
        let world_from_eye = camera.view.inverse();
        let depth_row = projection.row(3).truncate();
        let eye_from_clip = projection.inverse();
        let is_parallel = depth_row == DVec3::ZERO;
        let place = |x: f64, y: f64, z: f64| {
            let point = eye_from_clip * DVec4::new(x, y, z, 1.0);
            point.truncate() / point.w
        };
        let at = |x: f64, y: f64| {
            let eye = if is_parallel { place(x, y, -1.0) } else { place(x, y, 0.0) };
            let along = if is_parallel { 1.0 } else { depth_row.dot(eye) };
            world_from_eye.transform_vector3(eye / along)
        };
        let (step_x, step_y) = (2.0 / f64::from(width), -2.0 / f64::from(height));
        let origin = at(-1.0 + step_x / 2.0, 1.0 + step_y / 2.0);
        let right = at(-1.0 + step_x * 1.5, 1.0 + step_y / 2.0) - origin;
        let down = at(-1.0 + step_x / 2.0, 1.0 + step_y * 1.5) - origin;
        let forward = match is_parallel {
            true => {
                world_from_eye.transform_vector3(place(0.0, 0.0, 1.0) - place(0.0, 0.0, -1.0)).normalize()
            }
            false => (camera.view.transpose() * depth_row.extend(0.0)).truncate(),
        };
        Self {
            forward: sound(forward),
            is_parallel,
            origin: sound(origin),
            right: sound(right),
            down: sound(down),
        }
    }

    /// Whether different pixels have different rays: a projection that is none leaves nothing of them.
    pub(crate) fn are_apart(&self) -> bool {
        let ray = if self.is_parallel { self.forward } else { self.origin };
        let [ray, right, down] = [ray, self.right, self.down].map(|ray| Vec3::from(ray).as_dvec3());
        ray.dot(right.cross(down)) != 0.0
    }
}

/// In f32; zero if a projection is none.
fn sound(vector: DVec3) -> [f32; 3] {
    if vector.is_finite() { vector.as_vec3().to_array() } else { Vec3::ZERO.to_array() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3Swizzles, Vec4Swizzles};

    #[test]
    fn pixels_are_where_they_are_projected_from() {
        let eye = DVec3::new(3.0, -2.0, 5.0);
        let camera = Camera {
            view: glam::dcamera::rh::view::look_at_mat4(eye, DVec3::new(0.0, 1.0, 0.0), DVec3::Y),
            projection: glam::camera::rh::proj::opengl::perspective(1.0, 1.5, 0.1, 100.0),
        };
        let rays = PixelRays::new(&camera, [60, 40]);
        let [origin, right, down] = [rays.origin, rays.right, rays.down].map(Vec3::from);
        let point = (origin + right * 12.0 + down * 30.0) * 7.0;
        let clip = camera.projection * camera.view.as_mat4() * (point + eye.as_vec3()).extend(1.0);
        let expected = (Vec3::new(12.5, 30.5, 0.0) / Vec3::new(60.0, -40.0, 1.0) * 2.0).xy();
        assert!((clip.xy() / clip.w - expected - glam::Vec2::new(-1.0, 1.0)).length() < 1e-4);
        assert!((clip.w - 7.0).abs() < 1e-4);
        assert!((Vec3::from(rays.forward).dot(point) - 7.0).abs() < 1e-4);
    }

    #[test]
    fn pixels_of_an_orthographic_projection_look_side_by_side() {
        let eye = DVec3::new(3.0, -2.0, 5.0);
        let camera = Camera {
            view: glam::dcamera::rh::view::look_at_mat4(eye, DVec3::new(0.0, 1.0, 0.0), DVec3::Y),
            projection: glam::camera::rh::proj::opengl::orthographic(-3.0, 3.0, -2.0, 2.0, -4.0, 10.0),
        };
        let rays = PixelRays::new(&camera, [60, 40]);
        assert!(rays.is_parallel && rays.are_apart());
        let [origin, right, down, forward] =
            [rays.origin, rays.right, rays.down, rays.forward].map(Vec3::from);
        assert!((right.length() - 0.1).abs() < 1e-5 && (forward.length() - 1.0).abs() < 1e-5);
        let point = origin + right * 12.0 + down * 30.0 + forward * 7.0;
        let clip = camera.projection * camera.view.as_mat4() * (point + eye.as_vec3()).extend(1.0);
        let expected = (Vec3::new(12.5, 30.5, 0.0) / Vec3::new(60.0, -40.0, 1.0) * 2.0).xy();
        assert!((clip.xy() - expected - glam::Vec2::new(-1.0, 1.0)).length() < 1e-4);
        // Half of the way from the near to the far plane.
        assert!(clip.z.abs() < 1e-4);
    }
}
