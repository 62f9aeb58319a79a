//! Views beside the main one: before it, what a ball mirrors, drawn to the faces of a cube map by six small views; after
//! it, what lies behind, in a strip at the top of the window.

use afterglow_api::constants::*;
use afterglow_api::id;
use afterglow_scene::Class;
use glam::{DMat4, DVec3, Vec3};

use crate::client::{Arg, Attributes, Client, List, Texture, WINDOW, thing};
use crate::kit::{Hall, Picture, boxed, draw_hud, in_sight, perspective, sphere, walk};
use crate::truth::TrueCamera;

/// A building with a mirroring ball and crates that slide.
pub struct OtherViews {
    hall: Hall,
    ball: List,
    slider: List,
    walls: Texture,
    floors: Texture,
}

/// Side of a face of the cube map, pixels, and its texture's name, which no other texture has.
const SIDE: i32 = 64;
const CUBE: u32 = 500;
const SLIDERS: u32 = 5;

/// Direction and top of each face's view, in the order of their targets (specification 3.8.6).
const FACES: [(DVec3, DVec3); 6] = [
    (DVec3::X, DVec3::NEG_Y),
    (DVec3::NEG_X, DVec3::NEG_Y),
    (DVec3::Y, DVec3::Z),
    (DVec3::NEG_Y, DVec3::NEG_Z),
    (DVec3::Z, DVec3::NEG_Y),
    (DVec3::NEG_Z, DVec3::NEG_Y),
];

impl OtherViews {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> OtherViews {
        let mut hall = Hall::new([5, 5], 1);
        hall.bake();
        gl.set_extent(hall.extent());
        let slider = boxed(Vec3::new(-0.6, 0.0, -0.6), Vec3::new(0.6, 1.2, 0.6));
        let walls = gl.texture(&Picture::bricks([0.6, 0.45, 0.35]));
        let floors = gl.texture(&Picture::checker(2.0, [0.5, 0.5, 0.45], [0.3, 0.32, 0.3]));
        define_cube(gl);
        OtherViews {
            hall,
            ball: gl.list(&sphere(0.9, 14, 20), Attributes::LIT),
            slider: gl.list(&slider.colored([200, 180, 150, 255]), Attributes::COLORED),
            walls,
            floors,
        }
    }

    /// The building and its crates, seen by a camera; `class` is what its things are there.
    fn draw_room(&self, gl: &mut Client, camera: &TrueCamera, t: f64, class: impl Fn(Class) -> Class) {
        gl.projection(camera.projection);
        gl.modelview(camera.view);
        for cell in self.hall.cells.iter().filter(|cell| in_sight(camera, cell.centre, cell.radius)) {
            gl.bind(self.walls);
            gl.draw_arrays(thing(class(Class::Static), cell.object), &cell.walls, Attributes::COLORED);
            gl.bind(self.floors);
            gl.draw_arrays(thing(class(Class::Static), cell.object), &cell.floors, Attributes::COLORED);
        }
        gl.bind(self.walls);
        for index in 0..SLIDERS {
            let along = 3.0 * (0.8 * t + f64::from(index)).sin();
            let place = DVec3::new(10.0 + along, 0.0, 3.0 + 3.5 * f64::from(index));
            if in_sight(camera, place, 1.5) {
                gl.modelview(camera.view * DMat4::from_translation(place));
                gl.call_list(thing(class(Class::Movable), 100 + u64::from(index)), self.slider);
            }
        }
    }

    fn draw_faces(&self, gl: &mut Client, ball: DVec3, t: f64) {
        gl.viewport([0, 0, SIDE, SIDE]);
        let projection = glam::dcamera::rh::proj::opengl::perspective(90f64.to_radians(), 1.0, 0.1, 60.0);
        for ((ahead, up), face) in FACES.into_iter().zip(GL_TEXTURE_CUBE_MAP_POSITIVE_X..) {
            gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            let view = glam::dcamera::rh::view::look_at_mat4(ball, ball + ahead, up);
            self.draw_room(gl, &TrueCamera { view, projection }, t, |_| Class::OtherView);
            let (zero, side) = (Arg::Int(0), Arg::from(SIDE));
            let args = [face.into(), zero, zero, zero, zero, zero, side, side];
            gl.call(id::glCopyTexSubImage2D, &args);
        }
        gl.viewport([0, 0, WINDOW.0, WINDOW.1]);
    }

