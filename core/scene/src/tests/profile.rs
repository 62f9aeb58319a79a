//! Profiles: what they are read from, and what they override.

use std::sync::Arc;

use afterglow_gl::frame::{BaseFormat, BlendFactor, Compare, Operation};
use glam::{Mat4, Vec3};

use crate::testing::{Sketch, class, perspective, thing, verdict};
use crate::types::{Class, LightOrigin, LightShape, Scene};
use crate::{Profile, Recovery};

fn parse(text: &str) -> Profile {
    Profile::parse("test", text).unwrap()
}

/// What is wrong with a profile.
fn refused(text: &str) -> String {
    Profile::parse("test", text).unwrap_err().to_string()
}

fn understand(text: &str, sketch: &mut Sketch) -> Scene {
    Recovery::with_profile(Some(Arc::new(parse(text)))).understand(&mut sketch.frame)
}

fn view() -> Mat4 {
    glam::camera::rh::view::look_at_mat4(Vec3::new(3.0, 8.0, 20.0), Vec3::ZERO, Vec3::Y)
}

/// A floor, a textured thing on it, and a flat thing over it; the hash of the texture, and the operations.
fn sketch() -> (Sketch, u64, [usize; 3]) {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let floor = sketch.world();
    sketch.modelview *= Mat4::from_translation(Vec3::new(2.0, 1.0, 0.0));
    let image = sketch.texture(0, BaseFormat::Rgb, &[[9, 30, 200, 255]; 4]);
    let thing_ = sketch.draw(&thing(1.0));
    sketch.unbind(0);
    (sketch.modelview, sketch.projection) = (Mat4::IDENTITY, Mat4::IDENTITY);
    sketch.depth(None);
    sketch.blend(Some((BlendFactor::One, BlendFactor::One)));
    let icon = sketch.draw(&thing(0.1));
    let mut recovery = Recovery::new();
    recovery.observe(&sketch.frame);
    let hash = recovery.image(image).unwrap().content();
    (sketch, hash, [floor, thing_, icon])
}

#[test]
fn an_empty_profile_changes_nothing() {
    let without = Recovery::new().understand(&mut sketch().0.frame);
    for text in ["", "name = 'a game'\nexecutables = ['game']\nunits_per_metre = 32.0"] {
        let with = understand(text, &mut sketch().0);
        assert_eq!((&with.verdicts, &with.lights), (&without.verdicts, &without.lights));
        assert_eq!((with.camera, with.sky, with.baked), (without.camera, without.sky, without.baked));
    }
}

#[test]
fn rules_override_classes_and_the_first_that_holds_wins() {
    let (mut sketch, hash, [floor, thing, icon]) = sketch();
    let text = format!(
        "[[class]]\nis = 'sky'\nwhy = 'far away'\nwhen = {{ textures = ['{hash:016x}'] }}\n\
         [[class]]\nis = 'dropped'\nwhen = {{ triangles = {{ at_most = 3 }} }}\n\
         [[class]]\nis = 'undecided'\nwhen = {{ lit = true }}"
    );
    let scene = understand(&text, &mut sketch);
    assert_eq!(
        [floor, thing, icon].map(|draw| class(&scene, draw)),
        [Class::Static, Class::Sky, Class::Dropped]
    );
    assert_eq!(verdict(&scene, thing).reason, "far away");
    assert_eq!(verdict(&scene, icon).reason, "the profile says so");
    assert_eq!(verdict(&scene, thing).model, Mat4::IDENTITY);
}

#[test]
fn what_becomes_part_of_the_world_has_a_place_there() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.world();
    let offset = Mat4::from_translation(Vec3::new(2.0, 1.0, 0.0));
    sketch.modelview *= offset;
    sketch.depth(Some((Compare::LessEqual, false)));
    sketch.blend(Some((BlendFactor::SourceAlpha, BlendFactor::OneMinusSourceAlpha)));
    sketch.color[3] = 0.5;
    let glass = sketch.draw(&thing(1.0));
    let text = "[[class]]\nis = 'movable'\nwhen = { class = 'translucent', blend = 'blend', depth = 'test' }";
    let scene = understand(text, &mut sketch);
    assert_eq!(class(&scene, glass), Class::Movable);
    assert!(verdict(&scene, glass).model.abs_diff_eq(offset, 1e-5));
}

