//! Two thousand things, each with a matrix of its own and culled by itself; one in ten moves. Nothing is drawn under the
//! view itself.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec2, Vec3};

use crate::client::{Attributes, Client, List, Texture, Thing, thing};
use crate::kit::{Mesh, Picture, Random, draw_hud, in_sight, look_at, perspective};
use crate::truth::{TrueCamera, TrueLightShape};

/// A field of huts and drones.
pub struct ManyObjects {
    things: Vec<Placed>,
    shapes: [List; 3],
    textures: [Texture; 3],
}

struct Placed {
    thing: Thing,
    place: DVec3,
    turn: f64,
    shape: usize,
}

const THINGS: u64 = 2000;
const SIDE: f32 = 90.0;
/// How far this program draws.
const FAR: f64 = 55.0;

impl ManyObjects {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> ManyObjects {
        gl.set_extent(f64::from(SIDE) * std::f64::consts::SQRT_2);
        let mut random = Random::new(5);
        let mut placed = |index: u64| {
            let class = if index % 10 == 3 { Class::Movable } else { Class::Static };
            let mut along = || f64::from(random.between(-SIDE / 2.0, SIDE / 2.0));
            let place = DVec3::new(along(), 0.0, along());
            let turn = random.between(0.0, 6.0).into();
            Placed { thing: thing(class, 1 + index), place, turn, shape: index as usize % 3 }
        };
        ManyObjects {
            things: (0..THINGS).map(&mut placed).collect(),
            shapes: [0.6, 0.9, 1.3].map(|height| gl.list(&tent(height), Attributes::LIT)),
            textures: [
                gl.texture(&Picture::bricks([0.6, 0.5, 0.4])),
                gl.texture(&Picture::grain(91, [0.5, 0.55, 0.4], 0.1)),
                gl.texture(&Picture::checker(2.0, [0.7, 0.6, 0.3], [0.4, 0.35, 0.3])),
            ],
        }
    }
}

/// A pyramid without a floor.
fn tent(height: f32) -> Mesh {
    let corners = [
        Vec3::new(-0.5, 0.0, -0.5),
        Vec3::new(-0.5, 0.0, 0.5),
        Vec3::new(0.5, 0.0, 0.5),
        Vec3::new(0.5, 0.0, -0.5),
    ];
    let top = Vec3::Y * height;
    let mut mesh = Mesh::default();
    for side in 0..4 {
        let (a, b) = (corners[side], corners[(side + 1) % 4]);
        let normal = (b - a).cross(top - a).normalize();
        let vertex = |position, uv| crate::kit::Vertex::new(position, normal, uv);
        mesh.push(
            GL_TRIANGLES,
            &[vertex(a, Vec2::ZERO), vertex(b, Vec2::X), vertex(top, Vec2::new(0.5, 1.0))],
        );
    }
    mesh
}

impl super::Style for ManyObjects {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let angle = 0.35 * t;
        let eye = DVec3::new(34.0 * angle.cos(), 5.0 + t, 34.0 * angle.sin());
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(4.0 * t.sin(), 0.0, 4.0)),
            projection: perspective(60.0, 0.2, FAR),
        };
        gl.clear_color([0.6, 0.65, 0.7]);
        gl.begin_world(0, camera);
        gl.enable(GL_LIGHTING);
        let to_light = DVec3::new(0.3, 0.8, 0.5).normalize();
        gl.light(0, camera.view, TrueLightShape::Directional { to_light }, Vec3::ONE);
        for placed in &self.things {
            let speed = if placed.thing.class == Class::Movable { 1.0 } else { 0.0 };
            let along = speed * (2.0 * t + placed.turn).sin();
            let place = placed.place + DVec3::new(along, speed * (1.0 + 0.3 * along), 0.0);
            if in_sight(&camera, place, 1.4) && eye.distance(place) < FAR {
                let turn = DMat4::from_rotation_y(placed.turn + speed * t);
                gl.modelview(camera.view * DMat4::from_translation(place) * turn);
                gl.bind(self.textures[placed.shape]);
                gl.call_list(placed.thing, self.shapes[placed.shape]);
            }
        }
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
