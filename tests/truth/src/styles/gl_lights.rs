//! A room lit by glLight: three coloured lamps that move, with falloff, and balls that pass below them.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec2, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Mesh, Picture, draw_hud, look_at, perspective, sphere};
use crate::truth::{TrueCamera, TrueLightShape};

/// A room with fine surfaces, since light is computed at vertices.
pub struct GlLights {
    room: [List; 6],
    ball: List,
    stone: Texture,
    glaze: Texture,
}

/// The room's corner; the opposite one is its negative, but for the floor at 0.
const CORNER: Vec3 = Vec3::new(-7.0, 0.0, -7.0);
const SIZE: Vec3 = Vec3::new(14.0, 5.0, 14.0);
const COLORS: [Vec3; 3] = [Vec3::new(1.0, 0.75, 0.5), Vec3::new(0.3, 0.5, 1.0), Vec3::new(0.4, 1.0, 0.4)];

impl GlLights {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> GlLights {
        gl.set_extent(f64::from(SIZE.length()));
        let [x, y, z] = [Vec3::X * SIZE.x, Vec3::Y * SIZE.y, Vec3::Z * SIZE.z];
        let faces = [
            (CORNER, [z, x]),
            (CORNER + y, [x, z]),
            (CORNER, [x, y]),
            (CORNER + x, [z, y]),
            (CORNER + x + z, [-x, y]),
            (CORNER + z, [-z, y]),
        ];
        let room = faces.map(|(corner, along)| {
            let mut mesh = Mesh::default();
            mesh.parallelogram(corner, along, 12, Vec2::splat(4.0));
            gl.list(&mesh, Attributes::LIT)
        });
        GlLights {
            room,
            ball: gl.list(&sphere(0.5, 10, 14), Attributes::LIT),
            stone: gl.texture(&Picture::bricks([0.7, 0.68, 0.65])),
            glaze: gl.texture(&Picture::checker(2.0, [0.9, 0.9, 0.9], [0.6, 0.6, 0.65])),
        }
    }
}

impl super::Style for GlLights {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = DVec3::new(5.0 * (0.6 * t).cos(), 2.2 + 0.3 * t.sin(), 5.0 * (0.6 * t).sin());
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(0.0, 1.5, 0.0)),
            projection: perspective(75.0, 0.1, 50.0),
        };
        gl.begin_world(0, camera);
        gl.enable(GL_LIGHTING);
        for (index, color) in COLORS.into_iter().enumerate() {
            let angle = 1.5 * t + 2.1 * index as f64;
            let position = DVec3::new(4.0 * angle.cos(), 3.2, 4.0 * angle.sin());
            let shape = TrueLightShape::Point { position, attenuation: Vec3::new(1.0, 0.1, 0.05) };
            gl.light(index as u8, camera.view, shape, color);
        }
        gl.modelview(camera.view);
        gl.bind(self.stone);
        for (list, object) in self.room.into_iter().zip(1..) {
            gl.call_list(thing(Class::Static, object), list);
        }
        gl.bind(self.glaze);
        for index in 0..4u32 {
            let angle = f64::from(index) * 1.57 - 0.8 * t;
            let place = DVec3::new(2.4 * angle.cos(), 0.5, 2.4 * angle.sin());
            gl.modelview(camera.view * DMat4::from_translation(place) * DMat4::from_rotation_y(3.0 * t));
            gl.call_list(thing(Class::Movable, 100 + u64::from(index)), self.ball);
        }
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
