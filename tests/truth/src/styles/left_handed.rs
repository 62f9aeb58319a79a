//! Engines that keep to other conventions than OpenGL's: z goes away from the eye and w = +z, there is no far plane, and
//! the frustum is not about the middle of the window.

use afterglow_scene::Class;
use glam::{DMat4, DVec3, DVec4, Vec3};

use crate::client::{Attributes, Client, List, Texture, WINDOW, thing};
use crate::kit::{Hall, Picture, boxed, draw_hud, in_sight, sphere, walk};
use crate::truth::TrueCamera;

/// A building with things that swing.
pub struct LeftHanded {
    hall: Hall,
    shapes: [List; 2],
    walls: Texture,
    floors: Texture,
    is_mirrored: bool,
}

impl LeftHanded {
    /// Loads everything. A world whose own space is left-handed has a view that is a rotation; one of the other hand,
    /// `is_mirrored`, has a reflection in its view.
    pub fn begin(gl: &mut Client, is_mirrored: bool) -> LeftHanded {
        let mut hall = Hall::new([7, 6], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let slider = boxed(Vec3::new(-0.6, 0.0, -0.6), Vec3::new(0.6, 1.2, 0.6));
        LeftHanded {
            hall,
            shapes: [
                gl.list(&slider.colored([180, 190, 200, 255]), Attributes::COLORED),
                gl.list(&sphere(0.6, 8, 12).colored([210, 190, 170, 255]), Attributes::COLORED),
            ],
            walls: gl.texture(&Picture::bricks([0.5, 0.5, 0.4])),
            floors: gl.texture(&Picture::grain(61, [0.4, 0.45, 0.5], 0.1)),
            is_mirrored,
        }
    }

    /// Right-handed views look along -z: turned about y, they look along +z, and x goes to the left. Mirrored in z,
    /// they look along +z too, and x stays.
    fn view(&self, frame: u32) -> DMat4 {
        let view = walk(self.hall.centre(), self.hall.centre() * 0.6, f64::from(frame) / 95.0 + 0.35);
        match self.is_mirrored {
            true => DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0)) * view,
            false => DMat4::from_rotation_y(std::f64::consts::PI) * view,
        }
    }
}

/// w = +z, infinitely far, and wider to the right and downward than to the left and upward.
fn projection() -> DMat4 {
    let near = 0.15;
    let half = 0.62 * near;
    let wide = half * f64::from(WINDOW.0) / f64::from(WINDOW.1);
    let (left, right, bottom, top) = (-0.8 * wide, 1.2 * wide, -1.1 * half, 0.9 * half);
    DMat4::from_cols(
        DVec4::X * 2.0 * near / (right - left),
        DVec4::Y * 2.0 * near / (top - bottom),
        DVec4::new(-(right + left) / (right - left), -(top + bottom) / (top - bottom), 1.0, 1.0),
        DVec4::Z * -2.0 * near,
    )
}

impl super::Style for LeftHanded {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let camera = TrueCamera { view: self.view(frame), projection: projection() };
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw_arrays(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.walls);
        for index in 0..6u32 {
            let along = 2.0 * (1.2 * t + f64::from(index)).sin();
            let place = DVec3::new(4.0 + 4.0 * f64::from(index), 0.6, 12.0 + along);
            if in_sight(&camera, place, 1.5) {
                gl.modelview(camera.view * DMat4::from_translation(place));
                gl.call_list(thing(Class::Movable, 100 + u64::from(index)), self.shapes[index as usize % 2]);
            }
        }
        draw_hud(gl, frame);
    }
}