#[test]
fn conditions_hold_where_they_say() {
    let holds = |when: &str| {
        let (mut sketch, _, draws) = sketch();
        let text = format!("[[class]]\nis = 'undecided'\nwhen = {{ {when} }}");
        let scene = understand(&text, &mut sketch);
        draws.map(|draw| class(&scene, draw) == Class::Undecided)
    };
    assert_eq!(holds("units = { at_least = 1 }"), [false, true, false]);
    assert_eq!(holds("units = { at_most = 0 }"), [true, false, true]);
    assert_eq!(holds("matrix = 'view'"), [true, false, false]);
    assert_eq!(holds("matrix = 'own'"), [false, true, false]);
    assert_eq!(holds("matrix = 'identity'"), [false, false, true]);
    assert_eq!(holds("projection = 'orthographic'"), [false, false, true]);
    assert_eq!(holds("order = 'amid'"), [true, true, false]);
    assert_eq!(holds("order = 'late'"), [false, false, true]);
    assert_eq!(holds("blend = 'add', depth = 'off'"), [false, false, true]);
    assert_eq!(holds("viewport_share = { at_least = 0.5 }"), [true; 3]);
    assert_eq!(holds("viewport_share = { at_most = 0.5 }"), [false; 3]);
    assert_eq!(holds("lit = false, triangles = { at_least = 4, at_most = 100 }"), [true, false, false]);
}

#[test]
fn lights_and_sky_are_the_profiles() {
    let text = "units_per_metre = 10.0\n[sky]\ncolor = [0.1, 0.2, 0.3]\n\
                [[light]]\nkind = 'point'\nposition = [1, 2, 3]\ncolor = [1.0, 0.5, 0.25]\n\
                [[light]]\nkind = 'sun'\nto_light = [0, 5, 0]\ncolor = [2, 2, 2]\ndiameter = 2.0";
    let scene = understand(text, &mut sketch().0);
    assert_eq!(scene.sky, Vec3::new(0.1, 0.2, 0.3));
    assert!(scene.lights.iter().all(|light| light.origin == LightOrigin::Profile) && scene.lights.len() == 2);
    let LightShape::Point { position, radius, attenuation, .. } = scene.lights[0].shape else { panic!() };
    assert_eq!((position, radius), (Vec3::new(1.0, 2.0, 3.0), 1.0));
    assert!((attenuation.z - 0.01).abs() < 1e-6);
    let LightShape::Directional { to_light, angular_radius } = scene.lights[1].shape else { panic!() };
    assert_eq!(to_light, Vec3::Y);
    assert!((angular_radius - 1f32.to_radians()).abs() < 1e-6);
}

#[test]
fn lights_that_were_found_can_be_kept_or_put_out() {
    let lit = || {
        let mut sketch = Sketch::new();
        sketch.modelview = view();
        sketch.light([0.0, 0.0, 1.0, 0.0], [1.0; 4]);
        sketch.world();
        sketch
    };
    let lamp = "[[light]]\nkind = 'point'\nposition = [1, 2, 3]\ncolor = [1, 1, 1]\n";
    let origins = |text: &str| {
        let scene = understand(text, &mut lit());
        scene.lights.iter().map(|light| light.origin).collect::<Vec<_>>()
    };
    assert_eq!(origins(lamp), [LightOrigin::Profile, LightOrigin::Gl(0)]);
    assert_eq!(origins(&format!("{lamp}[lights]\nfound = 'off'")), [LightOrigin::Profile]);
    let dark = understand("[lights]\nfound = 'off'", &mut lit());
    assert!(dark.lights.is_empty() && dark.baked);
}

#[test]
fn textures_can_be_named_sky() {
    let (mut sketch, hash, [_, thing, _]) = sketch();
    let scene = understand(&format!("[sky]\ntextures = ['{hash:016x}']"), &mut sketch);
    assert_eq!(class(&scene, thing), Class::Sky);
    assert_eq!(verdict(&scene, thing).reason, "the profile's sky");
}

#[test]
fn a_camera_can_be_another_draws_matrix() {
    let (mut sketch, hash, [floor, thing, _]) = sketch();
    let matrix = |operation: usize| {
        let Operation::Draw(draw) = &sketch.frame.operations[operation] else { panic!() };
        Mat4::from_cols_array_2d(&sketch.frame.transforms[draw.transform as usize].modelview)
    };
    let (of_floor, of_thing) = (matrix(floor), matrix(thing));
    let text = format!("[[camera]]\nis = 'view'\nwhen = {{ textures = ['{hash:016x}'] }}");
    let scene = understand(&text, &mut sketch);
    let camera = scene.camera.unwrap();
    assert!(camera.view.as_mat4().abs_diff_eq(of_thing, 1e-4));
    // Camera and model together are what the program sent, for every draw.
    for (operation, sent) in [(floor, of_floor), (thing, of_thing)] {
        assert!((camera.view.as_mat4() * verdict(&scene, operation).model).abs_diff_eq(sent, 1e-4));
    }
    assert_eq!(camera.projection, perspective());
}

