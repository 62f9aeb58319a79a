//! Two players at one window: the same world in the upper and in the lower half, each by a camera of its own. The first
//! player's view, which is drawn first, counts as the main one.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Attributes, Client, List, Texture, WINDOW, thing};
use crate::kit::{Land, Mesh, Picture, boxed, draw_hud, in_sight, look_at, ring};
use crate::truth::{TrueCamera, TrueLightShape};

/// Land with the two players' carts.
pub struct SplitScreen {
    land: Land,
    body: List,
    wheel: List,
    grass: Texture,
    paint: Texture,
}

impl SplitScreen {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> SplitScreen {
        let land = Land::new(5, 1);
        gl.set_extent(land.extent());
        let mut body = Mesh::default();
        body.append(&boxed(Vec3::new(-0.7, 0.3, -1.2), Vec3::new(0.7, 0.8, 1.2)));
        body.append(&boxed(Vec3::new(-0.5, 0.8, -0.4), Vec3::new(0.5, 1.3, 0.7)));
        SplitScreen {
            land,
            body: gl.list(&body, Attributes::LIT),
            wheel: gl.list(&ring(0.3, 0.12, 12), Attributes::LIT),
            grass: gl.texture(&Picture::grain(99, [0.4, 0.46, 0.3], 0.1)),
            paint: gl.texture(&Picture::checker(2.0, [0.2, 0.3, 0.8], [0.85, 0.85, 0.8])),
        }
    }

    /// One player's half of the window; `class` is what things are there.
    fn draw_half(&self, gl: &mut Client, player: usize, t: f64, class: impl Fn(Class) -> Class) {
        let half = WINDOW.1 / 2;
        gl.viewport([0, half * (1 - player as i32), WINDOW.0, half]);
        let camera = camera(player, t);
        gl.projection(camera.projection);
        let shape = TrueLightShape::Directional { to_light: DVec3::new(0.4, 0.8, 0.2).normalize() };
        match player {
            0 => gl.light(0, camera.view, shape, Vec3::ONE),
            _ => gl.place_light(0, camera.view, shape, Vec3::ONE),
        }
        gl.modelview(camera.view);
        gl.bind(self.grass);
        for cell in self.land.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.draw_arrays(thing(class(Class::Static), cell.object), &cell.floors, Attributes::LIT);
        }
        gl.bind(self.paint);
        for cart in 0..2 {
            let place = course(cart, t);
            let object = 100 + 10 * cart as u64;
            gl.modelview(camera.view * place);
            gl.call_list(thing(class(Class::Movable), object), self.body);
            for (side, object) in [-0.8, 0.8].into_iter().zip(object + 1..) {
                let turn =
                    DMat4::from_rotation_x(-12.0 * t) * DMat4::from_rotation_y(std::f64::consts::FRAC_PI_2);
                gl.modelview(
                    camera.view * place * DMat4::from_translation(DVec3::new(side, 0.35, 0.0)) * turn,
                );
                gl.call_list(thing(class(Class::Movable), object), self.wheel);
            }
        }
    }
}

/// Where a cart is.
fn course(cart: usize, t: f64) -> DMat4 {
    let (radius, angle) = [(18.0, 0.5 * t), (22.0, 0.42 * t + 1.0)][cart];
    let place = DVec3::new(radius * angle.cos(), 0.0, -radius * angle.sin());
    let height = f64::from(Land::height(place.x as f32, place.z as f32));
    DMat4::from_translation(place + DVec3::Y * height) * DMat4::from_rotation_y(angle)
}

/// A camera that follows a player's cart loosely.
fn camera(player: usize, t: f64) -> TrueCamera {
    let cart = course(player, t);
    let eye = course(player, t - 0.4).transform_point3(DVec3::new(0.3 * t.sin(), 2.4, 4.0));
    let aspect = f64::from(WINDOW.0) / f64::from(WINDOW.1 / 2);
    TrueCamera {
        view: look_at(eye, cart.transform_point3(DVec3::new(0.0, 0.8, -2.0))),
        projection: glam::dcamera::rh::proj::opengl::perspective(0.9, aspect, 0.2, 120.0),
    }
}

impl super::Style for SplitScreen {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        gl.clear_color([0.6, 0.72, 0.9]);
        gl.begin_world(0, camera(0, t));
        gl.enable(GL_LIGHTING);
        self.draw_half(gl, 0, t, |class| class);
        self.draw_half(gl, 1, t, |_| Class::OtherView);
        gl.disable(GL_LIGHTING);
        gl.viewport([0, 0, WINDOW.0, WINDOW.1]);
        draw_hud(gl, frame);
    }
}
