//! The two backends of ray tracing make the same pictures, but for a few pixels at edges of triangles: there a ray may meet
//! one side or the other, and numbers are rounded otherwise.

use afterglow_api::constants::*;
use afterglow_gl::frame::{Hint, HintMaterial};
use afterglow_gl::texture::ImageDefinition;
use afterglow_gl::{Context, Params};
use afterglow_scene::{Camera, Class, LightOrigin, LightShape, Scene, SceneLight, Verdict};
use glam::{DMat4, DVec3, Mat4, Vec3};

use super::pathtrace::{OPEN, SHADOW, SIZE, Stage, look_down, slab};
use crate::testing::{FrameBuilder, WHITE, assert_valid, renderer};
use crate::{Backend, Denoiser, Mode, PathtraceOptions, Radiance};

/// Share of pixels that may differ by more than a step of 8 bits.
const MOST_DIFFERING: f64 = 0.004;

/// What both backends leave in the window after `draw`.
fn pictures(change: impl Fn(&mut PathtraceOptions), draw: impl Fn(&mut Stage)) -> [Stage; 2] {
    [Backend::Software, Backend::Hardware].map(|backend| {
        let mut stage = Stage::new(Mode::Pathtrace, |options| {
            change(options);
            options.backend = backend;
        });
        draw(&mut stage);
        stage
    })
}

fn assert_alike([software, hardware]: &[Stage; 2]) {
    let (software, hardware) = (software.picture(), hardware.picture());
    let pixels = software.len() / 4;
    let differs = |(one, other): &(&[u8], &[u8])| one.iter().zip(*other).any(|(a, b)| a.abs_diff(*b) > 1);
    let differing = software.chunks(4).zip(hardware.chunks(4)).filter(differs).count();
    assert!(differing as f64 <= MOST_DIFFERING * pixels as f64, "{differing} of {pixels} pixels differ");
    assert_valid();
}

/// A lit floor and a slab over it that stands so far to the side, its triangles drawn as `draw_slab` does.
fn floor_and_slab(stage: &mut Stage, aside: f32, draw_slab: impl Fn(&mut Context)) {
    let gl = &mut stage.gl;
    gl.clear_color(0.1, 0.2, 0.3, 1.0);
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    look_down(gl);
    for capability in [GL_LIGHTING, GL_LIGHT0, GL_DEPTH_TEST] {
        gl.enable(capability);
    }
    gl.light(GL_LIGHT0, GL_POSITION, Params::Floats(&[0.0, 5.0, 0.0, 1.0]));
    slab(gl, 4.0);
    gl.translate(aside, 1.5, 0.0);
    draw_slab(gl);
    gl.swap_buffers();
}

#[test]
fn shadows_and_bounced_light_are_the_same() {
    let stages = pictures(|options| options.spp = 8, |stage| floor_and_slab(stage, 0.0, |gl| slab(gl, 0.8)));
    assert!(stages[1].brightness(SHADOW) + 20 < stages[1].brightness(OPEN));
    assert_alike(&stages);
}

#[test]
fn light_goes_through_the_holes_of_a_texture() {
    // Texels in columns, every other one a hole.
    let draw = |gl: &mut Context, hole: u8| {
        let texels: Vec<_> =
            (0..8).flat_map(|texel| [255, 255, 255, if texel % 2 == 0 { hole } else { 255 }]).collect();
        gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[GL_NEAREST as i32]));
        let definition = ImageDefinition { level: 0, internal_format: GL_RGBA, size: [8, 1, 1], border: 0 };
        gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&texels));
        gl.enable(GL_TEXTURE_2D);
        gl.enable(GL_ALPHA_TEST);
        gl.alpha_func(GL_GREATER, 0.5);
        slab(gl, 0.8);
        gl.disable(GL_ALPHA_TEST);
        gl.disable(GL_TEXTURE_2D);
    };
    let drawn =
        |hole| pictures(|options| options.spp = 8, |stage| floor_and_slab(stage, 0.0, |gl| draw(gl, hole)));
    let (holes, whole) = (drawn(0), drawn(255));
    assert!(holes[1].brightness(SHADOW) > whole[1].brightness(SHADOW) + 10);
    assert_alike(&holes);
    assert_alike(&whole);
}

