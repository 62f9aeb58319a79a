//! Layers of all kinds: fine grain on the second unit, lamps' glow added in a pass of its own, and a sheen by sphere
//! mapping added to things that move.

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;
use glam::{DMat4, DVec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Cell, Hall, Picture, draw_hud, in_sight, perspective, ring, sphere, walk};
use crate::truth::TrueCamera;

/// A building with shining things in it.
pub struct GlowLayers {
    hall: Hall,
    shapes: [List; 2],
    walls: Texture,
    floors: Texture,
    grain: Texture,
    lamps: Texture,
    sheen: Texture,
}

const THINGS: u32 = 6;

impl GlowLayers {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> GlowLayers {
        let mut hall = Hall::new([6, 6], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let lamps = Picture::of(64, |x, y| {
            let is_lamp = (x * 4.0).fract() < 0.2 && (y * 4.0).fract() < 0.1;
            if is_lamp { [0.9, 0.7, 0.3, 1.0] } else { [0.0, 0.0, 0.0, 1.0] }
        });
        let grain = gl.texture(&Picture::grain(41, [0.5; 3], 0.1));
        gl.unit(1);
        gl.bind(grain);
        set_detail(gl);
        gl.unit(0);
        GlowLayers {
            hall,
            shapes: [
                gl.list(&sphere(0.6, 10, 14), Attributes::LIT),
                gl.list(&ring(0.6, 0.2, 14), Attributes::LIT),
            ],
            walls: gl.texture(&Picture::bricks([0.45, 0.45, 0.55])),
            floors: gl.texture(&Picture::checker(2.0, [0.4, 0.42, 0.45], [0.3, 0.3, 0.34])),
            grain,
            lamps: gl.texture(&lamps),
            sheen: gl.texture(&Picture::clouds()),
        }
    }

    fn draw_walls(&self, gl: &mut Client, seen: &[&Cell]) {
        gl.unit(1);
        gl.enable(GL_TEXTURE_2D);
        gl.bind(self.grain);
        gl.unit(0);
        for cell in seen {
            gl.bind(self.walls);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.walls, DETAILED);
            gl.bind(self.floors);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, DETAILED);
        }
        gl.unit(1);
        gl.disable(GL_TEXTURE_2D);
        gl.unit(0);
    }

    fn draw_glow(&self, gl: &mut Client, seen: &[&Cell]) {
        gl.depth_func(GL_EQUAL);
        gl.depth_mask(false);
        gl.blend(Some((GL_ONE, GL_ONE)));
        gl.bind(self.lamps);
        gl.color([1.0; 4]);
        for cell in seen {
            gl.draw_arrays(thing(Class::Layer, cell.object), &cell.walls, Attributes::TEXTURED);
        }
        gl.blend(None);
        gl.depth_mask(true);
        gl.depth_func(GL_LEQUAL);
    }

    /// A thing, and once more what it mirrors.
    fn draw_shining(&self, gl: &mut Client, index: u32, modelview: DMat4) {
        let (object, list) = (100 + u64::from(index), self.shapes[index as usize % 2]);
        gl.modelview(modelview);
        gl.bind(self.floors);
        gl.color([0.5, 0.45, 0.4, 1.0]);
        gl.call_list(thing(Class::Movable, object), list);
        gl.color([0.4, 0.4, 0.4, 1.0]);
        gl.bind(self.sheen);
        gl.blend(Some((GL_ONE, GL_ONE)));
        gl.depth_mask(false);
        for (coordinate, generates) in [(GL_S, GL_TEXTURE_GEN_S), (GL_T, GL_TEXTURE_GEN_T)] {
            let mode = [coordinate.into(), GL_TEXTURE_GEN_MODE.into(), GL_SPHERE_MAP.into()];
            gl.call(id::glTexGeni, &mode);
            gl.enable(generates);
        }
        gl.call_list(thing(Class::Layer, object), list);
        gl.disable(GL_TEXTURE_GEN_S);
        gl.disable(GL_TEXTURE_GEN_T);
        gl.depth_mask(true);
        gl.blend(None);
        gl.color([1.0; 4]);
    }
}

/// Coordinates of the detail are those of the lightmap, many times repeated by the texture matrix.
const DETAILED: Attributes = Attributes { color: true, ..Attributes::TWO_UNITS };

/// The second unit adds its grain about its middle, finely repeated.
fn set_detail(gl: &mut Client) {
    for (name, value) in [
        (GL_TEXTURE_ENV_MODE, GL_COMBINE),
        (GL_COMBINE_RGB, GL_ADD_SIGNED),
        (GL_COMBINE_ALPHA, GL_REPLACE),
        (GL_SOURCE0_RGB, GL_PREVIOUS),
        (GL_SOURCE1_RGB, GL_TEXTURE),
        (GL_SOURCE0_ALPHA, GL_PREVIOUS),
    ] {
        gl.call(id::glTexEnvi, &[GL_TEXTURE_ENV.into(), name.into(), value.into()]);
    }
    gl.call(id::glMatrixMode, &[GL_TEXTURE.into()]);
    gl.call(id::glScalef, &[7.0.into(), 7.0.into(), 1.0.into()]);
    gl.call(id::glMatrixMode, &[GL_MODELVIEW.into()]);
}

impl super::Style for GlowLayers {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let view = walk(self.hall.centre(), self.hall.centre() * 0.65, f64::from(frame) / 105.0 + 0.55);
        let camera = TrueCamera { view, projection: perspective(70.0, 0.1, 80.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        let is_seen = |cell: &&Cell| in_sight(&camera, cell.centre, cell.radius);
        let seen: Vec<&Cell> = self.hall.cells.iter().filter(is_seen).collect();
        self.draw_walls(gl, &seen);
        self.draw_glow(gl, &seen);
        for index in 0..THINGS {
            let angle = f64::from(index) + 0.6 * t;
            let place = DVec3::new(12.0 + 5.0 * angle.cos(), 1.0, 12.0 + 5.0 * angle.sin());
            if in_sight(&camera, place, 1.0) {
                let turn = DMat4::from_rotation_y(2.0 * t) * DMat4::from_rotation_x(0.4);
                self.draw_shining(gl, index, view * DMat4::from_translation(place) * turn);
            }
        }
        draw_hud(gl, frame);
    }
}
