//! An engine that transforms what moves on the CPU: creatures whose limbs swing, and a lift that stays as it is, all
//! sent in world coordinates.

use std::f32::consts::TAU;

use afterglow_scene::Class;
use glam::{Affine3A, Vec3};

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{Hall, Picture, boxed, creature, in_sight, perspective, walk};
use crate::truth::TrueCamera;

/// A building with creatures in it.
pub struct CpuAnimation {
    hall: Hall,
    walls: Texture,
    floors: Texture,
    skin: Texture,
}

const CREATURES: u64 = 6;

impl CpuAnimation {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> CpuAnimation {
        let mut hall = Hall::new([6, 6], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let walls = gl.texture(&Picture::bricks([0.5, 0.55, 0.45]));
        let floors = gl.texture(&Picture::grain(5, [0.45, 0.4, 0.38], 0.1));
        let skin = gl.texture(&Picture::checker(3.0, [0.6, 0.35, 0.25], [0.3, 0.4, 0.6]));
        CpuAnimation { hall, walls, floors, skin }
    }
}

impl super::Style for CpuAnimation {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = frame as f32 / 30.0;
        let view = walk(self.hall.centre(), self.hall.centre() * 0.7, f64::from(frame) / 160.0);
        let camera = TrueCamera { view, projection: perspective(70.0, 0.1, 60.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        let centre = self.hall.centre().as_vec3() * Vec3::new(1.0, 0.0, 1.0);
        gl.bind(self.skin);
        for index in 0..CREATURES {
            let angle = index as f32 / CREATURES as f32 * TAU + 0.25 * t;
            let place = centre + Vec3::new(angle.cos(), 0.0, angle.sin()) * (2.5 + index as f32);
            let walked = Affine3A::from_translation(place) * Affine3A::from_rotation_y(-angle);
            if in_sight(&camera, place.as_dvec3(), 2.0) {
                let mesh = creature(5.0 * t + index as f32).transformed(walked);
                gl.draw_arrays(thing(Class::Dynamic, 100 + index), &mesh, Attributes::COLORED);
            }
        }
        let lift = Affine3A::from_translation(centre + Vec3::Y * (1.0 + 0.8 * t.sin()));
        let platform = boxed(Vec3::new(-1.5, -0.2, -1.5), Vec3::new(1.5, 0.0, 1.5)).transformed(lift);
        if in_sight(&camera, centre.as_dvec3(), 3.0) {
            gl.draw_arrays(thing(Class::Dynamic, 200), &platform, Attributes::COLORED);
        }
    }
}
