//! Shadows as things drawn once more, flattened onto the floor and dark; once in the stencil, so that none is darker
//! where two overlap.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, DVec4, Vec2, Vec3};

use crate::client::{Attributes, Client, List, Texture, thing};
use crate::kit::{Mesh, Picture, boxed, draw_hud, look_at, perspective, ring, sphere};
use crate::truth::{TrueCamera, TrueLightShape};

/// A floor with things over it.
pub struct PlanarShadows {
    floor: List,
    shapes: [List; 3],
    boards: Texture,
    paint: Texture,
}

/// Where the lamp is, world space.
const LAMP: DVec3 = DVec3::new(3.0, 8.0, 2.0);
/// Height of the shadows' plane, just over the floor.
const PLANE: f64 = 0.01;

impl PlanarShadows {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> PlanarShadows {
        gl.set_extent(28.0);
        let mut floor = Mesh::default();
        let corner = Vec3::new(-10.0, 0.0, -10.0);
        floor.parallelogram(corner, [Vec3::Z * 20.0, Vec3::X * 20.0], 12, Vec2::splat(6.0));
        floor.parallelogram(corner, [Vec3::X * 20.0, Vec3::Y * 4.0], 8, Vec2::new(6.0, 2.0));
        PlanarShadows {
            floor: gl.list(&floor, Attributes::LIT),
            shapes: [
                gl.list(&sphere(0.7, 8, 12), Attributes::LIT),
                gl.list(&boxed(Vec3::splat(-0.6), Vec3::splat(0.6)), Attributes::LIT),
                gl.list(&ring(0.7, 0.25, 12), Attributes::LIT),
            ],
            boards: gl.texture(&Picture::bricks([0.7, 0.55, 0.35])),
            paint: gl.texture(&Picture::checker(2.0, [0.8, 0.8, 0.3], [0.3, 0.5, 0.8])),
        }
    }

    /// Calls for each thing that moves with its object, its list and its matrix.
    fn each_shape(&self, t: f64, mut draw: impl FnMut(u64, List, DMat4)) {
        for (index, list) in self.shapes.iter().cycle().take(9).enumerate() {
            let angle = 0.7 * index as f64 + 0.4 * t;
            let radius = 2.0 + 0.5 * index as f64;
            let height = 1.2 + 0.4 * (2.0 * t + index as f64).sin();
            let place = DVec3::new(radius * angle.cos(), height, radius * angle.sin());
            let turn = DMat4::from_rotation_y(2.0 * t) * DMat4::from_rotation_x(t);
            draw(100 + index as u64, *list, DMat4::from_translation(place) * turn);
        }
    }
}

/// Projects from the lamp to the plane (Blinn, *Me and My (Fake) Shadow*, 1988).
fn flattening() -> DMat4 {
    let plane = DVec4::new(0.0, 1.0, 0.0, -PLANE);
    let lamp = LAMP.extend(1.0);
    let outer = DMat4::from_cols(lamp * plane.x, lamp * plane.y, lamp * plane.z, lamp * plane.w);
    DMat4::from_diagonal(DVec4::splat(plane.dot(lamp))) - outer
}

impl super::Style for PlanarShadows {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let eye = DVec3::new(9.0 * (0.3 * t).sin(), 5.0 + 0.4 * t.sin(), 9.0 * (0.3 * t).cos());
        let camera = TrueCamera {
            view: look_at(eye, DVec3::new(0.0, 0.5, 0.0)),
            projection: perspective(60.0, 0.2, 60.0),
        };
        gl.clear_color([0.3, 0.35, 0.4]);
        gl.begin_world(0, camera);
        gl.clear(GL_STENCIL_BUFFER_BIT);
        gl.enable(GL_LIGHTING);
        let shape = TrueLightShape::Point { position: LAMP, attenuation: Vec3::X };
        gl.light(0, camera.view, shape, Vec3::ONE);
        gl.bind(self.boards);
        gl.call_list(thing(Class::Static, 1), self.floor);

        gl.disable(GL_LIGHTING);
        gl.disable(GL_TEXTURE_2D);
        gl.blend(Some((GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)));
        gl.enable(GL_STENCIL_TEST);
        gl.stencil(GL_NOTEQUAL, GL_REPLACE);
        gl.depth_mask(false);
        gl.color([0.0, 0.0, 0.0, 0.5]);
        self.each_shape(t, |object, list, model| {
            gl.modelview(camera.view * flattening() * model);
            gl.call_list(thing(Class::Dropped, object), list);
        });
        gl.color([1.0; 4]);
        gl.depth_mask(true);
        gl.disable(GL_STENCIL_TEST);
        gl.blend(None);

        gl.enable(GL_TEXTURE_2D);
        gl.enable(GL_LIGHTING);
        gl.bind(self.paint);
        self.each_shape(t, |object, list, model| {
            gl.modelview(camera.view * model);
            gl.call_list(thing(Class::Movable, object), list);
        });
        gl.disable(GL_LIGHTING);
        draw_hud(gl, frame);
    }
}
