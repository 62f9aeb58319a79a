//! Cameras and the ways that they go.

use glam::{DMat4, DVec3, DVec4};

use crate::client::WINDOW;
use crate::truth::TrueCamera;

/// A projection with that vertical field of view (degrees), for a viewport with the window's proportions.
pub fn perspective(degrees: f64, near: f64, far: f64) -> DMat4 {
    let aspect = f64::from(WINDOW.0) / f64::from(WINDOW.1);
    glam::dcamera::rh::proj::opengl::perspective(degrees.to_radians(), aspect, near, far)
}

/// A view from one point to another.
pub fn look_at(eye: DVec3, target: DVec3) -> DMat4 {
    glam::dcamera::rh::view::look_at_mat4(eye, target, DVec3::Y)
}

/// A walk about a centre: an ellipse whose pace varies, with a look that turns and a head that bobs. `t` is the share
/// of the whole round.
pub fn walk(centre: DVec3, radius: DVec3, t: f64) -> DMat4 {
    let angle = std::f64::consts::TAU * t + 0.2 * (7.0 * t).sin();
    let eye = centre + radius * DVec3::new(angle.cos(), 0.25 * (9.0 * angle).sin(), angle.sin());
    let turn = angle + 2.0 + 0.4 * (11.0 * t).sin();
    let ahead = DVec3::new(turn.cos(), -0.12 + 0.05 * (13.0 * t).sin(), turn.sin());
    look_at(eye, eye + ahead)
}

/// Whether a sphere may be seen: what programs cull by. `centre` is in world space.
pub fn in_sight(camera: &TrueCamera, centre: DVec3, radius: f64) -> bool {
    let clip = camera.projection * camera.view;
    let rows = [0, 1, 2, 3].map(|i| clip.row(i));
    let planes = [rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]];
    let inside = |plane: DVec4| plane.dot(centre.extend(1.0)) >= -radius * plane.truncate().length();
    planes.into_iter().all(inside)
}
