//! A weapon in the player's hands, with a field of view and a part of the depth range of its own. It has more
//! triangles than what is seen of the world.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{Affine3A, DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{Hall, Mesh, Picture, boxed, draw_hud, in_sight, perspective, ring, sphere, walk};
use crate::truth::TrueCamera;

/// A building and a weapon.
pub struct Weapon {
    hall: Hall,
    weapon: Mesh,
    walls: Texture,
    floors: Texture,
    lightmap: Texture,
    metal: Texture,
}

impl Weapon {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Weapon {
        let hall = Hall::new([6, 6], 1);
        gl.set_extent(hall.extent());
        let mut weapon = boxed(Vec3::new(-0.06, -0.08, -0.3), Vec3::new(0.06, 0.06, 0.5));
        for index in 0..6 {
            let along = Affine3A::from_translation(Vec3::new(0.0, 0.0, -0.35 - 0.08 * index as f32));
            weapon.append(&ring(0.06, 0.03, 16).transformed(along));
        }
        weapon.append(&sphere(0.09, 8, 12).transformed(Affine3A::from_translation(Vec3::Y * 0.1)));
        Weapon {
            walls: gl.texture(&Picture::bricks([0.55, 0.5, 0.5])),
            floors: gl.texture(&Picture::checker(2.0, [0.5, 0.4, 0.3], [0.6, 0.55, 0.45])),
            lightmap: gl.texture(&hall.lightmap()),
            metal: gl.texture(&Picture::grain(14, [0.5, 0.52, 0.58], 0.06)),
            weapon,
            hall,
        }
    }
}

impl super::Style for Weapon {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.6, f64::from(frame) / 80.0 + 0.45);
        let camera = TrueCamera { view, projection: perspective(75.0, 0.1, 80.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        gl.unit(1);
        gl.enable(GL_TEXTURE_2D);
        gl.bind(self.lightmap);
        gl.unit(0);
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.walls, Attributes::TWO_UNITS);
            gl.bind(self.floors);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::TWO_UNITS);
        }
        gl.unit(1);
        gl.disable(GL_TEXTURE_2D);
        gl.unit(0);

        let t = f64::from(frame) / 30.0;
        let bob = DVec3::new(0.22 + 0.02 * (4.0 * t).sin(), -0.26 + 0.015 * (8.0 * t).cos(), -0.7);
        gl.depth_range(0.0, 0.3);
        gl.projection(perspective(50.0, 0.05, 10.0));
        gl.modelview(DMat4::from_translation(bob) * DMat4::from_rotation_y(0.12));
        gl.bind(self.metal);
        gl.draw_arrays(thing(Class::ViewModel, 700), &self.weapon, Attributes::COLORED);
        gl.depth_range(0.0, 1.0);
        draw_hud(gl, frame);
    }
}
