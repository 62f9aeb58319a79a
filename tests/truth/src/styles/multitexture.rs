//! An engine of the time of two texture units: a display list a cell, with the lightmap on the second unit.

use afterglow_api::constants::*;
use afterglow_scene::Class;

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Hall, Picture, draw_hud, in_sight, perspective, walk};
use crate::truth::TrueCamera;

/// A building in display lists: of each cell, walls and floors.
pub struct Multitexture {
    hall: Hall,
    lists: Vec<[List; 2]>,
    textures: [Texture; 2],
    lightmap: Texture,
}

impl Multitexture {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Multitexture {
        let hall = Hall::new([6, 9], 1);
        gl.set_extent(hall.extent());
        let list = |gl: &mut Client, mesh| gl.list(mesh, Attributes::TWO_UNITS);
        let lists = hall.cells.iter().map(|cell| [list(gl, &cell.walls), list(gl, &cell.floors)]).collect();
        let walls = gl.texture(&Picture::bricks([0.7, 0.65, 0.6]));
        let floors = gl.texture(&Picture::grain(8, [0.6, 0.5, 0.4], 0.08));
        let lightmap = gl.texture(&hall.lightmap());
        Multitexture { hall, lists, textures: [walls, floors], lightmap }
    }
}

impl super::Style for Multitexture {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.5, f64::from(frame) / 120.0 + 0.1);
        let camera = TrueCamera { view, projection: perspective(60.0, 0.1, 60.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        gl.unit(1);
        gl.enable(GL_TEXTURE_2D);
        gl.bind(self.lightmap);
        gl.unit(0);
        for (which, texture) in self.textures.into_iter().enumerate() {
            gl.bind(texture);
            for (cell, lists) in self.hall.cells.iter().zip(&self.lists) {
                if in_sight(&camera, cell.centre, cell.radius) {
                    gl.call_list(thing(Class::Static, cell.object), lists[which]);
                }
            }
        }
        gl.unit(1);
        gl.disable(GL_TEXTURE_2D);
        gl.unit(0);
        draw_hud(gl, frame);
    }
}
