//! A dome under the rotation of the view alone, with more triangles than the small world that is seen of the ground.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Land, Picture, boxed, dome, draw_hud, in_sight, look_at, perspective};
use crate::truth::{TrueCamera, TrueLightShape};

/// Flat land under a dome.
pub struct SkyDome {
    land: Land,
    dome: List,
    house: List,
    grass: Texture,
    wall: Texture,
    clouds: Texture,
    is_solid: bool,
}

impl SkyDome {
    /// Loads everything. The dome is drawn without depth or, `is_solid`, as anything else, so large that all is in it.
    pub fn begin(gl: &mut Client, is_solid: bool) -> SkyDome {
        let land = Land::new(2, 1);
        gl.set_extent(land.extent());
        let sky = dome(60.0, [90, 130, 255], [235, 240, 255]);
        SkyDome {
            land,
            dome: gl.list(&sky, Attributes::COLORED),
            house: gl.list(&boxed(Vec3::new(-1.5, 0.0, -2.0), Vec3::new(1.5, 3.0, 2.0)), Attributes::LIT),
            grass: gl.texture(&Picture::grain(9, [0.35, 0.5, 0.3], 0.1)),
            wall: gl.texture(&Picture::bricks([0.7, 0.6, 0.5])),
            clouds: gl.texture(&Picture::clouds()),
            is_solid,
        }
    }
}

impl super::Style for SkyDome {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = DVec3::new(-10.0 + 6.0 * t, 2.8 + 0.4 * (2.0 * t).sin(), 12.0 - 3.0 * t);
        let ahead = DVec3::new((0.8 * t - 0.7).sin(), 0.05, -(0.8 * t - 0.7).cos());
        let camera =
            TrueCamera { view: look_at(eye, eye + ahead), projection: perspective(65.0, 0.2, 100.0) };
        gl.clear_color([0.85, 0.88, 0.95]);
        gl.begin_world(0, camera);
        let mut rotation = camera.view;
        rotation.w_axis = glam::DVec4::W;
        gl.modelview(rotation);
        if !self.is_solid {
            gl.depth_mask(false);
            gl.disable(GL_DEPTH_TEST);
        }
        gl.bind(self.clouds);
        gl.call_list(thing(Class::Sky, 500), self.dome);
        gl.enable(GL_DEPTH_TEST);
        gl.depth_mask(true);

        gl.enable(GL_LIGHTING);
        let to_light = DVec3::new(-0.3, 0.9, 0.4).normalize();
        gl.light(0, camera.view, TrueLightShape::Directional { to_light }, Vec3::ONE);
        gl.bind(self.grass);
        for cell in self.land.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::LIT);
        }
        gl.bind(self.wall);
        for (x, z, object) in [(-8.0_f32, -6.0_f32, 100), (4.0, -9.0, 101), (9.0, 3.0, 102)] {
            let place = Vec3::new(x, Land::height(x, z) - 0.4, z).as_dvec3();
            gl.modelview(camera.view * DMat4::from_translation(place));
            gl.call_list(thing(Class::Static, object), self.house);
        }
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
