//! A game of balls on a table, in inches that the program scales. The camera rests, then moves, then rests again: while it
//! rests, all that stands still keeps its matrix, and nothing can be learned of the view.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec2, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Mesh, Picture, boxed, draw_hud, look_at, perspective, sphere};
use crate::truth::{TrueCamera, TrueLightShape};

/// A table and balls.
pub struct RestingCamera {
    cloth: List,
    rails: List,
    ball: List,
    felt: Texture,
    wood: Texture,
    glaze: Texture,
}

/// World units (metres) an inch.
const SCALE: f64 = 0.0254;
/// Half the table along x and z, inches.
const HALF: [f32; 2] = [50.0, 25.0];
const RADIUS: f32 = 2.2;

impl RestingCamera {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> RestingCamera {
        gl.set_extent(SCALE * 2.0 * f64::from(Vec2::from(HALF).length()));
        let [x, z] = HALF;
        let mut cloth = Mesh::default();
        let along = [Vec3::Z * 2.0 * z, Vec3::X * 2.0 * x];
        cloth.parallelogram(Vec3::new(-x, 0.0, -z), along, 10, Vec2::splat(8.0));
        let mut rails = Mesh::default();
        for side in [-1.0, 1.0] {
            let middle = Vec3::Z * side * (z + 2.0);
            rails.append(&boxed(middle - Vec3::new(x, 4.0, 2.0), middle + Vec3::new(x, 2.0, 2.0)));
            let middle = Vec3::X * side * (x + 2.0);
            let half = Vec3::new(2.0, 4.0, z + 4.0);
            rails.append(&boxed(middle - half, middle + half - Vec3::Y * 2.0));
        }
        RestingCamera {
            cloth: gl.list(&cloth, Attributes::LIT),
            rails: gl.list(&rails, Attributes::LIT),
            ball: gl.list(&sphere(RADIUS, 10, 14), Attributes::LIT),
            felt: gl.texture(&Picture::grain(31, [0.1, 0.45, 0.2], 0.04)),
            wood: gl.texture(&Picture::grain(32, [0.45, 0.28, 0.15], 0.06)),
            glaze: gl.texture(&Picture::checker(2.0, [0.95, 0.95, 0.9], [0.8, 0.2, 0.15])),
        }
    }
}

/// How far the camera has gone about the table: it moves in the middle third of the run alone.
fn progress(frame: u32) -> f64 {
    let t = ((f64::from(frame) - 20.0) / 20.0).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl super::Style for RestingCamera {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let angle = 0.4 + 1.2 * progress(frame);
        let eye = DVec3::new(1.9 * angle.sin(), 0.9, 1.9 * angle.cos());
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(0.0, 0.0, 0.1)),
            projection: perspective(50.0, 0.05, 20.0),
        };
        gl.clear_color([0.15, 0.12, 0.1]);
        gl.begin_world(0, camera);
        gl.enable(GL_LIGHTING);
        gl.enable(GL_NORMALIZE);
        let shape = TrueLightShape::Point { position: DVec3::new(0.3, 1.6, 0.2), attenuation: Vec3::X };
        gl.light(0, camera.view, shape, Vec3::new(1.0, 0.95, 0.85));
        let scaled = camera.view * DMat4::from_scale(DVec3::splat(SCALE));
        gl.modelview(scaled);
        gl.bind(self.felt);
        gl.call_list(thing(Class::Static, 1), self.cloth);
        gl.bind(self.wood);
        gl.call_list(thing(Class::Static, 2), self.rails);
        gl.bind(self.glaze);
        for index in 0..8u32 {
            let phase = 1.7 * f64::from(index);
            let rolled = 14.0 * (0.8 * t + phase).sin();
            let place = DVec3::new(rolled + 4.0 * f64::from(index) - 14.0, RADIUS.into(), 20.0 * phase.cos());
            let roll = DMat4::from_rotation_z(-rolled / f64::from(RADIUS));
            gl.modelview(scaled * DMat4::from_translation(place) * roll);
            gl.call_list(thing(Class::Movable, 100 + u64::from(index)), self.ball);
        }
        gl.disable(GL_NORMALIZE);
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
