//! A device that is lost, and one without memory enough: what a program sees of it.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use afterglow_api::constants::*;
use afterglow_engine::{Engine, EngineOptions, Port, ShareGroup, Surface};
use afterglow_gl::backend::Backend;
use afterglow_gl::texture::{ImageDefinition, SubImage};
use afterglow_gl::{Context, Params, Pointer};
use afterglow_gpu::{Faults, GpuOptions};
use afterglow_render::Mode;

const SIDE: u32 = 64;
/// Frames that are lost with a device, at most: the one that fails, two that wait, and the one that is begun.
const LOST_FRAMES: usize = 4;
/// Names of what the program makes.
const TEXTURE: u32 = 7;
const LIST: u32 = 3;

/// A program that draws to a drawable of its own.
struct Program {
    gl: Context,
    /// Dropped after the context.
    _group: ShareGroup,
    _engine: Engine,
}

impl Program {
    fn new(mode: Mode, faults: Faults) -> Self {
        let mut options = EngineOptions { mode, ..EngineOptions::default() };
        options.gpu = GpuOptions { faults, ..GpuOptions::for_tests() };
        options.pathtrace.accumulate = false;
        let engine = Engine::start(options).unwrap();
        let group = engine.share_group();
        let port = Port::new(&group);
        let drawable = engine.drawable(Surface::None, (SIDE, SIDE));
        port.bind(Some(drawable.clone()), Some(drawable));
        let mut gl = Context::new(Box::new(port) as Box<dyn Backend>, group.names());
        gl.set_drawable(SIDE, SIDE);
        let mut program = Self { gl, _group: group, _engine: engine };
        program.load();
        program
    }

    /// Makes a texture, changed in part later, a display list and a buffer object.
    fn load(&mut self) {
        let gl = &mut self.gl;
        gl.bind_texture(GL_TEXTURE_2D, TEXTURE);
        let linear = Params::Ints(&[GL_LINEAR_MIPMAP_LINEAR as i32]);
        gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, linear);
        gl.tex_parameter(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, Params::Ints(&[1]));
        let texels: Vec<u8> = (0..8 * 8 * 4).map(|i| (i * 37 % 256) as u8).collect();
        let definition = ImageDefinition { level: 0, internal_format: GL_RGB, size: [8, 8, 1], border: 0 };
        gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&texels));
        self.frame();
        let gl = &mut self.gl;
        let part = SubImage { level: 0, offset: [2, 3, 0], size: [4, 4, 1] };
        gl.tex_sub_image((GL_TEXTURE_2D, 2), part, (GL_RGBA, GL_UNSIGNED_BYTE), &[200; 64]);
        gl.new_list(LIST, GL_COMPILE);
        gl.begin(GL_QUADS);
        gl.normal([0.0, 1.0, 0.0]);
        for [x, z] in [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
            gl.tex_coord([x * 2.0, z * 2.0, 0.0, 1.0]);
            gl.vertex([x * 3.0, 0.0, z * 3.0, 1.0]);
        }
        gl.end();
        gl.end_list();
        gl.bind_buffer(GL_ARRAY_BUFFER, 5);
        let corners: [f32; 9] = [-0.9, 0.5, 0.0, -0.5, 0.5, 0.0, -0.7, 0.9, 0.0];
        let bytes: Vec<u8> = corners.iter().flat_map(|value| value.to_le_bytes()).collect();
        gl.buffer_data(GL_ARRAY_BUFFER, bytes.len() as isize, Some(&bytes), GL_STATIC_DRAW);
        gl.vertex_pointer(3, GL_FLOAT, 0, Pointer::Offset(0));
        gl.enable_client_state(GL_VERTEX_ARRAY);
    }

    /// A textured floor from the list, lit, and a triangle of the buffer before it.
    fn frame(&mut self) {
        let gl = &mut self.gl;
        gl.clear_color(0.1, 0.2, 0.3, 1.0);
        gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.matrix_mode(GL_PROJECTION);
        gl.load_identity();
        gl.frustum(-0.8, 0.8, -0.8, 0.8, 1.0, 50.0);
        gl.matrix_mode(GL_MODELVIEW);
        gl.load_identity();
        gl.translate(0.0, -0.5, -6.0);
        gl.rotate(35.0, 1.0, 0.0, 0.0);
        for capability in [GL_LIGHTING, GL_LIGHT0, GL_DEPTH_TEST, GL_TEXTURE_2D] {
            gl.enable(capability);
        }
        gl.light(GL_LIGHT0, GL_POSITION, Params::Floats(&[0.0, 5.0, 0.0, 1.0]));
        gl.call_list(LIST);
        for capability in [GL_LIGHTING, GL_DEPTH_TEST, GL_TEXTURE_2D] {
            gl.disable(capability);
        }
        gl.matrix_mode(GL_PROJECTION);
        gl.load_identity();
        gl.matrix_mode(GL_MODELVIEW);
        gl.load_identity();
        gl.color([1.0, 0.5, 0.0, 1.0]);
        gl.draw_arrays(GL_TRIANGLES, 0, 3);
        gl.swap_buffers();
    }

    fn frames(&mut self, count: usize) {
        (0..count).for_each(|_| self.frame());
    }

    fn picture(&mut self) -> Vec<u8> {
        let mut pixels = vec![0; (SIDE * SIDE * 4) as usize];
        let side = SIDE as i32;
        self.gl.read_pixels(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, &mut pixels);
        pixels
    }
}

