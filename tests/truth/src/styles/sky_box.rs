//! A box of sky about the eye, in world coordinates that move with it, drawn after the world at the far end of the
//! depth range.

use afterglow_scene::Class;
use glam::{Affine3A, DVec3, Vec3};

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{Land, Mesh, Picture, boxed, draw_hud, in_sight, look_at, perspective};
use crate::truth::TrueCamera;

/// Land with walls on it.
pub struct SkyBox {
    land: Land,
    walls: Vec<Mesh>,
    ground: Texture,
    wall: Texture,
    sky: Texture,
}

impl SkyBox {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> SkyBox {
        let land = Land::new(4, 1);
        gl.set_extent(land.extent());
        let wall = |x: f32, z: f32, length: f32| {
            let least = Vec3::new(x, Land::height(x, z) - 2.0, z);
            boxed(least, least + Vec3::new(length, 5.0, 1.0))
        };
        let walls = vec![wall(-12.0, -8.0, 10.0), wall(2.0, -12.0, 8.0), wall(6.0, 4.0, 12.0)];
        SkyBox {
            land,
            walls,
            ground: gl.texture(&Picture::grain(12, [0.55, 0.5, 0.4], 0.1)),
            wall: gl.texture(&Picture::bricks([0.6, 0.5, 0.35])),
            sky: gl.texture(&Picture::clouds()),
        }
    }
}

impl super::Style for SkyBox {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = DVec3::new(10.0 * (0.5 * t).sin(), 2.6, 12.0 - 4.0 * t);
        let ahead = DVec3::new((0.9 * t).sin(), 0.02 + 0.1 * t.sin(), -(0.9 * t).cos());
        let camera =
            TrueCamera { view: look_at(eye, eye + ahead), projection: perspective(75.0, 0.2, 200.0) };
        gl.begin_world(0, camera);
        gl.bind(self.ground);
        for cell in self.land.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.wall);
        for (wall, object) in self.walls.iter().zip(100..) {
            gl.draw_arrays(thing(Class::Static, object), wall, Attributes::COLORED);
        }
        gl.bind(self.sky);
        gl.depth_range(1.0, 1.0);
        let sky = boxed(Vec3::splat(-50.0), Vec3::splat(50.0));
        let sky = sky.transformed(Affine3A::from_translation(eye.as_vec3()));
        gl.draw_arrays(thing(Class::Sky, 500), &sky, Attributes::COLORED);
        gl.depth_range(0.0, 1.0);
        draw_hud(gl, frame);
    }
}
