//! Texture coordinates that the program moves: a lake whose water flows, in place.

use afterglow_scene::Class;
use glam::{DVec3, Vec2, Vec3};

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{Land, Mesh, Picture, draw_hud, in_sight, look_at, perspective};
use crate::truth::TrueCamera;

/// Hills with a lake between them, and a fall of water.
pub struct Scrolling {
    land: Land,
    lake: Mesh,
    fall: Mesh,
    grass: Texture,
    water: Texture,
}

impl Scrolling {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Scrolling {
        let land = Land::new(4, 1);
        gl.set_extent(land.extent());
        let (mut lake, mut fall) = (Mesh::default(), Mesh::default());
        let corner = Vec3::new(-32.0, -0.4, -32.0);
        lake.parallelogram(corner, [Vec3::Z * 64.0, Vec3::X * 64.0], 8, Vec2::splat(16.0));
        let edge = Vec3::new(-4.0, -0.4, -14.0);
        fall.parallelogram(edge, [Vec3::X * 8.0, Vec3::new(0.0, 6.0, -2.0)], 4, Vec2::new(3.0, 2.0));
        let grass = gl.texture(&Picture::grain(4, [0.35, 0.5, 0.25], 0.12));
        let water = gl.texture(&Picture::water());
        Scrolling { land, lake, fall, grass, water }
    }
}

impl super::Style for Scrolling {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = DVec3::new(8.0 * (0.6 * t).sin(), 3.0 + 0.3 * t, 14.0 - 2.0 * t);
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(2.0 * (0.9 * t).sin(), 1.0, -10.0)),
            projection: perspective(65.0, 0.2, 120.0),
        };
        gl.clear_color([0.6, 0.7, 0.85]);
        gl.begin_world(0, camera);
        gl.bind(self.grass);
        for cell in self.land.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.draw(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.water);
        gl.color([1.0; 4]);
        let flows = [(&self.lake, 100, Vec2::new(0.3, 0.1)), (&self.fall, 101, Vec2::new(0.0, 1.1))];
        for (mesh, object, speed) in flows {
            let mut mesh = mesh.clone();
            mesh.vertices_mut().for_each(|vertex| vertex.uv += speed * t as f32);
            gl.draw(thing(Class::Static, object), &mesh, Attributes::TEXTURED);
        }
        draw_hud(gl, frame);
    }
}