#[test]
fn frames_can_be_said_to_show_no_world() {
    let (mut sketch, hash, _) = sketch();
    let text = format!("[[camera]]\nis = 'none'\nwhen = {{ textures = ['{hash:016x}'] }}");
    let scene = understand(&text, &mut sketch);
    assert!(scene.camera.is_none() && scene.lights.is_empty() && scene.verdicts.len() == 3);
}

#[test]
fn nothing_is_traced_without_a_camera() {
    let mut sketch = Sketch::new();
    sketch.projection = Mat4::IDENTITY;
    let flat = sketch.draw(&thing(1.0));
    let rule = |is: &str| format!("[[class]]\nis = '{is}'\nwhen = {{ projection = 'orthographic' }}");
    assert_eq!(class(&understand(&rule("static"), &mut sketch), flat), Class::Interface);
    assert_eq!(class(&understand(&rule("sky"), &mut sketch), flat), Class::Sky);
}

#[test]
fn what_is_not_understood_is_told_with_its_line() {
    let said = refused("name = 'a'\nnonsense = 3");
    assert!(said.contains("line 2") && said.contains("nonsense"), "{said}");
    let said = refused("[[class]]\nis = 'sky'\nwhen = { colour = 'red' }");
    assert!(said.contains("line 3") && said.contains("colour"), "{said}");
    let said = refused("[[class]]\nis = 'ski'\nwhen = { lit = true }");
    assert!(said.contains("line 2") && said.contains("view_model"), "{said}");
    assert!(refused("[[class]]\nis = 'sky'\nwhen = {}").contains("nothing in `when`"));
    assert!(refused("[[class]]\nis = 'sky'").contains("when"));
    assert!(refused("[[light]]\nkind = 'torch'").contains("torch"));
    assert!(refused("name = ").contains("line 1"));
}

#[test]
fn numbers_that_are_none_are_refused() {
    for number in ["nan", "inf", "-inf", "1e300", "'1'"] {
        refused(&format!("units_per_metre = {number}"));
        refused(&format!("[sky]\ncolor = [0.0, {number}, 0.0]"));
        refused(&format!("[[light]]\nkind = 'sun'\nto_light = [{number}, 1, 0]\ncolor = [1, 1, 1]"));
        refused(&format!("[[class]]\nis = 'sky'\nwhen = {{ triangles = {{ at_most = {number} }} }}"));
    }
    assert!(refused("units_per_metre = -1").contains("greater than zero"));
    assert!(refused("[sky]\ncolor = [0, -1, 0]").contains("below zero"));
    assert!(
        refused("[[light]]\nkind = 'sun'\nto_light = [0, 0, 0]\ncolor = [1, 1, 1]").contains("direction")
    );
    assert!(refused("[sky]\ntextures = ['12']").contains("16 hexadecimal"));
    assert!(refused("[sky]\ntextures = ['+123456789abcdef']").contains("16 hexadecimal"));
}

#[test]
fn sizes_are_bounded() {
    let rule = "[[class]]\nis = 'sky'\nwhen = { lit = true }\n";
    assert!(Profile::parse("test", &rule.repeat(1024)).is_ok());
    assert!(refused(&rule.repeat(1025)).contains("1024 at most"));
    assert!(
        refused(&"[[light]]\nkind = 'sun'\nto_light = [0, 1, 0]\ncolor = [1, 1, 1]\n".repeat(65))
            .contains("64")
    );
    assert!(refused(&format!("[sky]\ntextures = [{}]", "'0123456789abcdef',".repeat(8193))).contains("8192"));
    assert!(refused(&"# nothing\n".repeat(200_000)).contains("are no profile"));
    assert!(refused(&format!("name = '{}'", "x".repeat(200))).contains("120 bytes"));
    refused(&format!("name = {}", "[".repeat(100_000)));
}

#[test]
fn the_manuals_example_is_a_profile() {
    let manual = include_str!("../../../../docs/profiles.md");
    let example = manual.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    assert_ne!(parse(example), Profile::default());
}

proptest::proptest! {
    #[test]
    fn damaged_profiles_are_errors_or_profiles(
        places in proptest::collection::vec((0usize..4096, proptest::prelude::any::<u8>()), 1..6),
    ) {
        let manual = include_str!("../../../../docs/profiles.md");
        let example = manual.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
        let mut bytes = example.as_bytes().to_vec();
        for (place, byte) in places {
            let length = bytes.len();
            bytes[place % length] = byte & 127;
        }
        let text = String::from_utf8(bytes).unwrap();
        if let Ok(profile) = Profile::parse("damaged", &text) {
            let scene = Recovery::with_profile(Some(Arc::new(profile))).understand(&mut sketch().0.frame);
            assert!(scene.lights.iter().all(|light| light.color.is_finite()));
        }
    }
}
