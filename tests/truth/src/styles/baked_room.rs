//! A room whose lightmap holds the light of three lamps as light goes, and something that moves in it.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{AMBIENT, Mesh, Picture, Room, boxed, draw_hud, perspective, walk};
use crate::truth::TrueCamera;

/// The room, and a crate.
pub struct BakedRoom {
    room: Room,
    walls: Texture,
    floors: Texture,
    lightmap: Texture,
    wood: Texture,
    crate_mesh: Mesh,
}

impl BakedRoom {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> BakedRoom {
        let room = Room::with_lamps();
        gl.set_extent(room.extent());
        gl.set_baked_ambient(AMBIENT);
        BakedRoom {
            walls: gl.texture(&Picture::bricks([0.65, 0.6, 0.55])),
            floors: gl.texture(&Picture::grain(5, [0.55, 0.55, 0.5], 0.1)),
            lightmap: gl.texture(&room.lightmap()),
            wood: gl.texture(&Picture::grain(9, [0.5, 0.4, 0.25], 0.08)),
            crate_mesh: boxed(Vec3::splat(-0.5), Vec3::splat(0.5)),
            room,
        }
    }
}

impl super::Style for BakedRoom {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let centre = self.room.centre();
        let view = walk(centre, DVec3::new(4.5, 1.0, 3.0), f64::from(frame) / 60.0);
        let camera = TrueCamera { view, projection: perspective(75.0, 0.1, 60.0) };
        gl.begin_world(0, camera);
        self.room.lights().into_iter().for_each(|light| gl.shine(light));
        gl.unit(1);
        gl.enable(GL_TEXTURE_2D);
        gl.bind(self.lightmap);
        gl.unit(0);
        for (is_level, texture) in [(true, self.floors), (false, self.walls)] {
            gl.bind(texture);
            let faces = self.room.faces.iter().zip(1..).filter(|(face, _)| face.is_level == is_level);
            for (face, number) in faces {
                gl.draw(thing(Class::Static, number), &face.mesh, Attributes::TWO_UNITS);
            }
        }
        gl.unit(1);
        gl.disable(GL_TEXTURE_2D);
        gl.unit(0);
        let t = f64::from(frame) / 12.0;
        let place = centre + DVec3::new(2.0 * t.cos(), -0.9, 1.5 * t.sin());
        gl.modelview(view * DMat4::from_translation(place) * DMat4::from_rotation_y(t));
        gl.bind(self.wood);
        gl.draw(thing(Class::Movable, 100), &self.crate_mesh, Attributes::TEXTURED);
        draw_hud(gl, frame);
    }
}
