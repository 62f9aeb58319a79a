//! A world that changes: doors that open and close, a lift that rests at each floor, and a bridge that is shot to pieces.
//! Each thing has moved before it rests, so whoever remembers knows that it may move again.

use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Hall, Mesh, Picture, boxed, draw_hud, in_sight, perspective, walk};
use crate::truth::TrueCamera;

/// A building with doors, a lift and a bridge.
pub struct Doors {
    hall: Hall,
    door: List,
    lift: List,
    bridge: Mesh,
    walls: Texture,
    floors: Texture,
    wood: Texture,
}

/// From this frame on the bridge is no more.
const SHOT: u32 = 28;

impl Doors {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Doors {
        let mut hall = Hall::new([7, 7], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let bridge = boxed(Vec3::new(6.0, 1.8, 13.2), Vec3::new(22.0, 2.0, 14.8));
        let door = boxed(Vec3::new(-0.1, 0.0, -1.4), Vec3::new(0.1, 3.0, 1.4)).colored([190, 180, 160, 255]);
        let lift = boxed(Vec3::new(-1.4, -0.2, -1.4), Vec3::new(1.4, 0.0, 1.4)).colored([170, 170, 180, 255]);
        Doors {
            hall,
            door: gl.list(&door, Attributes::COLORED),
            lift: gl.list(&lift, Attributes::COLORED),
            bridge: bridge.colored([180, 160, 130, 255]),
            walls: gl.texture(&Picture::bricks([0.5, 0.4, 0.4])),
            floors: gl.texture(&Picture::grain(81, [0.42, 0.42, 0.46], 0.1)),
            wood: gl.texture(&Picture::checker(2.0, [0.5, 0.35, 0.2], [0.4, 0.28, 0.15])),
        }
    }
}

/// How far a door is open, 0 to 1: opens at the start, closes, rests closed, opens again.
fn opened(frame: u32, delay: u32) -> f64 {
    let phase = f64::from((frame + delay) % 40);
    (phase / 6.0).min(1.0) - ((phase - 14.0) / 6.0).clamp(0.0, 1.0)
}

/// Height of the lift: it goes for 5 frames, then rests for 9.
fn lifted(frame: u32) -> f64 {
    let (stop, going) = (frame / 14, (f64::from(frame % 14) / 5.0).min(1.0));
    let height = |stop: u32| f64::from([0u8, 3, 1, 2][stop as usize % 4]);
    height(stop) + (height(stop + 1) - height(stop)) * going
}

impl super::Style for Doors {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.7, f64::from(frame) / 140.0 + 0.15);
        let camera = TrueCamera { view, projection: perspective(80.0, 0.1, 90.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.wood);
        if frame < SHOT {
            gl.draw(thing(Class::Static, 90), &self.bridge, Attributes::COLORED);
        }
        for index in 0..6u32 {
            let slid = 2.6 * opened(frame, index / 3);
            let place =
                DVec3::new(6.0 + 3.0 * f64::from(index), 0.0, 9.0 + slid + f64::from(index % 2) * 8.0);
            gl.modelview(view * DMat4::from_translation(place));
            gl.call_list(thing(Class::Movable, 100 + u64::from(index)), self.door);
        }
        gl.modelview(view * DMat4::from_translation(DVec3::new(14.0, 0.3 + lifted(frame), 18.0)));
        gl.call_list(thing(Class::Movable, 120), self.lift);
        draw_hud(gl, frame);
    }
}
