//! GL_AFTERGLOW_scene_hints: what a program says comes with the frame, and errors are OpenGL's.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

mod recorder;

use afterglow_api::constants::*;
use afterglow_gl::Context;
use afterglow_gl::frame::{Frame, Hint, HintClass, HintLightShape};
use afterglow_gl::texture::ImageDefinition;
use recorder::context;

/// The frame that the calls made, which are without error.
fn frame(calls: impl FnOnce(&mut Context)) -> Frame {
    let (mut context, recorder) = context();
    calls(&mut context);
    assert_eq!(context.get_error(), GL_NO_ERROR);
    context.swap_buffers();
    recorder.0.lock().unwrap().pop().unwrap().0
}

fn triangle(gl: &mut Context) {
    gl.begin(GL_TRIANGLES);
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] {
        gl.vertex([x, y, 0.0, 1.0]);
    }
    gl.end();
}

/// What is said of each draw.
fn hints(frame: &Frame) -> Vec<Option<Hint>> {
    frame.draws().map(|(_, draw)| frame.hint(draw).copied()).collect()
}

#[test]
fn a_program_that_says_nothing_has_no_hints() {
    let frame = frame(|gl| {
        triangle(gl);
        triangle(gl);
    });
    assert_eq!(hints(&frame), [None], "one draw: primitives are joined as ever");
    assert!(frame.hints.is_empty() && frame.scene_hints.is_empty());
}

#[test]
fn what_is_said_of_draws_holds_until_it_is_changed() {
    let frame = frame(|gl| {
        gl.scene_object(7);
        gl.scene_class(GL_SCENE_MOVABLE_AFTERGLOW);
        triangle(gl);
        triangle(gl);
        gl.scene_material(0.5, 1.0);
        gl.scene_emission(3.0, 2.0, 1.0);
        triangle(gl);
        gl.scene_class(GL_NONE);
        triangle(gl);
        gl.scene_defaults();
        triangle(gl);
    });
    let hints = hints(&frame);
    let first = hints[0].unwrap();
    assert_eq!((first.object, first.class), (7, Some(HintClass::Movable)));
    assert_eq!(hints.len(), 4, "the first two are one draw");
    let second = hints[1].unwrap();
    assert_eq!((second.object, second.class), (7, Some(HintClass::Movable)));
    assert_eq!(second.material.roughness_metallic, Some([0.5, 1.0]));
    assert_eq!(second.material.emission, Some([3.0, 2.0, 1.0]));
    assert_eq!(hints[2].unwrap(), Hint { class: None, ..second });
    assert_eq!(hints[3], None);
}

#[test]
fn draws_of_other_objects_are_not_joined() {
    let frame = frame(|gl| {
        for object in [1, 2, 2, 1] {
            gl.scene_object(object);
            triangle(gl);
        }
    });
    let objects: Vec<_> = hints(&frame).iter().map(|hint| hint.unwrap().object).collect();
    assert_eq!(objects, [1, 2, 1]);
}

#[test]
fn lists_hold_what_is_said_of_draws() {
    let frame = frame(|gl| {
        gl.new_list(1, GL_COMPILE);
        gl.scene_object(9);
        gl.scene_class(GL_SCENE_SKY_AFTERGLOW);
        triangle(gl);
        gl.scene_defaults();
        // Not compiled, but executed.
        gl.scene_sky(1.0, 2.0, 3.0);
        gl.end_list();
        triangle(gl);
        gl.call_list(1);
        triangle(gl);
    });
    let said: Vec<_> = hints(&frame).iter().map(|hint| hint.map(|hint| (hint.object, hint.class))).collect();
    assert_eq!(said, [None, Some((9, Some(HintClass::Sky))), None]);
    assert_eq!(frame.scene_hints.sky, Some([1.0, 2.0, 3.0]));
}

#[test]
fn what_is_said_of_a_frame_ends_with_it() {
    let (mut gl, recorder) = context();
    gl.matrix_mode(GL_MODELVIEW);
    gl.translate(1.0, 2.0, 3.0);
    gl.scene_view();
    gl.scene_cut();
    gl.scene_point_light(5, [1.0; 3], [2.0; 3], 0.1);
    gl.scene_directional_light(6, [0.0, -2.0, 0.0], [3.0; 3], 0.5);
    gl.scene_point_light(5, [4.0; 3], [2.0; 3], 0.1);
    gl.scene_spot_light(0, [0.0; 3], [0.0, 0.0, -1.0], [1.0; 3], 0.0, 30.0, 2.0);
    gl.scene_spot_light(0, [0.0; 3], [0.0, 0.0, -1.0], [1.0; 3], 0.0, 30.0, 2.0);
    triangle(&mut gl);
    gl.swap_buffers();
    triangle(&mut gl);
    gl.swap_buffers();
    assert_eq!(gl.get_error(), GL_NO_ERROR);
    let frames = recorder.0.lock().unwrap();
    let said = &frames[0].0.scene_hints;
    assert_eq!(said.view.unwrap()[3], [1.0, 2.0, 3.0, 1.0]);
    assert!(said.cut);
    let ids: Vec<_> = said.lights.iter().map(|light| light.id).collect();
    assert_eq!(ids, [5, 6, 0, 0], "the later light of an id counts, and 0 is no id");
    assert_eq!(said.lights[0].shape, HintLightShape::Point { position: [4.0; 3], radius: 0.1 });
    let direction = [0.0, -1.0, 0.0];
    assert_eq!(said.lights[1].shape, HintLightShape::Directional { direction, angle: 0.5 });
    assert!(frames[1].0.scene_hints.is_empty());
}

