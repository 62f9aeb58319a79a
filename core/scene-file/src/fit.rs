//! A view of something that comes without one.

use glam::{DVec3, dcamera};

use crate::scene::{Triangles, View};

/// Vertical field of view, radians.
const FIELD_OF_VIEW: f64 = 0.7;
/// From what is seen towards the camera.
const FROM: DVec3 = DVec3::new(0.5, 0.35, 1.0);

/// A view of all triangles, from a little above.
pub(crate) fn view_of_all(triangles: &Triangles, [width, height]: [u32; 2]) -> View {
    let corners = triangles.positions.iter().map(|position| position.as_dvec3());
    let least = corners.clone().reduce(DVec3::min).unwrap_or_default();
    let most = corners.reduce(DVec3::max).unwrap_or_default();
    let center = 0.5 * (least + most);
    // Of a point: anything that a camera can be away from.
    let radius = (0.5 * (most - least)).length().max(1e-6 * (1.0 + center.length()));
    let distance = radius / (0.5 * FIELD_OF_VIEW).sin();
    let proportion = f64::from(width) / f64::from(height);
    let (near, far) = (0.01 * radius, distance + 2.0 * radius);
    View {
        modelview: dcamera::rh::view::look_at_mat4(center + FROM.normalize() * distance, center, DVec3::Y),
        projection: dcamera::rh::proj::opengl::perspective(FIELD_OF_VIEW, proportion, near, far),
    }
}