/// A bent strip that waves from frame to frame: the same triangles, moved.
fn wave(gl: &mut Context, phase: f32) {
    gl.begin(GL_QUAD_STRIP);
    gl.normal([0.0, 1.0, 0.0]);
    for step in 0..=8 {
        let x = step as f32 / 4.0 - 1.0;
        let height = 0.4 * (4.0 * x + phase).sin();
        gl.vertex([x, height, 0.8, 1.0]);
        gl.vertex([x, height, -0.8, 1.0]);
    }
    gl.end();
}

#[test]
fn what_moves_and_bends_is_met_where_it_is() {
    let stages = pictures(
        |options| options.denoiser = Denoiser::None,
        |stage| {
            for frame in 0..6 {
                let phase = frame as f32;
                floor_and_slab(stage, 0.1 * phase, |gl| wave(gl, phase));
            }
        },
    );
    assert_alike(&stages);
}

/// Lavapipe's structures are moved by the processor unless the device is made to.
#[test]
fn what_the_device_moves_is_what_the_processor_moves() {
    let picture = |by_device: bool| {
        let mut stage = Stage::new(Mode::Pathtrace, |options| options.denoiser = Denoiser::None);
        if by_device {
            let renderer = &mut *stage.renderer.lock().unwrap();
            let world = &mut renderer.tracer.as_mut().unwrap().world;
            world.structures_mut().always_refit(&renderer.gpu);
        }
        for frame in 0..7 {
            let phase = 0.3 * frame as f32;
            floor_and_slab(&mut stage, 0.1 * phase, |gl| wave(gl, phase));
        }
        let report = stage.renderer.lock().unwrap().frame_report().unwrap().clone();
        assert_eq!(report.passes.iter().any(|pass| pass.name == "refit"), by_device);
        stage.picture()
    };
    assert!(picture(true) == picture(false));
    assert_valid();
}

/// A display list of the slab: a mesh that lasts, so that it is compacted.
#[test]
fn what_lasts_stays_as_it_is_when_it_is_made_smaller() {
    let [software, hardware] = pictures(
        |options| options.denoiser = Denoiser::None,
        |stage| {
            stage.gl.new_list(1, GL_COMPILE);
            for row in 0..40 {
                stage.gl.translate(0.0, 0.0, if row == 0 { -0.78 } else { 0.04 });
                slab(&mut stage.gl, 0.02);
            }
            stage.gl.end_list();
            for _ in 0..6 {
                floor_and_slab(stage, 0.0, |gl| gl.call_list(1));
            }
        },
    );
    assert_alike(&[software, hardware]);
}

/// A level that is built beside the frames: first rays miss it, then it is as it would have been at once.
#[test]
fn what_is_built_beside_the_frames_comes_to_be_met() {
    let stage = |waits: bool| {
        let mut stage = Stage::new(Mode::Pathtrace, |options| options.waits_for_builds = waits);
        stage.gl.new_list(1, GL_COMPILE);
        stage.gl.begin(GL_QUADS);
        stage.gl.normal([0.0, 1.0, 0.0]);
        for row in 0..1500 {
            let (near, far) = (0.8 - row as f32 / 1000.0, 0.799 - row as f32 / 1000.0);
            for [x, z] in [[-0.8, near], [0.8, near], [0.8, far], [-0.8, far]] {
                stage.gl.vertex([x, 0.0, z, 1.0]);
            }
        }
        stage.gl.end();
        stage.gl.end_list();
        let mut waiting = Vec::new();
        // Some more, so that exposure has come to rest.
        while waiting.iter().filter(|waiting| **waiting == 0).count() < 40 {
            floor_and_slab(&mut stage, 0.0, |gl| gl.call_list(1));
            let traced = stage.renderer.lock().unwrap().frame_report().unwrap().traced;
            waiting.extend(traced.map(|traced| traced.waiting));
        }
        (stage, waiting.iter().any(|waiting| *waiting > 0))
    };
    let ((at_once, has_waited), (later, has_come)) = (stage(true), stage(false));
    assert!(!has_waited && has_come);
    assert_alike(&[at_once, later]);
}

