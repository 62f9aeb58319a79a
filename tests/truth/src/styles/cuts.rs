//! A director's cuts: the camera jumps about one world, from a walk to a fixed place and back, and crates jump with it.
//! Nothing is loaded and no screen lies between; what was known of the world holds.

use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Hall, Picture, boxed, draw_hud, in_sight, look_at, perspective, walk};
use crate::truth::TrueCamera;

/// A building with crates that are carried off.
pub struct Cuts {
    hall: Hall,
    box_list: List,
    walls: Texture,
    floors: Texture,
}

const CRATES: u32 = 8;

impl Cuts {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Cuts {
        let mut hall = Hall::new([8, 8], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let shape = boxed(Vec3::new(-0.5, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5));
        Cuts {
            hall,
            box_list: gl.list(&shape.colored([190, 170, 150, 255]), Attributes::COLORED),
            walls: gl.texture(&Picture::bricks([0.55, 0.45, 0.5])),
            floors: gl.texture(&Picture::grain(31, [0.4, 0.42, 0.4], 0.1)),
        }
    }

    /// The camera walks, cuts to a corner, cuts back, and at last is carried across the building.
    fn view(&self, frame: u32) -> DMat4 {
        let centre = self.hall.centre();
        let walked = |round: f64| walk(centre, centre * 0.6, round + f64::from(frame) / 100.0);
        let corner = DVec3::new(2.0, 3.2, 2.0);
        let aside = DVec3::X * 0.02 * f64::from(frame);
        match frame {
            0..14 => walked(0.2),
            14..22 => look_at(corner + aside, centre * DVec3::new(1.0, 0.4, 1.0)),
            22..34 => walked(0.2),
            _ => walked(0.65),
        }
    }
}

/// Where a crate stands. Every twelve frames it is elsewhere at once.
fn place(index: u32, frame: u32) -> DVec3 {
    let jumps = (frame + 8 + 3 * (index % 3)) / 12;
    let angle = f64::from(index) * 0.9 + f64::from(jumps) * 2.1;
    let radius = 3.0 + f64::from((index + 3 * jumps) % 5) * 1.7;
    DVec3::new(16.0 + radius * angle.cos(), 0.0, 16.0 + radius * angle.sin())
}

impl super::Style for Cuts {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let camera = TrueCamera { view: self.view(frame), projection: perspective(70.0, 0.1, 90.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.walls);
        for index in 0..CRATES {
            let place = place(index, frame);
            if in_sight(&camera, place, 1.0) {
                gl.modelview(camera.view * DMat4::from_translation(place));
                gl.call_list(thing(Class::Movable, 100 + u64::from(index)), self.box_list);
            }
        }
        draw_hud(gl, frame);
    }
}
