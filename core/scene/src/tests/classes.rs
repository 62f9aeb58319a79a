//! Classes by state.

use afterglow_gl::frame::{BaseFormat, BlendFactor, Compare, Stencil, StencilOp};
use glam::{Mat4, Vec3, Vec4};

use crate::Recovery;
use crate::testing::{Sketch, class, floor, thing, verdict};
use crate::types::{Class, Scene};

const OVER: Option<(BlendFactor, BlendFactor)> =
    Some((BlendFactor::SourceAlpha, BlendFactor::OneMinusSourceAlpha));

fn understand(sketch: &mut Sketch) -> Scene {
    Recovery::new().understand(&mut sketch.frame)
}

fn eye_at(height: f32) -> Mat4 {
    Mat4::from_translation(Vec3::new(0.0, -height, -5.0))
}

#[test]
fn order_and_depth_tell_sky_and_interface() {
    let mut sketch = Sketch::new();
    sketch.depth(None);
    let sky = sketch.draw(&thing(9.0));
    sketch.depth(Some((Compare::LessEqual, true)));
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.depth(None);
    let flash = sketch.draw(&thing(0.1));
    sketch.projection = glam::camera::rh::proj::opengl::orthographic(0.0, 1.0, 0.0, 1.0, -1.0, 1.0);
    let score = sketch.draw(&thing(0.1));
    let scene = understand(&mut sketch);
    assert_eq!(class(&scene, sky), Class::Sky);
    assert_eq!((class(&scene, flash), class(&scene, score)), (Class::Interface, Class::Interface));
}

#[test]
fn a_dome_that_moves_with_the_eye_is_sky_even_when_drawn_late() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.modelview = Mat4::IDENTITY;
    sketch.depth(Some((Compare::LessEqual, false)));
    let dome = sketch.draw(&thing(500.0));
    assert_eq!(class(&understand(&mut sketch), dome), Class::Sky);
}

#[test]
fn a_far_depth_range_is_sky() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.viewport.depth_range = [1.0, 1.0];
    let sky = sketch.draw(&thing(30.0));
    assert_eq!(class(&understand(&mut sketch), sky), Class::Sky);
}

#[test]
fn weapons_have_a_near_depth_range_or_a_depth_layer_of_their_own() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.modelview = Mat4::from_translation(Vec3::new(0.2, -0.2, -1.0));
    sketch.viewport.depth_range = [0.0, 0.3];
    let gun = sketch.draw(&thing(0.5));
    sketch.viewport.depth_range = [0.0, 1.0];
    sketch.clear(None);
    let arm = sketch.draw(&thing(0.5));
    let scene = understand(&mut sketch);
    assert_eq!((class(&scene, gun), class(&scene, arm)), (Class::ViewModel, Class::ViewModel));
}

#[test]
fn blending_that_shows_nothing_of_what_is_behind_is_opaque() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.blend(OVER);
    sketch.texture(0, BaseFormat::Rgba, &[[90, 80, 70, 255]; 4]);
    let opaque = sketch.world();
    sketch.texture(0, BaseFormat::Rgba, &[[90, 80, 70, 120]; 4]);
    let glass = sketch.draw(&thing(1.0));
    sketch.texture(0, BaseFormat::Rgba, &[[90, 80, 70, 255], [0; 4], [0; 4], [50, 90, 20, 255]]);
    let leaves = sketch.draw(&thing(2.0));
    sketch.texture(0, BaseFormat::Rgb, &[[90, 80, 70, 255]; 4]);
    sketch.color[3] = 0.5;
    let ghost = sketch.draw(&thing(3.0));
    let scene = understand(&mut sketch);
    assert_eq!((class(&scene, opaque), class(&scene, glass)), (Class::Static, Class::Translucent));
    assert_eq!((class(&scene, leaves), class(&scene, ghost)), (Class::Static, Class::Translucent));
}

#[test]
fn an_alpha_test_for_more_than_half_cuts_out() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.blend(OVER);
    sketch.texture(0, BaseFormat::Rgba, &[[90, 80, 70, 120], [90, 80, 70, 200]]);
    sketch.fixed.words.global.set_alpha_func(Compare::Greater as u32);
    sketch.alpha_reference = 0.65;
    let fence = sketch.draw(&thing(1.0));
    sketch.alpha_reference = 0.01;
    let smoke = sketch.draw(&thing(2.0));
    let scene = understand(&mut sketch);
    assert_eq!((class(&scene, fence), class(&scene, smoke)), (Class::Static, Class::Translucent));
}

#[test]
fn texels_are_remembered_from_frames_that_were_only_observed() {
    let mut sketch = Sketch::new();
    sketch.blend(OVER);
    sketch.texture(0, BaseFormat::Rgba, &[[90, 80, 70, 255]; 4]);
    let mut recovery = Recovery::new();
    recovery.observe(&sketch.frame);
    sketch.frame.operations.clear();
    sketch.modelview = eye_at(2.0);
    let world = sketch.world();
    assert_eq!(class(&recovery.understand(&mut sketch.frame), world), Class::Static);
    assert!(Recovery::new().understand(&mut sketch.frame).camera.is_none());
}

#[test]
fn vertex_alpha_counts() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.blend(OVER);
    let corners = thing(1.0);
    let mut colors = vec![[1.0, 1.0, 1.0, 1.0]; corners.len()];
    let solid = sketch.draw_with(&corners, Some(&colors));
    colors[4][3] = 0.0;
    let fading = sketch.draw_with(&corners, Some(&colors));
    let scene = understand(&mut sketch);
    assert_eq!((class(&scene, solid), class(&scene, fading)), (Class::Static, Class::Translucent));
}

#[test]
fn shadow_volumes_and_planar_shadows_are_dropped() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.depth(Some((Compare::Less, false)));
    sketch.fixed.raster.color_mask = 0;
    sketch.fixed.raster.stencil = Some(Stencil {
        compare: Compare::Always,
        reference: 0,
        compare_mask: !0,
        write_mask: !0,
        fail: StencilOp::Keep,
        depth_fail: StencilOp::Keep,
        pass: StencilOp::IncrementWrap,
    });
    let volume = sketch.draw(&thing(4.0));
    sketch.fixed.raster.color_mask = 15;
    sketch.fixed.raster.stencil = None;
    sketch.blend(OVER);
    sketch.color = [0.0, 0.0, 0.0, 0.4];
    let flatten = Mat4::from_cols(Vec4::X, Vec4::new(0.3, 0.0, 0.2, 0.0), Vec4::Z, Vec4::W);
    sketch.modelview = eye_at(2.0) * flatten;
    let shadow = sketch.draw(&thing(1.0));
    sketch.color = [1.0, 0.8, 0.2, 0.4];
    let flare = sketch.draw(&thing(1.0));
    let scene = understand(&mut sketch);
    assert_eq!((class(&scene, volume), class(&scene, shadow)), (Class::Dropped, Class::Dropped));
    assert_eq!(class(&scene, flare), Class::Translucent);
}

#[test]
fn a_reflection_under_the_stencil_is_another_view() {
    let mut sketch = Sketch::new();
    sketch.modelview = eye_at(2.0);
    sketch.world();
    sketch.modelview = eye_at(2.0) * Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0));
    let mirrored_model = sketch.draw(&thing(1.0));
    sketch.fixed.words.global.set_clip_planes(1);
    let reflection = sketch.draw(&floor());
    let scene = understand(&mut sketch);
    assert_eq!(class(&scene, mirrored_model), Class::Movable);
    assert_eq!(
        (class(&scene, reflection), verdict(&scene, reflection).reason),
        (Class::OtherView, "mirrored")
    );
}
