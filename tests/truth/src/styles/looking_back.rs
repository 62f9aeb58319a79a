//! A camera that turns round on the spot and back again: what was seen leaves the view, and is the same when it returns.

use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Hall, Picture, boxed, draw_hud, in_sight, look_at, perspective};
use crate::truth::TrueCamera;

/// A building with crates, some of which slide.
pub struct LookingBack {
    hall: Hall,
    slider: List,
    walls: Texture,
    floors: Texture,
}

impl LookingBack {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> LookingBack {
        let mut hall = Hall::new([7, 7], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let slider = boxed(Vec3::new(-0.6, 0.0, -0.6), Vec3::new(0.6, 1.3, 0.6));
        LookingBack {
            hall,
            slider: gl.list(&slider.colored([190, 180, 170, 255]), Attributes::COLORED),
            walls: gl.texture(&Picture::bricks([0.45, 0.5, 0.55])),
            floors: gl.texture(&Picture::checker(2.0, [0.5, 0.48, 0.4], [0.35, 0.33, 0.3])),
        }
    }
}

/// Angle of the look, radians: a full turn, a rest, and the same back.
fn turned(frame: u32) -> f64 {
    let share = (f64::from(frame) / 25.0).min(1.0) - ((f64::from(frame) - 30.0) / 17.0).clamp(0.0, 1.0);
    std::f64::consts::TAU * share + 0.4
}

impl super::Style for LookingBack {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = self.hall.centre() * DVec3::new(0.85, 0.0, 1.1) + DVec3::Y * 1.7;
        let ahead = DVec3::new(turned(frame).cos(), -0.1, turned(frame).sin());
        let camera = TrueCamera { view: look_at(eye, eye + ahead), projection: perspective(60.0, 0.1, 80.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.walls);
        for index in 0..10u32 {
            let angle = 0.63 * f64::from(index);
            let (class, along) = match index % 2 {
                0 => (Class::Movable, (1.5 * t + angle).sin()),
                _ => (Class::Static, 0.0),
            };
            let place = eye + DVec3::new((6.0 + along) * angle.cos(), -1.7, (6.0 + along) * angle.sin());
            if in_sight(&camera, place, 1.3) {
                gl.modelview(camera.view * DMat4::from_translation(place));
                gl.call_list(thing(class, 100 + u64::from(index)), self.slider);
            }
        }
        draw_hud(gl, frame);
    }
}
