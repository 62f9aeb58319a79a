//! What the program says of its scene.

use std::f32::consts::PI;

use afterglow_gl::frame::{Hint, HintClass, HintLight, HintLightShape, HintMaterial};
use glam::{Mat4, Vec3};

use crate::Recovery;
use crate::testing::{Sketch, class, perspective, thing, verdict};
use crate::types::{Class, LightOrigin, LightShape};

fn view() -> Mat4 {
    glam::camera::rh::view::look_at_mat4(Vec3::new(3.0, 8.0, 20.0), Vec3::ZERO, Vec3::Y)
}

/// Says this of the draws that follow.
fn say(sketch: &mut Sketch, hint: Hint) {
    sketch.frame.hints.push(hint);
    sketch.hint = sketch.frame.hints.len() as u32;
}

fn of_class(class: HintClass) -> Hint {
    Hint { class: Some(class), ..Hint::default() }
}

fn light(id: u64, position: Vec3, intensity: f32) -> HintLight {
    let shape = HintLightShape::Point { position: position.to_array(), radius: 0.5 };
    HintLight { id, shape, color: [intensity; 3] }
}

#[test]
fn a_class_that_is_said_wins_over_evidence() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let world = sketch.world();
    say(&mut sketch, Hint { object: 42, ..of_class(HintClass::Sky) });
    let sky = sketch.draw(&thing(1.0));
    say(&mut sketch, of_class(HintClass::Dynamic));
    sketch.blend(Some((afterglow_gl::frame::BlendFactor::One, afterglow_gl::frame::BlendFactor::One)));
    sketch.modelview = view() * Mat4::from_translation(Vec3::X);
    let dynamic = sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!((class(&scene, world), class(&scene, sky)), (Class::Static, Class::Sky));
    assert_eq!(verdict(&scene, sky).object, 42);
    assert_eq!(verdict(&scene, sky).reason, "the program says so");
    let dynamic = verdict(&scene, dynamic);
    assert_eq!(dynamic.class, Class::Dynamic);
    assert!(dynamic.model.abs_diff_eq(Mat4::from_translation(Vec3::X), 1e-4));
}

#[test]
fn what_rays_cannot_meet_is_not_traced_though_the_program_says_so() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.world();
    say(&mut sketch, of_class(HintClass::Static));
    sketch.modelview = Mat4::from_scale(Vec3::new(1.0, 0.0, 1.0));
    let flat = sketch.draw(&thing(1.0));
    sketch.modelview = Mat4::IDENTITY;
    sketch.projection = glam::camera::rh::proj::opengl::orthographic(-9.0, 9.0, -9.0, 9.0, -9.0, 9.0);
    let parallel = sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    for operation in [flat, parallel] {
        assert_ne!(verdict(&scene, operation).reason, "the program says so");
    }
}

#[test]
fn the_view_that_is_said_wins_over_evidence() {
    let mut sketch = Sketch::new();
    // A heavy thing that fills the world, drawn under a matrix of its own, and the true world beside it.
    let model = Mat4::from_translation(Vec3::new(5.0, 1.0, -3.0)) * Mat4::from_rotation_y(0.7);
    sketch.modelview = view() * model;
    sketch.light([0.0, 0.0, 0.0, 1.0], [1.0; 4]);
    let heavy = sketch.world();
    sketch.modelview = view();
    let still = sketch.draw(&thing(0.5));
    let without = Recovery::new().understand(&mut sketch.frame);
    assert!(without.camera.unwrap().view.abs_diff_eq((view() * model).as_dmat4(), 1e-5));
    sketch.frame.scene_hints.view = Some(view().to_cols_array_2d());
    let scene = Recovery::new().understand(&mut sketch.frame);
    let camera = scene.camera.unwrap();
    assert!(camera.view.abs_diff_eq(view().as_dmat4(), 1e-5));
    assert_eq!(camera.projection, perspective());
    assert_eq!(verdict(&scene, still).model, Mat4::IDENTITY);
    assert!(verdict(&scene, heavy).model.abs_diff_eq(model, 1e-4));
    // The light at the eye that was found by evidence is in the new world.
    let LightShape::Point { position, .. } = scene.lights[0].shape else { panic!("{:?}", scene.lights) };
    assert!(position.abs_diff_eq(Vec3::new(3.0, 8.0, 20.0), 1e-3), "{position}");
}

#[test]
fn a_view_in_the_projection_matrix_is_part_of_the_camera_that_is_said() {
    let mut sketch = Sketch::new();
    sketch.projection = perspective() * view();
    sketch.modelview = Mat4::from_translation(Vec3::X);
    sketch.frame.scene_hints.view = Some(Mat4::IDENTITY.to_cols_array_2d());
    let world = sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert!(scene.camera.unwrap().view.abs_diff_eq(view().as_dmat4(), 1e-4));
    assert!(verdict(&scene, world).model.abs_diff_eq(Mat4::from_translation(Vec3::X), 1e-4));
}

