//! A program that draws with what outlives a frame: textures, display lists, buffer objects.

use std::time::Duration;

use afterglow_api::constants::*;
use afterglow_engine::{Drawable, Engine, EngineOptions, OptionsSource, Port, ShareGroup, Surface};
use afterglow_gl::texture::{ImageDefinition, SubImage};
use afterglow_gl::{Context, Params, Pointer};
use afterglow_gpu::{Faults, GpuOptions};
use afterglow_render::Mode;

/// Width and height of what it draws to.
pub(crate) const SIDE: u32 = 64;
/// Names of what the program makes.
const TEXTURE: u32 = 7;
const LIST: u32 = 3;

/// What pictures depend on, and no frame on the one before.
pub(crate) fn options(mode: Mode, faults: &Faults) -> EngineOptions {
    let mut options = EngineOptions { mode: Some(mode), ..EngineOptions::default() };
    options.gpu = GpuOptions { faults: faults.clone(), ..GpuOptions::for_tests() };
    options.pathtrace.accumulate = false;
    options
}

/// A program that draws to a drawable of its own.
pub(crate) struct Program {
    gl: Context,
    pub(crate) drawable: Drawable,
    /// Dropped after the context.
    _group: ShareGroup,
    engine: Engine,
}

impl Drop for Program {
    /// A driver must not be torn down, at the end of the process, under a thread that uses it.
    fn drop(&mut self) {
        self.engine.stop(Duration::from_secs(60));
    }
}

impl Program {
    pub(crate) fn new(mode: Mode, faults: &Faults) -> Self {
        Self::on(Surface::None, mode, faults, false)
    }

    pub(crate) fn on(surface: Surface, mode: Mode, faults: &Faults, hud: bool) -> Self {
        Self::with(surface, EngineOptions { hud, ..options(mode, faults) }, None)
    }

    pub(crate) fn with(
        surface: Surface,
        options: EngineOptions,
        source: Option<Box<dyn OptionsSource>>,
    ) -> Self {
        let engine = Engine::start_with(options, source).unwrap();
        let group = engine.share_group();
        let port = Port::new(&group);
        let drawable = engine.drawable(surface, (SIDE, SIDE));
        port.bind(Some(drawable.clone()), Some(drawable.clone()));
        let mut gl = Context::new(Box::new(port), group.names());
        gl.set_drawable(SIDE, SIDE);
        let mut program = Self { gl, drawable, _group: group, engine };
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
    pub(crate) fn frame(&mut self) {
        let (width, height) = self.drawable.size();
        let gl = &mut self.gl;
        gl.set_drawable(width, height);
        gl.clear_color(0.2, 0.4, 0.6, 1.0);
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

    pub(crate) fn frames(&mut self, count: usize) {
        (0..count).for_each(|_| self.frame());
    }

    /// What it reads back: four bytes a pixel, the lowest row first.
    pub(crate) fn picture(&mut self) -> Vec<u8> {
        let mut pixels = vec![0; (SIDE * SIDE * 4) as usize];
        let side = SIDE as i32;
        self.gl.read_pixels(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, &mut pixels);
        pixels
    }
}