#[test]
fn the_backend_can_change() {
    let mut stage = Stage::new(Mode::Pathtrace, |_| {});
    floor_and_slab(&mut stage, 0.0, |gl| slab(gl, 0.8));
    let before = stage.picture();
    for backend in [Backend::Hardware, Backend::Software] {
        let options = PathtraceOptions { spp: 4, accumulate: false, backend, ..PathtraceOptions::default() };
        stage.renderer.lock().unwrap().set_mode(Mode::Pathtrace, &options).unwrap();
        floor_and_slab(&mut stage, 0.0, |gl| slab(gl, 0.8));
    }
    let differing = before.iter().zip(&stage.picture()).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(differing < before.len() / 100, "{differing}");
    assert_valid();
}

/// On a device with memory of its own, which lavapipe is not, lists are copied: in frames that change, and in some that do not.
#[test]
fn copied_lists_are_what_was_written() {
    for backend in [Backend::Software, Backend::Hardware] {
        let picture = |copies: bool| {
            let mut stage = Stage::new(Mode::Pathtrace, |options| options.backend = backend);
            if copies {
                let renderer = &mut *stage.renderer.lock().unwrap();
                renderer.tracer.as_mut().unwrap().lists.always_copy(&renderer.gpu);
            }
            for aside in [0.3, 0.0, 0.0, 0.0, 0.1] {
                floor_and_slab(&mut stage, aside, |gl| slab(gl, 0.8));
            }
            stage.picture()
        };
        assert!(picture(true) == picture(false), "{backend}");
    }
    assert_valid();
}

/// A wall before which two spheres shine, seen by the camera's own rays.
fn spheres(backend: Backend) -> Radiance {
    let mut builder = FrameBuilder::new(SIZE.0, SIZE.1);
    let material = HintMaterial { base_color: Some([0.5, 0.6, 0.7]), ..HintMaterial::default() };
    builder.frame.hints.push(Hint { material, ..Hint::default() });
    builder.quad([-3.0; 2], [3.0; 2], 0.0, WHITE);
    let light = |position, radius, color| SceneLight {
        shape: LightShape::Point { position, radius, attenuation: Vec3::Z, spot: None },
        color,
        origin: LightOrigin::SceneFile,
    };
    let scene = Scene {
        camera: Some(Camera {
            view: DMat4::from_translation(DVec3::new(0.0, 0.0, -6.0)),
            // glFrustum(-0.4, 0.4, -0.3, 0.3, 1, 50).
            projection: Mat4::from_cols_array_2d(&[
                [2.5, 0.0, 0.0, 0.0],
                [0.0, 10.0 / 3.0, 0.0, 0.0],
                [0.0, 0.0, -51.0 / 49.0, -1.0],
                [0.0, 0.0, -100.0 / 49.0, 0.0],
            ]),
        }),
        verdicts: vec![Verdict {
            operation: 0,
            class: Class::Static,
            reason: "test",
            model: Mat4::IDENTITY,
            object: 1,
            previous: None,
            baked: false,
            triangles: 2,
            base: None,
        }],
        lights: vec![
            light(Vec3::new(-1.0, 0.0, 1.0), 0.5, Vec3::ONE),
            light(Vec3::new(1.5, 0.8, 0.3), 0.2, Vec3::new(0.1, 0.2, 0.3)),
        ],
        ..Scene::default()
    };
    let mut renderer = renderer();
    let options = PathtraceOptions { spp: 4, backend, ..PathtraceOptions::default() };
    renderer.set_mode(Mode::Reference, &options).unwrap();
    renderer.execute_staged(&mut builder.frame, scene).unwrap();
    renderer.read_radiance().unwrap().unwrap()
}

#[test]
fn lights_that_are_spheres_are_met_alike() {
    let (software, hardware) = (spheres(Backend::Software), spheres(Backend::Hardware));
    // The first sphere shines with its power over the square of its radius.
    let brightest = |radiance: &Radiance| radiance.mean.iter().map(|pixel| pixel[0]).fold(0.0, f32::max);
    assert!((brightest(&software) - 4.0).abs() < 0.5 && (brightest(&hardware) - 4.0).abs() < 0.5);
    let differs = |(one, other): &(&[f32; 3], &[f32; 3])| {
        one.iter().zip(*other).any(|(a, b)| (a - b).abs() > 0.01 * a.max(*b).max(0.01))
    };
    let differing = software.mean.iter().zip(&hardware.mean).filter(differs).count();
    let most = (MOST_DIFFERING * software.mean.len() as f64) as usize;
    assert!(differing <= most, "{differing} of {} pixels differ", software.mean.len());
    assert_valid();
}
