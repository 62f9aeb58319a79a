//! A program that multiplies its view into the PROJECTION matrix, so that MODELVIEW is the model alone.

use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Hall, Picture, boxed, draw_hud, in_sight, perspective, walk};
use crate::truth::TrueCamera;

/// A building with crates that slide.
pub struct ViewInProjection {
    hall: Hall,
    slider: List,
    walls: Texture,
    floors: Texture,
}

impl ViewInProjection {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> ViewInProjection {
        let mut hall = Hall::new([7, 6], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let slider = boxed(Vec3::new(-0.7, 0.0, -0.7), Vec3::new(0.7, 1.4, 0.7));
        ViewInProjection {
            hall,
            slider: gl.list(&slider.colored([200, 190, 170, 255]), Attributes::COLORED),
            walls: gl.texture(&Picture::bricks([0.4, 0.5, 0.4])),
            floors: gl.texture(&Picture::checker(4.0, [0.5, 0.5, 0.4], [0.3, 0.35, 0.3])),
        }
    }
}

impl super::Style for ViewInProjection {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let view = walk(self.hall.centre(), self.hall.centre() * 0.6, f64::from(frame) / 95.0 + 0.2);
        let camera = TrueCamera { view, projection: perspective(68.0, 0.1, 80.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        gl.projection(camera.projection * camera.view);
        gl.modelview(DMat4::IDENTITY);
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.walls);
        for index in 0..6u32 {
            let along = 2.0 * (t + f64::from(index)).sin();
            let place = DVec3::new(4.0 + 4.0 * f64::from(index) + along, 0.0, 12.0 - along);
            if in_sight(&camera, place, 2.0) {
                gl.modelview(DMat4::from_translation(place));
                gl.call_list(thing(Class::Movable, 100 + u64::from(index)), self.slider);
            }
        }
        draw_hud(gl, frame);
    }
}
