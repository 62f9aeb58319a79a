//! The simplest engine: all of a building under one matrix, its light in the colours of its vertices.

use afterglow_scene::Class;

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{Hall, Picture, draw_hud, in_sight, perspective, walk};
use crate::truth::TrueCamera;

/// A building and its textures.
pub struct OneMatrix {
    hall: Hall,
    bricks: Texture,
    tiles: Texture,
}

impl OneMatrix {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> OneMatrix {
        let mut hall = Hall::new([7, 6], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let bricks = gl.texture(&Picture::bricks([0.6, 0.3, 0.22]));
        let tiles = gl.texture(&Picture::checker(4.0, [0.5, 0.5, 0.45], [0.35, 0.37, 0.4]));
        OneMatrix { hall, bricks, tiles }
    }
}

impl super::Style for OneMatrix {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.6, f64::from(frame) / 90.0);
        let camera = TrueCamera { view, projection: perspective(65.0, 0.1, 100.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for (texture, is_wall) in [(self.bricks, true), (self.tiles, false)] {
            gl.bind(texture);
            for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
                let mesh = if is_wall { &cell.walls } else { &cell.floors };
                gl.draw(thing(Class::Static, cell.object), mesh, Attributes::COLORED);
            }
        }
        draw_hud(gl, frame);
    }
}
