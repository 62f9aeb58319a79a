//! Cameras and models.

use afterglow_gl::frame::{Operation, Rect};
use glam::{DMat4, Mat4, Vec3};

use crate::Recovery;
use crate::testing::{Sketch, class, perspective, thing, verdict};
use crate::types::Class;

fn view() -> Mat4 {
    glam::camera::rh::view::look_at_mat4(Vec3::new(3.0, 8.0, 20.0), Vec3::ZERO, Vec3::Y)
}

#[test]
fn the_commonest_modelview_is_the_camera_and_others_move() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let world = sketch.world();
    let model = Mat4::from_translation(Vec3::new(5.0, 1.0, -3.0)) * Mat4::from_rotation_y(0.7);
    sketch.modelview = view() * model;
    let movable = sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    let camera = scene.camera.unwrap();
    assert!(camera.view.abs_diff_eq(view().as_dmat4(), 1e-5));
    assert_eq!(camera.projection, perspective());
    assert_eq!((class(&scene, world), verdict(&scene, world).model), (Class::Static, Mat4::IDENTITY));
    assert_eq!(class(&scene, movable), Class::Movable);
    assert!(verdict(&scene, movable).model.abs_diff_eq(model, 1e-4));
    let counts = scene.triangles();
    assert_eq!((counts.r#static, counts.movable), (20, 3));
    assert_eq!(counts.named().iter().map(|(_, n)| n).sum::<u64>(), 23);
}

#[test]
fn a_heavy_thing_does_not_become_the_camera() {
    let mut sketch = Sketch::new();
    sketch.modelview = view() * Mat4::from_translation(Vec3::ONE);
    let car = sketch.draw(&thing(0.5).repeat(100));
    sketch.modelview = view();
    let world = sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!((class(&scene, car), class(&scene, world)), (Class::Movable, Class::Static));
}

#[test]
fn a_left_handed_world_has_a_camera() {
    let mut sketch = Sketch::new();
    sketch.projection = glam::camera::lh::proj::opengl::perspective(1.0, 1.3, 0.1, 500.0);
    sketch.modelview = glam::camera::lh::view::look_at_mat4(Vec3::new(3.0, 8.0, 20.0), Vec3::ZERO, Vec3::Y);
    let world = sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert!(scene.camera.unwrap().view.abs_diff_eq(sketch.modelview.as_dmat4(), 1e-5));
    assert_eq!(class(&scene, world), Class::Static);
}

#[test]
fn a_view_in_the_projection_matrix_is_part_of_the_camera() {
    let mut sketch = Sketch::new();
    sketch.projection = perspective() * view();
    let world = sketch.world();
    let model = Mat4::from_translation(Vec3::X);
    sketch.modelview = model;
    let movable = sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    let camera = scene.camera.unwrap();
    assert!(camera.view.abs_diff_eq(view().as_dmat4(), 1e-4), "{}", camera.view);
    assert!(camera.projection.abs_diff_eq(perspective(), 1e-3));
    assert_eq!(class(&scene, world), Class::Static);
    assert!(verdict(&scene, movable).model.abs_diff_eq(model, 1e-5));
}

#[test]
fn a_scaled_world_keeps_a_rigid_camera() {
    let mut sketch = Sketch::new();
    let scale = Mat4::from_scale(Vec3::splat(0.05));
    sketch.modelview = view() * scale;
    let world = sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert!(scene.camera.unwrap().view.abs_diff_eq(view().as_dmat4(), 1e-4));
    assert!(verdict(&scene, world).model.abs_diff_eq(scale, 1e-5));
}

#[test]
fn a_flat_frame_has_no_camera() {
    let mut sketch = Sketch::new();
    sketch.projection = glam::camera::rh::proj::opengl::orthographic(0.0, 640.0, 0.0, 480.0, -1.0, 1.0);
    let menu = sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert!(scene.camera.is_none() && scene.lights.is_empty());
    assert_eq!(class(&scene, menu), Class::Interface);
}

#[test]
fn the_largest_view_is_the_world() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let world = sketch.world();
    let full = sketch.viewport;
    sketch.viewport.rect = Rect { x: 10, y: 10, width: 60, height: 60 };
    let head = sketch.draw(&thing(1.0).repeat(200));
    sketch.viewport = full;
    let more = sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!(class(&scene, head), Class::OtherView);
    assert_eq!((class(&scene, world), class(&scene, more)), (Class::Static, Class::Static));
    assert!(scene.camera.unwrap().view.abs_diff_eq(view().as_dmat4(), 1e-5));
}

#[test]
fn what_a_clear_erases_is_another_view() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let erased = sketch.draw(&thing(1.0).repeat(200));
    sketch.clear(Some([0.0; 4]));
    let world = sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!(class(&scene, erased), Class::OtherView);
    assert_eq!(class(&scene, world), Class::Static);
}

#[test]
fn a_view_copied_to_a_texture_ends_at_the_next_depth_clear() {
    let mut sketch = Sketch::new();
    let image = sketch.texture(0, afterglow_gl::frame::BaseFormat::Rgb, &[[0; 4]]);
    sketch.unbind(0);
    let reflection = sketch.draw(&thing(1.0));
    let region = afterglow_gl::frame::Region { level: 0, layer: 0, offset: [0; 3], extent: [1; 3] };
    sketch.frame.operations.push(Operation::CopyToImage(afterglow_gl::frame::ImageCopy {
        image,
        region,
        source: sketch.viewport.rect,
        base_format: afterglow_gl::frame::BaseFormat::Rgb,
    }));
    sketch.clear(None);
    sketch.modelview = view();
    let world = sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!((class(&scene, reflection), class(&scene, world)), (Class::OtherView, Class::Static));
}

#[test]
fn rounding_does_not_make_things_move() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.world();
    let back = Mat4::from_translation(Vec3::splat(-7.3));
    sketch.modelview = view() * Mat4::from_translation(Vec3::splat(7.3)) * back;
    let again = sketch.draw(&thing(2.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!(class(&scene, again), Class::Static);
    assert!(scene.camera.unwrap().view != DMat4::IDENTITY);
}
