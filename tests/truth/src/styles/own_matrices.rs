//! An engine in which all things have matrices of their own, also those that never move: ground in pieces about their
//! own origins, crates, and, of what moves, coins that spin and balls that roll. Lit by a sun.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{Affine3A, DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, Thing, thing};
use crate::kit::{Land, Picture, Random, boxed, draw_hud, in_sight, look_at, perspective, ring, sphere};
use crate::truth::{TrueCamera, TrueLightShape};

/// A thing that stands where it is put.
struct Placed {
    thing: Thing,
    place: DVec3,
    turn: f64,
    radius: f64,
    list: List,
    texture: usize,
}

/// Hills with things on them.
pub struct OwnMatrices {
    still: Vec<Placed>,
    coins: Vec<Placed>,
    balls: Vec<Placed>,
    textures: [Texture; 4],
}

const GRASS: usize = 0;
const WOOD: usize = 1;
const GOLD: usize = 2;
const BALL: usize = 3;

impl OwnMatrices {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> OwnMatrices {
        let land = Land::new(5, 1);
        gl.set_extent(land.extent());
        let ground = |gl: &mut Client| -> Vec<Placed> {
            let cells = land.cells.iter();
            let piece = |cell: &crate::kit::Cell, gl: &mut Client| {
                let back = Affine3A::from_translation(-cell.centre.as_vec3());
                let list = gl.list(&cell.floors.transformed(back), Attributes::LIT);
                let thing = thing(Class::Static, cell.object);
                Placed { thing, place: cell.centre, turn: 0.0, radius: cell.radius, list, texture: GRASS }
            };
            cells.map(|cell| piece(cell, gl)).collect()
        };
        let mut still = ground(gl);
        let mut random = Random::new(11);
        let mut scatter = |list, class, first, count: u64, texture, above: f64| -> Vec<Placed> {
            let place = |object| {
                let (x, z) = (random.between(-22.0, 22.0), random.between(-22.0, 22.0));
                let place = DVec3::new(x.into(), f64::from(Land::height(x, z)) + above, z.into());
                let turn = random.between(0.0, 6.0).into();
                Placed { thing: thing(class, object), place, turn, radius: 2.0, list, texture }
            };
            (first..first + count).map(place).collect()
        };
        let crate_list = gl.list(&boxed(Vec3::splat(-0.8), Vec3::splat(0.8)), Attributes::LIT);
        let coin_list = gl.list(&ring(0.5, 0.14, 12), Attributes::LIT);
        let ball_list = gl.list(&sphere(0.7, 8, 12), Attributes::LIT);
        still.extend(scatter(crate_list, Class::Static, 100, 14, WOOD, 0.5));
        let coins = scatter(coin_list, Class::Movable, 200, 12, GOLD, 1.2);
        let balls = scatter(ball_list, Class::Movable, 300, 5, BALL, 0.6);
        let textures = [
            gl.texture(&Picture::grain(1, [0.3, 0.45, 0.2], 0.1)),
            gl.texture(&Picture::bricks([0.55, 0.4, 0.2])),
            gl.texture(&Picture::grain(2, [0.9, 0.75, 0.2], 0.05)),
            gl.texture(&Picture::checker(2.0, [0.9, 0.9, 0.9], [0.8, 0.15, 0.1])),
        ];
        OwnMatrices { still, coins, balls, textures }
    }

    fn place(&self, gl: &mut Client, camera: &TrueCamera, placed: &Placed, model: DMat4) {
        if in_sight(camera, model.col(3).truncate(), placed.radius) {
            gl.bind(self.textures[placed.texture]);
            gl.modelview(camera.view * model);
            gl.call_list(placed.thing, placed.list);
        }
    }
}

impl super::Style for OwnMatrices {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = DVec3::new(16.0 * (0.5 * t).cos(), 6.0 + 0.5 * t.sin(), 16.0 * (0.5 * t).sin());
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(2.0 * t.sin(), 0.0, 0.0)),
            projection: perspective(60.0, 0.2, 150.0),
        };
        gl.clear_color([0.5, 0.65, 0.9]);
        gl.begin_world(0, camera);
        gl.enable(GL_LIGHTING);
        let to_light = DVec3::new(0.4, 0.8, 0.3).normalize();
        gl.light(0, camera.view, TrueLightShape::Directional { to_light }, Vec3::new(1.0, 0.95, 0.85));
        for placed in &self.still {
            let model = DMat4::from_translation(placed.place) * DMat4::from_rotation_y(placed.turn);
            self.place(gl, &camera, placed, model);
        }
        for placed in &self.coins {
            let turn = DMat4::from_rotation_y(placed.turn + 3.0 * t);
            self.place(gl, &camera, placed, DMat4::from_translation(placed.place) * turn);
        }
        for placed in &self.balls {
            let along = 2.0 * (t + placed.turn).sin();
            let roll = DMat4::from_rotation_z(-along / 0.7);
            let model = DMat4::from_translation(placed.place + DVec3::X * along) * roll;
            self.place(gl, &camera, placed, model);
        }
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
