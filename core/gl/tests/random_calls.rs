//! Random sequences of calls, legal and illegal: nothing panics, and every frame is sound.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

use std::sync::{Arc, Mutex};

use afterglow_api::constants::*;
use afterglow_gl::backend::{Backend, End, Reply, Request};
use afterglow_gl::frame::{Frame, Operation, VertexSource};
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params, Pointer, SharedNames};
use proptest::prelude::*;

/// Checks that every draw names what is there.
#[derive(Clone, Default)]
struct Checker(Arc<Mutex<Vec<String>>>);

impl Checker {
    fn check(&self, frame: &Frame) {
        for (operation, draw) in frame.draws() {
            let tables = [
                (draw.fixed, frame.fixed.len()),
                (draw.viewport, frame.viewports.len()),
                (draw.bindings, frame.bindings.len()),
                (draw.transform, frame.transforms.len()),
                (draw.lights, frame.lights.len()),
                (draw.material, frame.materials.len()),
                (draw.environment, frame.environments.len()),
                (draw.texgen, frame.texgens.len()),
                (draw.texture_matrices, frame.texture_matrices.len()),
                (draw.clip_planes, frame.clip_planes.len()),
                (draw.current, frame.current.len()),
            ];
            let (words, indices) = frame.geometry(draw);
            let vertices = match draw.source {
                VertexSource::Arena { vertices, .. } => vertices,
                VertexSource::Retained { .. } => (words.len() / draw.layout.stride()) as u32,
            };
            let sound = tables.iter().all(|(id, len)| (*id as usize) < *len)
                && indices.iter().all(|index| *index < vertices)
                && words.len() == vertices as usize * draw.layout.stride();
            if !sound {
                self.0.lock().unwrap().push(format!("operation {operation}: {draw:?}"));
            }
        }
        for operation in &frame.operations {
            if let Operation::Pixels(pixels) = operation
                && (pixels.current as usize >= frame.current.len()
                    || pixels.fixed as usize >= frame.fixed.len())
            {
                self.0.lock().unwrap().push("pixels name what is not there".into());
            }
        }
    }
}

impl Backend for Checker {
    fn submit(&mut self, frame: Frame, _: End) {
        self.check(&frame);
    }

    fn answer(&mut self, so_far: Frame, _: Request) -> Reply {
        self.check(&so_far);
        Reply::Unavailable
    }
}

#[derive(Debug, Clone)]
struct Call {
    which: u8,
    name: u32,
    float: f32,
    int: i32,
}

/// Enumerants that many commands take, and some that none does.
const NAMES: [u32; 36] = [
    GL_TEXTURE_2D,
    GL_LIGHTING,
    GL_BLEND,
    GL_DEPTH_TEST,
    GL_LIGHT0,
    GL_COLOR_MATERIAL,
    GL_FRONT,
    GL_BACK,
    GL_FRONT_AND_BACK,
    GL_AMBIENT,
    GL_DIFFUSE,
    GL_POSITION,
    GL_SHININESS,
    GL_MODELVIEW,
    GL_PROJECTION,
    GL_TEXTURE,
    GL_LINEAR,
    GL_NEAREST,
    GL_REPEAT,
    GL_TRIANGLES,
    GL_QUADS,
    GL_POLYGON,
    GL_LINE_LOOP,
    GL_POINTS,
    GL_TRIANGLE_STRIP,
    GL_RGBA,
    GL_UNSIGNED_BYTE,
    GL_VERTEX_ARRAY,
    GL_COLOR_ARRAY,
    GL_COMPILE,
    GL_COMPILE_AND_EXECUTE,
    GL_LINE,
    GL_FILL,
    GL_FLOAT,
    GL_ARRAY_BUFFER,
    0xffff,
];

fn call() -> impl Strategy<Value = Call> {
    let float = prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(0.0), -2.0f32..2.0];
    let int = prop_oneof![Just(i32::MIN), Just(i32::MAX), -2..70];
    (0u8..44, prop::sample::select(NAMES.to_vec()), float, int).prop_map(|(which, name, float, int)| Call {
        which,
        name,
        float,
        int,
    })
}

fn play(gl: &mut Context, call: &Call) {
    let Call { name, float, int, .. } = *call;
    let small = int.rem_euclid(4) as u32;
    match call.which {
        0..4 => gl.begin(name),
        4..10 => gl.vertex([float, 1.0, int as f32, 1.0]),
        10..14 => gl.end(),
        14 => gl.color([float, 0.5, 0.5, float]),
        15 => gl.normal([float, 0.0, 1.0]),
        16 => gl.multi_tex_coord(GL_TEXTURE0 + small * 2, [float; 4]),
        17 => gl.enable(name),
        18 => gl.disable(name),
        19 => gl.light(name, GL_POSITION, Params::Floats(&[float; 4])),
        20 => gl.material(name, GL_DIFFUSE, Params::Floats(&[float; 3])),
        21 => gl.matrix_mode(name),
        22 => gl.translate(float, 0.0, 1.0),
        23 => gl.scale(float, float, 0.0),
        24 => gl.push_matrix(),
        25 => gl.pop_matrix(),
        26 => gl.new_list(small, name),
        27 => gl.end_list(),
        28 => gl.call_list(small),
        29 => gl.bind_texture(name, small),
        30 => {
            let size = [int.rem_euclid(9), int.rem_euclid(5), 1];
            let definition = ImageDefinition { level: 0, internal_format: name, size, border: 0 };
            gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&[9; 300]));
        }
        31 => gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[name as i32])),
        32 => gl.enable_client_state(name),
        33 => gl.vertex_pointer(2 + int.rem_euclid(3), name, int, Pointer::Blob(vec![1; 200].into())),
        34 => gl.color_pointer(4, GL_UNSIGNED_BYTE, 0, Pointer::Offset(u64::from(small))),
        35 => gl.draw_arrays(name, int, int.wrapping_mul(3)),
        36 => gl.draw_elements(name, int, GL_UNSIGNED_BYTE, Pointer::Blob(vec![3, 1, 2, 0, 5, 7].into())),
        37 => gl.push_attrib(name),
        38 => gl.pop_attrib(),
        39 => gl.bind_buffer(GL_ARRAY_BUFFER, small),
        40 => gl.buffer_data(GL_ARRAY_BUFFER, int as isize % 500, None, GL_STATIC_DRAW),
        41 => gl.polygon_mode(GL_FRONT_AND_BACK, name),
        42 => gl.read_pixels(int, 0, int, 2, GL_RGBA, GL_UNSIGNED_BYTE, &mut [0; 64]),
        _ => gl.draw_pixels(int.rem_euclid(5), 2, GL_RGBA, GL_UNSIGNED_BYTE, &[1; 40]),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn nothing_panics_and_frames_are_sound(calls in prop::collection::vec(call(), 1..80)) {
        let checker = Checker::default();
        let mut gl = Context::new(Box::new(checker.clone()), SharedNames::default());
        gl.set_drawable(64, 48);
        for call in &calls {
            play(&mut gl, call);
        }
        gl.swap_buffers();
        let unsound = checker.0.lock().unwrap();
        prop_assert!(unsound.is_empty(), "{unsound:?}");
    }
}
