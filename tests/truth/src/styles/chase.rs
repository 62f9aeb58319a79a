//! A race: the camera follows a car at a fixed distance, so the car, which has most of the triangles, and the sky keep
//! their matrices while the world moves. Its wheels turn, and another car drives ahead.

use std::f64::consts::FRAC_PI_2;

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{Affine3A, DMat4, DVec3, DVec4, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Land, Mesh, Picture, boxed, dome, draw_hud, in_sight, look_at, perspective, ring, sphere};
use crate::truth::{TrueCamera, TrueLightShape};

/// Land, cars and a sky.
pub struct Chase {
    land: Land,
    body: List,
    wheel: List,
    sky: List,
    grass: Texture,
    paint: Texture,
    clouds: Texture,
    in_pieces: bool,
}

/// The camera in the car's space: where it is, and what it looks at.
const BEHIND: [DVec3; 2] = [DVec3::new(0.0, 2.6, 7.0), DVec3::new(0.0, 0.8, -3.0)];

/// Wheels in the car's space.
const WHEELS: [DVec3; 4] = [
    DVec3::new(-1.0, 0.45, -1.4),
    DVec3::new(1.0, 0.45, -1.4),
    DVec3::new(-1.0, 0.45, 1.4),
    DVec3::new(1.0, 0.45, 1.4),
];

impl Chase {
    /// Loads everything. The ground is in world coordinates, or `in_pieces` that each have a matrix: then nothing is drawn
    /// under the view itself.
    pub fn begin(gl: &mut Client, in_pieces: bool) -> Chase {
        let land = Land::new(5, 1);
        gl.set_extent(land.extent());
        Chase {
            land,
            body: gl.list(&body(), Attributes::LIT),
            wheel: gl.list(&ring(0.3, 0.15, 14), Attributes::LIT),
            sky: gl.list(&dome(60.0, [100, 150, 250], [230, 235, 250]), Attributes::COLORED),
            grass: gl.texture(&Picture::grain(17, [0.42, 0.48, 0.3], 0.1)),
            paint: gl.texture(&Picture::checker(2.0, [0.8, 0.1, 0.1], [0.85, 0.85, 0.8])),
            clouds: gl.texture(&Picture::clouds()),
            in_pieces,
        }
    }

    fn draw_car(&self, gl: &mut Client, view: DMat4, car: DMat4, rolled: f64, first_object: u64) {
        gl.modelview(view * car);
        gl.call_list(thing(Class::Movable, first_object), self.body);
        for (place, object) in WHEELS.into_iter().zip(first_object + 1..) {
            let turn = DMat4::from_rotation_x(-rolled / 0.45) * DMat4::from_rotation_y(FRAC_PI_2);
            gl.modelview(view * car * DMat4::from_translation(place) * turn);
            gl.call_list(thing(Class::Movable, object), self.wheel);
        }
    }
}

/// A car without wheels: rounded, with many triangles.
fn body() -> Mesh {
    let mut mesh = boxed(Vec3::new(-0.9, 0.4, -2.0), Vec3::new(0.9, 0.9, 2.0));
    let cabin = Affine3A::from_translation(Vec3::new(0.0, 0.9, 0.2));
    let squeezed = Affine3A::from_scale(Vec3::new(0.8, 0.6, 1.2));
    mesh.append(&sphere(1.0, 16, 24).transformed(cabin * squeezed));
    let nose = Affine3A::from_translation(Vec3::new(0.0, 0.65, -2.0));
    mesh.append(&sphere(1.0, 16, 24).transformed(nose * Affine3A::from_scale(Vec3::new(0.9, 0.25, 0.6))));
    mesh
}

/// Where a car is after so many seconds: on a round course, along the ground's height.
fn course(t: f64) -> DMat4 {
    let (radius, angle) = (20.0, 0.45 * t);
    let place = DVec3::new(radius * angle.cos(), 0.0, -radius * angle.sin());
    let height = f64::from(Land::height(place.x as f32, place.z as f32));
    DMat4::from_translation(place + DVec3::Y * height) * DMat4::from_rotation_y(angle)
}

impl super::Style for Chase {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let car = course(t);
        let view = look_at(BEHIND[0], BEHIND[1]) * car.inverse();
        let camera = TrueCamera { view, projection: perspective(60.0, 0.3, 120.0) };
        gl.begin_world(0, camera);
        // The sky hangs on the car, and does not turn.
        gl.modelview(DMat4 { w_axis: DVec4::W, ..view });
        gl.depth_mask(false);
        gl.disable(GL_DEPTH_TEST);
        gl.bind(self.clouds);
        gl.call_list(thing(Class::Sky, 500), self.sky);
        gl.enable(GL_DEPTH_TEST);
        gl.depth_mask(true);

        gl.enable(GL_LIGHTING);
        let to_light = DVec3::new(0.5, 0.8, -0.2).normalize();
        gl.light(0, view, TrueLightShape::Directional { to_light }, Vec3::ONE);
        gl.bind(self.grass);
        for cell in self.land.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            let origin = if self.in_pieces { cell.centre } else { DVec3::ZERO };
            let mesh = cell.floors.transformed(Affine3A::from_translation(-origin.as_vec3()));
            gl.modelview(view * DMat4::from_translation(origin));
            gl.draw_arrays(thing(Class::Static, cell.object), &mesh, Attributes::LIT);
        }
        gl.bind(self.paint);
        self.draw_car(gl, view, car, 9.0 * t, 600);
        self.draw_car(gl, view, course(1.1 * t + 1.2), 9.9 * t, 610);
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
