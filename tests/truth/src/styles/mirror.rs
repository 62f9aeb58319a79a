//! A floor that mirrors: its place is marked in the stencil, the room is drawn there upside down, then the floor is
//! blended over it, and at last the room itself is drawn. What only serves the mirror is of the other view.

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec2, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Hall, Mesh, Picture, boxed, draw_hud, perspective, sphere, walk};
use crate::truth::{TrueCamera, TrueLightShape};

/// A room whose floor is a mirror, with balls that bounce.
pub struct Mirror {
    hall: Hall,
    walls: Mesh,
    floor: Mesh,
    ball: List,
    bricks: Texture,
    marble: Texture,
}

const BALLS: u64 = 5;

impl Mirror {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Mirror {
        let hall = Hall::new([4, 4], 1);
        gl.set_extent(hall.extent());
        let mut walls = Mesh::default();
        for cell in &hall.cells {
            walls.append(&cell.walls);
        }
        for place in [Vec3::new(4.0, 0.0, 11.0), Vec3::new(11.0, 0.0, 5.0)] {
            walls.append(&boxed(place, place + Vec3::new(1.2, 1.2, 1.2)));
        }
        let mut floor = Mesh::default();
        floor.parallelogram(Vec3::ZERO, [Vec3::Z * 16.0, Vec3::X * 16.0], 4, Vec2::splat(8.0));
        Mirror {
            hall,
            walls,
            floor,
            ball: gl.list(&sphere(0.6, 10, 14), Attributes::LIT),
            bricks: gl.texture(&Picture::bricks([0.65, 0.5, 0.4])),
            marble: gl.texture(&Picture::checker(2.0, [0.8, 0.8, 0.8], [0.25, 0.28, 0.35])),
        }
    }

    /// The room without its floor, seen by `view`. `class` is what its things are there.
    fn draw_room(&self, gl: &mut Client, view: DMat4, t: f64, class: impl Fn(Class) -> Class) {
        let lamp = DVec3::new(8.0, 3.6, 8.0);
        let shape = TrueLightShape::Point { position: lamp, attenuation: Vec3::new(1.0, 0.0, 0.01) };
        match class(Class::Static) {
            Class::Static => gl.light(0, view, shape, Vec3::ONE),
            // Its reflection is no light of the world.
            _ => gl.place_light(0, view, shape, Vec3::ONE),
        }
        gl.enable(GL_LIGHTING);
        gl.bind(self.bricks);
        gl.draw_arrays(thing(class(Class::Static), 1), &self.walls, Attributes::LIT);
        for index in 0..BALLS {
            let angle = index as f64 * 1.3 + 0.5 * t;
            let height = 0.6 + 1.4 * (2.0 * t + index as f64).sin().abs();
            let place = DVec3::new(8.0 + 3.5 * angle.cos(), height, 8.0 + 3.5 * angle.sin());
            gl.modelview(view * DMat4::from_translation(place));
            gl.call_list(thing(class(Class::Movable), 100 + index), self.ball);
        }
        gl.disable(GL_LIGHTING);
        gl.modelview(view);
    }
}

impl super::Style for Mirror {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let view = walk(self.hall.centre(), self.hall.centre() * 0.7, f64::from(frame) / 110.0);
        let camera = TrueCamera { view, projection: perspective(70.0, 0.1, 60.0) };
        gl.begin_world(0, camera);
        gl.clear(GL_STENCIL_BUFFER_BIT);

        gl.enable(GL_STENCIL_TEST);
        gl.stencil(GL_ALWAYS, GL_REPLACE);
        gl.color_mask(false);
        gl.depth_mask(false);
        gl.draw(thing(Class::OtherView, 2), &self.floor, Attributes::TEXTURED);
        gl.color_mask(true);
        gl.depth_mask(true);

        gl.stencil(GL_EQUAL, GL_KEEP);
        gl.enable(GL_CULL_FACE);
        gl.call(id::glFrontFace, &[GL_CW.into()]);
        let upside_down = view * DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
        self.draw_room(gl, upside_down, t, |_| Class::OtherView);
        gl.call(id::glFrontFace, &[GL_CCW.into()]);
        gl.disable(GL_STENCIL_TEST);

        gl.modelview(view);
        gl.blend(Some((GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)));
        gl.bind(self.marble);
        gl.color([1.0, 1.0, 1.0, 0.65]);
        gl.draw(thing(Class::Translucent, 2), &self.floor, Attributes::TEXTURED);
        gl.color([1.0; 4]);
        gl.blend(None);
        self.draw_room(gl, view, t, |class| class);
        gl.disable(GL_CULL_FACE);
        draw_hud(gl, frame);
    }
}
