//! An engine that gathers what is seen into one batch a texture, nearest first: the same triangles lie in other
//! batches, and elsewhere in them, with each frame.

use afterglow_scene::Class;

use crate::client::{Attributes, Client, Texture, Thing, thing};
use crate::kit::{Cell, Hall, Mesh, Picture, draw_hud, in_sight, perspective, walk};
use crate::truth::TrueCamera;

/// A building and its textures.
pub struct Batches {
    hall: Hall,
    walls: Texture,
    floors: Texture,
}

impl Batches {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Batches {
        let mut hall = Hall::new([9, 7], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let walls = gl.texture(&Picture::bricks([0.45, 0.5, 0.6]));
        let floors = gl.texture(&Picture::checker(2.0, [0.6, 0.55, 0.4], [0.4, 0.3, 0.2]));
        Batches { hall, walls, floors }
    }
}

impl super::Style for Batches {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.7, f64::from(frame) / 70.0 + 0.6);
        let camera = TrueCamera { view, projection: perspective(75.0, 0.2, 80.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        let is_seen = |cell: &&Cell| in_sight(&camera, cell.centre, cell.radius);
        let mut seen: Vec<&Cell> = self.hall.cells.iter().filter(is_seen).collect();
        let depth = |cell: &Cell| -view.transform_point3(cell.centre).z;
        seen.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        for (texture, is_wall) in [(self.walls, true), (self.floors, false)] {
            gl.bind(texture);
            let parts: Vec<(Thing, &Mesh)> = seen
                .iter()
                .map(|cell| {
                    let mesh = if is_wall { &cell.walls } else { &cell.floors };
                    (thing(Class::Static, cell.object), mesh)
                })
                .collect();
            gl.draw_batch(&parts, Attributes::COLORED);
        }
        draw_hud(gl, frame);
    }
}