fn lost_at(losses: &[u64]) -> Faults {
    let mut faults = Faults::default();
    faults.losses = losses.to_vec();
    faults
}

/// What is shown after so many frames where nothing fails.
fn undisturbed(mode: Mode, frames: usize) -> Vec<u8> {
    let mut program = Program::new(mode, Faults::default());
    program.frames(frames);
    let picture = program.picture();
    let distinct: std::collections::HashSet<_> = picture.chunks(4).collect();
    assert!(distinct.len() > 100, "there is little to see: {} colours", distinct.len());
    picture
}

#[test]
fn the_picture_comes_back_after_a_loss() {
    let expected = undisturbed(Mode::Raster, 3);
    // The first submissions make the renderer.
    for submission in [1, 2, 3, 4, 5, 6, 7, 9] {
        let faults = lost_at(&[submission]);
        let mut program = Program::new(Mode::Raster, faults.clone());
        program.frames(8 + LOST_FRAMES);
        assert!(program.picture() == expected, "lost at submission {submission}");
        program.frame();
        assert!(program.picture() == expected, "lost at submission {submission}, a frame later");
        assert!(faults.all_struck());
    }
}

#[test]
fn a_question_to_a_lost_device_is_answered() {
    let faults = lost_at(&[9]);
    let mut program = Program::new(Mode::Raster, faults.clone());
    let pictures: Vec<_> = (0..12)
        .map(|_| {
            program.frame();
            program.picture()
        })
        .collect();
    let last = pictures.last().unwrap();
    assert!(*last == undisturbed(Mode::Raster, 3));
    assert!(pictures.iter().filter(|picture| *picture != last).count() <= LOST_FRAMES);
    assert!(faults.all_struck());
}

#[test]
fn a_traced_picture_comes_back_too() {
    let faults = lost_at(&[8]);
    let mut program = Program::new(Mode::Pathtrace, faults.clone());
    program.frames(8 + LOST_FRAMES);
    assert!(program.picture() == undisturbed(Mode::Pathtrace, 8));
    assert!(faults.all_struck());
}

#[test]
fn a_device_that_is_lost_again_and_again_is_given_up() {
    let losses: Vec<u64> = (0..100).map(|index| 10 + index * 10).collect();
    let mut program = Program::new(Mode::Raster, lost_at(&losses));
    program.frames(100);
    assert!(program.picture().iter().all(|byte| *byte == 0));
    program.frames(10);
}

#[test]
fn frames_are_rasterized_where_memory_does_not_do_for_rays() {
    // Enough for the first buffers of frames and ranges, not for meshes that rays meet.
    let mut faults = Faults::default();
    faults.memory = Some(24 << 20);
    let mut program = Program::new(Mode::Pathtrace, faults);
    let expected = undisturbed(Mode::Raster, 3);
    assert!(expected != undisturbed(Mode::Pathtrace, 3));
    for _ in 0..5 {
        // The very frame that finds it out included.
        program.frame();
        assert!(program.picture() == expected);
    }
}