#[test]
fn parts_of_a_frame_are_joined() {
    let (mut gl, recorder) = context();
    gl.scene_view();
    gl.scene_point_light(5, [1.0; 3], [2.0; 3], 0.1);
    gl.scene_object(1);
    triangle(&mut gl);
    let mut pixel = [0; 4];
    gl.read_pixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &mut pixel);
    gl.scene_point_light(5, [3.0; 3], [2.0; 3], 0.1);
    triangle(&mut gl);
    gl.scene_object(2);
    triangle(&mut gl);
    gl.scene_defaults();
    triangle(&mut gl);
    gl.swap_buffers();
    let mut frames = std::mem::take(&mut *recorder.0.lock().unwrap());
    let (mut later, _) = frames.pop().unwrap();
    let (mut whole, _) = frames.pop().unwrap();
    whole.append(&mut later);
    let objects: Vec<_> = hints(&whole).iter().map(|hint| hint.map(|hint| hint.object)).collect();
    assert_eq!(objects, [Some(1), Some(1), Some(2), None]);
    assert!(whole.scene_hints.view.is_some());
    assert_eq!(whole.scene_hints.lights.len(), 1);
    assert!(later.scene_hints.is_empty());
}

#[test]
fn maps_are_images_of_textures() {
    let frame = frame(|gl| {
        gl.bind_texture(GL_TEXTURE_2D, 3);
        gl.tex_parameter(
            GL_TEXTURE_2D,
            GL_TEXTURE_MIN_FILTER,
            afterglow_gl::Params::Ints(&[GL_LINEAR as i32]),
        );
        let definition = ImageDefinition { level: 0, internal_format: GL_RGBA, size: [1; 3], border: 0 };
        gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&[1, 2, 3, 4]));
        gl.bind_texture(GL_TEXTURE_2D, 0);
        gl.scene_map(GL_SCENE_EMISSION_MAP_AFTERGLOW, 3);
        gl.scene_map(GL_SCENE_NORMAL_MAP_AFTERGLOW, 77);
        triangle(gl);
    });
    let material = hints(&frame)[0].unwrap().material;
    assert!(material.emission_map.is_some());
    assert_eq!((material.normal_map, material.metallic_roughness_map), (None, None));
}

#[test]
fn errors_are_those_of_opengl() {
    let (mut gl, _) = context();
    let mut fails = |error: u32, call: &dyn Fn(&mut Context)| {
        call(&mut gl);
        assert_eq!(gl.get_error(), error);
    };
    fails(GL_INVALID_ENUM, &|gl| gl.scene_class(GL_FOG));
    fails(GL_INVALID_ENUM, &|gl| gl.scene_map(GL_TEXTURE_2D, 1));
    fails(GL_INVALID_VALUE, &|gl| gl.scene_material(1.5, 0.0));
    fails(GL_INVALID_VALUE, &|gl| gl.scene_material(f32::NAN, 0.0));
    fails(GL_INVALID_VALUE, &|gl| gl.scene_emission(-1.0, 0.0, 0.0));
    fails(GL_INVALID_VALUE, &|gl| gl.scene_sky(0.0, f32::INFINITY, 0.0));
    fails(GL_INVALID_VALUE, &|gl| gl.scene_point_light(1, [f32::NAN; 3], [1.0; 3], 0.0));
    fails(GL_INVALID_VALUE, &|gl| gl.scene_point_light(1, [0.0; 3], [1.0; 3], -1.0));
    fails(GL_INVALID_VALUE, &|gl| gl.scene_directional_light(1, [0.0; 3], [1.0; 3], 0.5));
    fails(GL_INVALID_VALUE, &|gl| {
        gl.scene_spot_light(1, [0.0; 3], [0.0, 1.0, 0.0], [1.0; 3], 0.0, 120.0, 0.0);
    });
    fails(GL_INVALID_OPERATION, &|gl| {
        gl.scale(0.0, 1.0, 1.0);
        gl.scene_view();
        gl.load_identity();
    });
    fails(GL_OUT_OF_MEMORY, &|gl| {
        for id in 1..=257 {
            gl.scene_point_light(id, [0.0; 3], [1.0; 3], 0.0);
        }
    });
    assert_eq!(gl.get_integer(GL_MAX_SCENE_LIGHTS_AFTERGLOW), [256]);
}

#[test]
fn nothing_is_said_between_begin_and_end() {
    let calls: [fn(&mut Context); 12] = [
        |gl| gl.scene_object(1),
        |gl| gl.scene_class(GL_SCENE_SKY_AFTERGLOW),
        |gl| gl.scene_material(0.0, 0.0),
        |gl| gl.scene_emission(0.0, 0.0, 0.0),
        |gl| gl.scene_map(GL_SCENE_EMISSION_MAP_AFTERGLOW, 0),
        |gl| gl.scene_defaults(),
        |gl| gl.scene_view(),
        |gl| gl.scene_cut(),
        |gl| gl.scene_sky(0.0, 0.0, 0.0),
        |gl| gl.scene_point_light(1, [0.0; 3], [1.0; 3], 0.0),
        |gl| gl.scene_directional_light(1, [1.0; 3], [1.0; 3], 0.0),
        |gl| gl.scene_spot_light(1, [0.0; 3], [1.0; 3], [1.0; 3], 0.0, 30.0, 0.0),
    ];
    for call in calls {
        let (mut gl, recorder) = context();
        gl.begin(GL_TRIANGLES);
        call(&mut gl);
        gl.end();
        assert_eq!(gl.get_error(), GL_INVALID_OPERATION);
        triangle(&mut gl);
        gl.swap_buffers();
        let frames = recorder.0.lock().unwrap();
        assert!(frames[0].0.hints.is_empty() && frames[0].0.scene_hints.is_empty());
    }
}
