//! A level ends: a screen while the next one is loaded, then another building with other textures and another camera.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{DMat4, Vec2, Vec3};

use crate::client::{Attributes, Client, Texture, WINDOW, thing};
use crate::kit::{Hall, Mesh, Picture, draw_hud, in_sight, ortho, perspective, walk};
use crate::truth::TrueCamera;

/// Two buildings, one after the other.
pub struct LevelChange {
    level: Level,
    title: Texture,
}

struct Level {
    number: u32,
    hall: Hall,
    walls: Texture,
    floors: Texture,
}

/// First frame of the screen between the levels, and of the second level.
const LOADING: u32 = 26;
const SECOND: u32 = 30;

impl LevelChange {
    /// Loads the first level.
    pub fn begin(gl: &mut Client) -> LevelChange {
        LevelChange { level: Level::load(gl, 0), title: gl.texture(&Picture::clouds()) }
    }
}

impl Level {
    fn load(gl: &mut Client, number: u32) -> Level {
        let counts = if number == 0 { [5, 8] } else { [8, 8] };
        let mut hall = Hall::new(counts, 1 + 1000 * u64::from(number));
        hall.bake();
        gl.set_extent(hall.extent());
        let color = if number == 0 { [0.6, 0.4, 0.3] } else { [0.3, 0.45, 0.6] };
        let floors = Picture::grain(20 + u64::from(number), color.map(|c| 0.8 * c), 0.1);
        Level { number, hall, walls: gl.texture(&Picture::bricks(color)), floors: gl.texture(&floors) }
    }

    fn draw(&self, gl: &mut Client, frame: u32) {
        let start = if self.number == 0 { 0.0 } else { 0.55 };
        let t = f64::from(frame) / 80.0 + start;
        let view = walk(self.hall.centre(), self.hall.centre() * 0.6, t);
        let camera = TrueCamera { view, projection: perspective(70.0, 0.1, 90.0) };
        gl.begin_world(self.number, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        for cell in self.hall.cells.iter().filter(|cell| in_sight(&camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw(thing(Class::Static, cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw(thing(Class::Static, cell.object), &cell.floors, Attributes::COLORED);
        }
        draw_hud(gl, frame);
    }
}

impl super::Style for LevelChange {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        match frame {
            LOADING..SECOND => draw_title(gl, self.title),
            _ => {
                if frame == SECOND {
                    self.level = Level::load(gl, 1);
                }
                self.level.draw(gl, frame);
            }
        }
    }
}

/// A picture over the whole window.
fn draw_title(gl: &mut Client, title: Texture) {
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.projection(ortho());
    gl.modelview(DMat4::IDENTITY);
    gl.disable(GL_DEPTH_TEST);
    gl.enable(GL_TEXTURE_2D);
    gl.bind(title);
    let mut mesh = Mesh::default();
    let size = [Vec3::X * WINDOW.0 as f32, Vec3::Y * WINDOW.1 as f32];
    mesh.parallelogram(Vec3::ZERO, size, 1, Vec2::ONE);
    gl.draw(thing(Class::Interface, 800), &mesh, Attributes::TEXTURED);
    gl.enable(GL_DEPTH_TEST);
}
