//! An engine of the time of one texture unit: walls in world coordinates polygon by polygon, then all again with
//! the lightmap multiplied where depth is equal.

use afterglow_api::constants::*;
use afterglow_scene::Class;

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{Cell, Hall, Picture, draw_hud, in_sight, perspective, walk};
use crate::truth::TrueCamera;

/// A building, its textures and its lightmap.
pub struct LightmapPasses {
    hall: Hall,
    walls: Texture,
    floors: Texture,
    lightmap: Texture,
}

impl LightmapPasses {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> LightmapPasses {
        let hall = Hall::new([8, 5], 1);
        gl.set_extent(hall.extent());
        let walls = gl.texture(&Picture::bricks([0.65, 0.55, 0.4]));
        let floors = gl.texture(&Picture::grain(3, [0.5, 0.48, 0.45], 0.12));
        let lightmap = gl.texture(&hall.lightmap());
        LightmapPasses { hall, walls, floors, lightmap }
    }

    fn pass(gl: &mut Client, seen: &[&Cell], is_wall: bool, class: Class, attributes: Attributes) {
        for cell in seen {
            let mesh = if is_wall { &cell.walls } else { &cell.floors };
            gl.draw(thing(class, cell.object), mesh, attributes);
        }
    }
}

impl super::Style for LightmapPasses {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.55, f64::from(frame) / 100.0 + 0.3);
        let camera = TrueCamera { view, projection: perspective(70.0, 0.1, 100.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        let is_seen = |cell: &&Cell| in_sight(&camera, cell.centre, cell.radius);
        let seen: Vec<&Cell> = self.hall.cells.iter().filter(is_seen).collect();
        for (texture, is_wall) in [(self.walls, true), (self.floors, false)] {
            gl.bind(texture);
            Self::pass(gl, &seen, is_wall, Class::Static, Attributes::TEXTURED);
        }
        gl.bind(self.lightmap);
        gl.depth_func(GL_EQUAL);
        gl.depth_mask(false);
        gl.blend(Some((GL_DST_COLOR, GL_ZERO)));
        for is_wall in [true, false] {
            Self::pass(gl, &seen, is_wall, Class::Layer, Attributes::LIGHTMAP);
        }
        gl.blend(None);
        gl.depth_mask(true);
        gl.depth_func(GL_LEQUAL);
        draw_hud(gl, frame);
    }
}
