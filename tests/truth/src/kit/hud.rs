//! What lies over the picture.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, Vec2, Vec3};

use super::Mesh;
use crate::client::{Attributes, Client, WINDOW, thing};

/// One unit a pixel, from the lower left corner.
pub fn ortho() -> DMat4 {
    let (width, height) = (f64::from(WINDOW.0), f64::from(WINDOW.1));
    glam::dcamera::rh::proj::opengl::orthographic(0.0, width, 0.0, height, -1.0, 1.0)
}

/// The number of the HUD's object.
const OBJECT: u64 = 900_000;

/// Draws a bar for health, one for ammunition and a crosshair. Leaves the depth test on, textures off.
pub fn draw_hud(gl: &mut Client, frame: u32) {
    gl.projection(ortho());
    gl.modelview(DMat4::IDENTITY);
    gl.disable(GL_DEPTH_TEST);
    gl.disable(GL_TEXTURE_2D);
    gl.blend(Some((GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)));
    let rectangle = |x: f32, y: f32, width: f32, height: f32, color: [u8; 4]| {
        let mut mesh = Mesh::default();
        mesh.parallelogram(Vec3::new(x, y, 0.0), [Vec3::X * width, Vec3::Y * height], 1, Vec2::ONE);
        mesh.colored(color)
    };
    let health = 90.0 - (frame % 40) as f32;
    let centre = Vec2::new(WINDOW.0 as f32, WINDOW.1 as f32) / 2.0;
    let attributes = Attributes { color: true, ..Attributes::NONE };
    for mesh in [
        rectangle(8.0, 8.0, 104.0, 14.0, [0, 0, 0, 128]),
        rectangle(11.0, 11.0, health, 8.0, [200, 40, 30, 255]),
        rectangle(232.0, 8.0, 80.0, 14.0, [0, 0, 0, 128]),
        rectangle(235.0, 11.0, 60.0, 8.0, [210, 180, 60, 255]),
        rectangle(centre.x - 5.0, centre.y - 0.5, 10.0, 1.0, [255, 255, 255, 200]),
        rectangle(centre.x - 0.5, centre.y - 5.0, 1.0, 10.0, [255, 255, 255, 200]),
    ] {
        gl.draw(thing(Class::Interface, OBJECT), &mesh, attributes);
    }
    gl.blend(None);
    gl.enable(GL_DEPTH_TEST);
    gl.color([1.0; 4]);
}
