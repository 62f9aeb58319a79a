//! Pictures that the program turns to the camera: trees that are cut out, smoke that is blended, sparks that are added.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec2, Vec3};

use crate::client::{Attributes, Client, Texture, thing};
use crate::kit::{Land, Mesh, Picture, Random, draw_hud, in_sight, look_at, perspective};
use crate::truth::TrueCamera;

/// Hills with trees and a fire.
pub struct Billboards {
    land: Land,
    trees: Vec<(Vec3, f32)>,
    grass: Texture,
    tree: Texture,
    smoke: Texture,
    spark: Texture,
}

const PUFFS: u32 = 14;
const SPARKS: u32 = 20;

impl Billboards {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> Billboards {
        let land = Land::new(4, 1);
        gl.set_extent(land.extent());
        let mut random = Random::new(21);
        let mut tree = || {
            let (x, z) = (random.between(-28.0, 28.0), random.between(-28.0, 28.0));
            (Vec3::new(x, Land::height(x, z) - 0.2, z), random.between(3.0, 6.0))
        };
        let trees = (0..60).map(|_| tree()).filter(|(place, _)| place.length() > 7.0).collect();
        Billboards {
            land,
            trees,
            grass: gl.texture(&Picture::grain(6, [0.4, 0.45, 0.22], 0.1)),
            tree: gl.texture(&Picture::tree()),
            smoke: gl.texture(&Picture::glow([0.5, 0.5, 0.52])),
            spark: gl.texture(&Picture::glow([1.0, 0.6, 0.2])),
        }
    }
}

/// A picture about the middle of its lower edge or, if it floats, about its middle.
fn facing(view: DMat4, place: Vec3, size: Vec2, floats: bool) -> Mesh {
    let right = view.row(0).truncate().as_vec3();
    let up = if floats { view.row(1).truncate().as_vec3() } else { Vec3::Y };
    let right = if floats { right } else { (right * Vec3::new(1.0, 0.0, 1.0)).normalize() };
    let corner = place - right * size.x / 2.0 - if floats { up * size.y / 2.0 } else { Vec3::ZERO };
    let mut mesh = Mesh::default();
    mesh.parallelogram(corner, [right * size.x, up * size.y], 1, Vec2::ONE);
    mesh
}

impl super::Style for Billboards {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = DVec3::new(14.0 * (0.5 * t + 1.0).cos(), 3.2, 14.0 * (0.5 * t + 1.0).sin());
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(0.0, 2.0, 1.5 * t.sin())),
            projection: perspective(60.0, 0.2, 120.0),
        };
        gl.clear_color([0.65, 0.7, 0.75]);
        gl.begin_world(0, camera);
        gl.bind(self.grass);
        for cell in self.land.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.draw(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.color([1.0; 4]);
        gl.bind(self.tree);
        gl.alpha_test(Some(0.5));
        for ((place, height), object) in self.trees.iter().zip(100..) {
            if in_sight(&camera, place.as_dvec3(), f64::from(*height)) {
                let mesh = facing(camera.view, *place, Vec2::new(0.7, 1.0) * *height, false);
                gl.draw(thing(Class::Dynamic, object), &mesh, Attributes::TEXTURED);
            }
        }
        gl.alpha_test(None);
        self.fire(gl, &camera, t as f32);
        draw_hud(gl, frame);
    }
}

impl Billboards {
    /// Smoke that rises, then sparks.
    fn fire(&self, gl: &mut Client, camera: &TrueCamera, t: f32) {
        gl.depth_mask(false);
        gl.bind(self.smoke);
        gl.blend(Some((GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)));
        for puff in 0..PUFFS {
            let age = (0.5 * t + puff as f32 / PUFFS as f32).fract();
            let place = Vec3::new(0.8 * (puff as f32).sin() * age, 0.5 + 5.0 * age, 0.6 * age);
            let mesh = facing(camera.view, place, Vec2::splat(0.8 + 2.0 * age), true);
            gl.draw(thing(Class::Translucent, 500), &mesh, Attributes::TEXTURED);
        }
        gl.bind(self.spark);
        gl.blend(Some((GL_SRC_ALPHA, GL_ONE)));
        for spark in 0..SPARKS {
            let age = (1.3 * t + 0.37 * spark as f32).fract();
            let angle = 2.4 * spark as f32;
            let place = Vec3::new(angle.cos() * age, 0.4 + 2.0 * age, angle.sin() * age);
            let mesh = facing(camera.view, place, Vec2::splat(0.5 * (1.0 - age) + 0.1), true);
            gl.draw(thing(Class::Translucent, 501), &mesh, Attributes::TEXTURED);
        }
        gl.blend(None);
        gl.depth_mask(true);
    }
}