#[test]
fn lights_that_are_said_take_the_place_of_those_that_are_found() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.light([0.0, 0.0, 0.0, 1.0], [1.0; 4]);
    sketch.world();
    let said = &mut sketch.frame.scene_hints;
    said.view = Some(view().to_cols_array_2d());
    said.lights.push(light(7, Vec3::new(1.0, 2.0, 3.0), PI));
    let shape = HintLightShape::Directional { direction: [0.0, -1.0, 0.0], angle: 2.0 };
    said.lights.push(HintLight { id: 8, shape, color: [f32::MAX; 3] });
    said.sky = Some([0.5, 0.25, 0.125]);
    said.cut = true;
    let scene = Recovery::new().understand(&mut sketch.frame);
    let origins: Vec<_> = scene.lights.iter().map(|light| light.origin).collect();
    assert_eq!(origins, [LightOrigin::Program(7), LightOrigin::Program(8)]);
    let shape = LightShape::Point {
        position: Vec3::new(1.0, 2.0, 3.0),
        radius: 0.5,
        attenuation: Vec3::Z,
        spot: None,
    };
    assert_eq!(scene.lights[0].shape, shape);
    assert!(scene.lights[0].color.abs_diff_eq(Vec3::ONE, 1e-6));
    let LightShape::Directional { to_light, angular_radius } = scene.lights[1].shape else { panic!() };
    assert_eq!((to_light, angular_radius), (Vec3::Y, 1.0f32.to_radians()));
    assert_eq!(scene.sky, Vec3::new(0.5, 0.25, 0.125));
    assert!(scene.cut && scene.ambient.is_finite());
}

#[test]
fn lights_without_a_view_are_nowhere() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.world();
    sketch.frame.scene_hints.lights.push(light(7, Vec3::ONE, 1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert!(scene.lights.iter().all(|light| light.origin == LightOrigin::Fallback));
}

#[test]
fn of_many_lights_the_brightest_at_the_camera_are_taken() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.world();
    sketch.frame.scene_hints.view = Some(view().to_cols_array_2d());
    for id in 1..=100 {
        let away = Vec3::new(3.0, 8.0, 20.0 + id as f32);
        sketch.frame.scene_hints.lights.push(light(id, away, 1.0));
    }
    let scene = Recovery::new().understand(&mut sketch.frame);
    let nearest: Vec<_> = (1..=32).map(LightOrigin::Program).collect();
    assert_eq!(scene.lights.iter().map(|light| light.origin).collect::<Vec<_>>(), nearest);
}

#[test]
fn a_frame_whose_world_is_not_found_has_the_one_that_is_said() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.depth(None);
    say(&mut sketch, of_class(HintClass::Static));
    let world = sketch.world();
    assert_eq!(Recovery::new().understand(&mut sketch.frame).camera, None);
    sketch.frame.scene_hints.view = Some(view().to_cols_array_2d());
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert!(scene.camera.unwrap().view.abs_diff_eq(view().as_dmat4(), 1e-5));
    assert_eq!((class(&scene, world), verdict(&scene, world).model), (Class::Static, Mat4::IDENTITY));
}

#[test]
fn a_surface_of_a_material_is_not_baked() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let colors: Vec<[f32; 4]> = (0..9).map(|i| [i as f32 / 9.0, 1.0, 1.0, 1.0]).collect();
    sketch.world();
    let plain = sketch.draw_with(&thing(1.0), Some(&colors));
    let material = HintMaterial { roughness_metallic: Some([0.5, 0.0]), ..HintMaterial::default() };
    say(&mut sketch, Hint { material, ..Hint::default() });
    let said = sketch.draw_with(&thing(1.0), Some(&colors));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!((verdict(&scene, plain).baked, verdict(&scene, said).baked), (true, false));
}

#[test]
fn an_object_that_is_named_is_found_again_where_it_was() {
    let mut recovery = Recovery::new();
    let mut frame = |x: f32, cut: bool| {
        let mut sketch = Sketch::new();
        sketch.frame.scene_hints.view = Some(view().to_cols_array_2d());
        sketch.frame.scene_hints.cut = cut;
        sketch.modelview = view();
        sketch.world();
        say(&mut sketch, Hint { object: 5, ..of_class(HintClass::Movable) });
        let parts = [0.0, 1.0].map(|y| {
            sketch.modelview = view() * Mat4::from_translation(Vec3::new(x, y, 0.0));
            sketch.draw(&thing(1.0))
        });
        let scene = recovery.understand(&mut sketch.frame);
        parts.map(|part| verdict(&scene, part).previous.map(|model| model.w_axis.truncate()))
    };
    let near = |place: Option<Vec3>, x: f32, y: f32| place.unwrap().abs_diff_eq(Vec3::new(x, y, 0.0), 1e-4);
    assert_eq!(frame(1.0, false), [None; 2]);
    let [low, high] = frame(30.0, false);
    assert!(near(low, 1.0, 0.0) && near(high, 1.0, 1.0));
    assert_eq!(frame(2.0, true), [None; 2]);
    let [low, _] = frame(2.0, false);
    assert!(near(low, 2.0, 0.0));
}
