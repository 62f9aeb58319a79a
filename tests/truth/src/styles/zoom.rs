//! A scope: the field of view changes with each frame, while the camera walks and while it stands still.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Land, Picture, boxed, draw_hud, in_sight, look_at, perspective};
use crate::truth::{TrueCamera, TrueLightShape};

/// Hills with mills on them.
pub struct Zoom {
    land: Land,
    house: List,
    sail: List,
    grass: Texture,
    wood: Texture,
}

impl Zoom {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Zoom {
        let land = Land::new(4, 1);
        gl.set_extent(land.extent());
        Zoom {
            land,
            house: gl.list(&boxed(Vec3::new(-1.2, -1.0, -1.2), Vec3::new(1.2, 4.0, 1.2)), Attributes::LIT),
            sail: gl.list(&boxed(Vec3::new(-0.3, -3.0, 0.0), Vec3::new(0.3, 3.0, 0.1)), Attributes::LIT),
            grass: gl.texture(&Picture::grain(71, [0.4, 0.5, 0.3], 0.1)),
            wood: gl.texture(&Picture::bricks([0.6, 0.5, 0.4])),
        }
    }
}

/// Vertical field of view, degrees: wide, then slowly in and quickly out again.
fn field_of_view(frame: u32) -> f64 {
    let phase = f64::from(frame % 24) / 24.0;
    75.0 - 60.0 * (phase / 0.7).min(1.0) + 60.0 * ((phase - 0.7).max(0.0) / 0.3)
}

impl super::Style for Zoom {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        // It stops for the last third.
        let t = f64::from(frame.min(32)) / 30.0;
        let eye = DVec3::new(20.0 * (0.3 * t).sin(), 5.0 + 0.5 * t, 22.0);
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(4.0 * (0.7 * t).sin(), 1.5, -6.0)),
            projection: perspective(field_of_view(frame), 0.2, 150.0),
        };
        gl.clear_color([0.65, 0.75, 0.9]);
        gl.begin_world(0, camera);
        gl.enable(GL_LIGHTING);
        let to_light = DVec3::new(-0.5, 0.7, 0.5).normalize();
        gl.light(0, camera.view, TrueLightShape::Directional { to_light }, Vec3::ONE);
        gl.bind(self.grass);
        for cell in self.land.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::LIT);
        }
        gl.bind(self.wood);
        for index in 0..4u32 {
            let (x, z) = (-9.0 + 6.0 * index as f32, -8.0 + 3.0 * (index % 2) as f32);
            let place = Vec3::new(x, Land::height(x, z), z).as_dvec3();
            gl.modelview(camera.view * DMat4::from_translation(place));
            gl.call_list(thing(Class::Static, 100 + u64::from(index)), self.house);
            let turned = DMat4::from_rotation_z(f64::from(frame) / 15.0 + f64::from(index));
            let axle = DMat4::from_translation(place + DVec3::new(0.0, 3.5, 1.4)) * turned;
            gl.modelview(camera.view * axle);
            gl.call_list(thing(Class::Movable, 200 + u64::from(index)), self.sail);
        }
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
