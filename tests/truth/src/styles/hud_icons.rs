//! A status bar with things that turn in small viewports of their own, in perspective and with their own depth.

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, Texture, WINDOW, thing};
use crate::kit::{Hall, Mesh, Picture, boxed, draw_hud, in_sight, ring, sphere, walk};
use crate::truth::TrueCamera;

/// A building, and what the icons show.
pub struct HudIcons {
    hall: Hall,
    walls: Texture,
    floors: Texture,
    skin: Texture,
    icons: [(Mesh, i32); 3],
}

/// Side of an icon, pixels.
const ICON: i32 = 44;

impl HudIcons {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> HudIcons {
        let mut hall = Hall::new([7, 7], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        HudIcons {
            hall,
            walls: gl.texture(&Picture::bricks([0.5, 0.35, 0.5])),
            floors: gl.texture(&Picture::checker(2.0, [0.45, 0.45, 0.5], [0.55, 0.5, 0.5])),
            skin: gl.texture(&Picture::checker(2.0, [0.85, 0.65, 0.5], [0.5, 0.35, 0.3])),
            icons: [
                (sphere(1.0, 10, 16), 138),
                (boxed(Vec3::splat(-0.7), Vec3::splat(0.7)), 188),
                (ring(0.8, 0.2, 16), 0),
            ],
        }
    }

    fn draw_icons(&self, gl: &mut Client, frame: u32) {
        gl.enable(GL_TEXTURE_2D);
        gl.bind(self.skin);
        gl.enable(GL_SCISSOR_TEST);
        gl.projection(glam::dcamera::rh::proj::opengl::perspective(30f64.to_radians(), 1.0, 0.5, 20.0));
        for ((mesh, left), object) in self.icons.iter().zip(800..) {
            let rect = [*left, 26, ICON, ICON];
            gl.viewport(rect);
            gl.call(id::glScissor, &rect.map(Into::into));
            gl.clear(GL_DEPTH_BUFFER_BIT);
            let turn = DMat4::from_rotation_y(f64::from(frame) / 12.0 + f64::from(*left));
            gl.modelview(DMat4::from_translation(DVec3::NEG_Z * 4.6) * turn);
            gl.draw(thing(Class::Interface, object), mesh, Attributes::COLORED);
        }
        gl.disable(GL_SCISSOR_TEST);
        gl.viewport([0, 0, WINDOW.0, WINDOW.1]);
    }
}

impl super::Style for HudIcons {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.6, f64::from(frame) / 90.0 + 0.8);
        let camera = TrueCamera { view, projection: crate::kit::perspective(73.0, 0.1, 80.0) };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        draw_hud(gl, frame);
        self.draw_icons(gl, frame);
    }
}