    /// The ball, textured by what is reflected from the eye's direction.
    fn draw_ball(&self, gl: &mut Client, modelview: DMat4) {
        let coordinates = [(GL_S, GL_TEXTURE_GEN_S), (GL_T, GL_TEXTURE_GEN_T), (GL_R, GL_TEXTURE_GEN_R)];
        gl.modelview(modelview);
        gl.disable(GL_TEXTURE_2D);
        gl.enable(GL_TEXTURE_CUBE_MAP);
        for (coordinate, generates) in coordinates {
            let mode = [coordinate.into(), GL_TEXTURE_GEN_MODE.into(), GL_REFLECTION_MAP.into()];
            gl.call(id::glTexGeni, &mode);
            gl.enable(generates);
        }
        gl.color([1.0; 4]);
        gl.call_list(thing(Class::Movable, 200), self.ball);
        for (_, generates) in coordinates {
            gl.disable(generates);
        }
        gl.disable(GL_TEXTURE_CUBE_MAP);
        gl.enable(GL_TEXTURE_2D);
    }

    fn draw_rear_view(&self, gl: &mut Client, front: &TrueCamera, t: f64) {
        let rect = [96, 184, 128, 48];
        gl.viewport(rect);
        gl.enable(GL_SCISSOR_TEST);
        gl.call(id::glScissor, &rect.map(Arg::from));
        gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        let aspect = f64::from(rect[2]) / f64::from(rect[3]);
        let projection = glam::dcamera::rh::proj::opengl::perspective(0.7, aspect, 0.1, 60.0);
        let view = DMat4::from_rotation_y(std::f64::consts::PI) * front.view;
        self.draw_room(gl, &TrueCamera { view, projection }, t, |_| Class::OtherView);
        gl.disable(GL_SCISSOR_TEST);
        gl.viewport([0, 0, WINDOW.0, WINDOW.1]);
    }
}

/// A cube map without content; it stays bound, as nothing else is bound to that target.
fn define_cube(gl: &mut Client) {
    gl.call(id::glBindTexture, &[GL_TEXTURE_CUBE_MAP.into(), CUBE.into()]);
    for name in [GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER] {
        gl.call(id::glTexParameteri, &[GL_TEXTURE_CUBE_MAP.into(), name.into(), GL_LINEAR.into()]);
    }
    for face in (GL_TEXTURE_CUBE_MAP_POSITIVE_X..).take(6) {
        let (zero, side) = (Arg::Int(0), Arg::from(SIDE));
        let shape = [face.into(), zero, GL_RGB8.into(), side, side, zero];
        let content = [GL_RGB.into(), GL_UNSIGNED_BYTE.into(), Arg::Handle(0)];
        gl.call(id::glTexImage2D, &[shape.as_slice(), content.as_slice()].concat());
    }
}

impl super::Style for OtherViews {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        let view = walk(self.hall.centre(), self.hall.centre() * 0.7, f64::from(frame) / 115.0 + 0.05);
        let camera = TrueCamera { view, projection: perspective(65.0, 0.1, 60.0) };
        let ball = DVec3::new(10.0 + t.sin(), 1.2, 10.0 + t.cos());
        gl.enable(GL_TEXTURE_2D);
        self.draw_faces(gl, ball, t);
        gl.begin_world(0, camera);
        self.hall.lights().into_iter().for_each(|light| gl.shine(light));
        self.draw_room(gl, &camera, t, |class| class);
        self.draw_ball(gl, view * DMat4::from_translation(ball) * DMat4::from_rotation_y(t));
        self.draw_rear_view(gl, &camera, t);
        draw_hud(gl, frame);
    }
}
