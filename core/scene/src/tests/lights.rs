//! Lights, sky and what is done when there are none.

use glam::{Mat4, Vec3};

use crate::Recovery;
use crate::testing::{Sketch, thing};
use crate::types::{LightOrigin, LightShape};
use afterglow_gl::frame::{BaseFormat, Compare};

fn view() -> Mat4 {
    glam::camera::rh::view::look_at_mat4(Vec3::new(3.0, 8.0, 20.0), Vec3::ZERO, Vec3::Y)
}

#[test]
fn gl_lights_are_moved_to_the_world_and_counted_once() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let place = Vec3::new(4.0, 9.0, -2.0);
    let eye = view().transform_point3(place);
    sketch.light(eye.extend(1.0).to_array(), [1.0, 0.5, 0.0, 1.0]);
    sketch.world();
    sketch.modelview *= Mat4::from_translation(Vec3::X);
    sketch.draw(&thing(1.0));
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!(scene.lights.len(), 1);
    assert_eq!(scene.lights[0].origin, LightOrigin::Gl(0));
    assert!(scene.lights[0].color.abs_diff_eq(Vec3::new(1.0, 0.214, 0.0), 1e-3));
    let LightShape::Point { position, radius, spot: None, .. } = scene.lights[0].shape else { panic!() };
    assert!(position.abs_diff_eq(place, 1e-4));
    assert!(radius > 0.0 && radius < 1.0);
}

#[test]
fn a_directional_light_points_from_the_world() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    let to_light = Vec3::new(1.0, 2.0, 3.0).normalize();
    sketch.light(view().transform_vector3(to_light * 5.0).extend(0.0).to_array(), [1.0; 4]);
    sketch.lights.scene_ambient = [0.2, 0.2, 0.2, 1.0];
    sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    let LightShape::Directional { to_light: found, .. } = scene.lights[0].shape else { panic!() };
    assert!(found.abs_diff_eq(to_light, 1e-5));
    assert!(scene.ambient.abs_diff_eq(Vec3::splat(0.0331), 1e-3));
}

#[test]
fn without_lights_a_soft_sun_shines_from_above() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!(scene.lights[0].origin, LightOrigin::Fallback);
    let LightShape::Directional { to_light, .. } = scene.lights[0].shape else { panic!() };
    assert!(to_light.y > 0.7, "{to_light}");
    assert!(scene.sky.min_element() > 0.0);
}

#[test]
fn up_is_kept_when_the_camera_looks_down() {
    let mut sketch = Sketch::new();
    sketch.modelview = view();
    sketch.world();
    let mut recovery = Recovery::new();
    let before = recovery.understand(&mut sketch.frame).lights[0];
    let mut sketch = Sketch::new();
    sketch.modelview = glam::camera::rh::view::look_at_mat4(Vec3::new(0.0, 30.0, 10.0), Vec3::ZERO, Vec3::Y);
    sketch.world();
    assert_eq!(recovery.understand(&mut sketch.frame).lights[0].shape, before.shape);
}

#[test]
fn the_sky_is_what_was_cleared_to_or_drawn() {
    let mut sketch = Sketch::new();
    sketch.clear(Some([1.0, 0.0, 0.0, 1.0]));
    sketch.modelview = view();
    sketch.light([0.0, 0.0, 1.0, 0.0], [1.0; 4]);
    sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert_eq!(scene.sky, Vec3::X);
    assert_eq!(scene.painted_sky, None);

    let mut sketch = Sketch::new();
    sketch.clear(Some([1.0, 0.0, 0.0, 1.0]));
    sketch.texture(0, BaseFormat::Rgb, &[[0, 0, 255, 255]; 2]);
    sketch.depth(None);
    let [x, y, z] = Vec3::AXES;
    let octants = [[x, y, z], [x, z, -y], [-x, z, y], [-x, -y, z], [x, y, -z], [x, -z, -y]];
    let sky = sketch.draw(octants.as_flattened());
    sketch.unbind(0);
    sketch.depth(Some((Compare::Less, true)));
    sketch.modelview = view();
    sketch.light([0.0, 0.0, 1.0, 0.0], [1.0; 4]);
    sketch.world();
    let scene = Recovery::new().understand(&mut sketch.frame);
    assert!(scene.sky.abs_diff_eq(Vec3::Z, 1e-3), "{}", scene.sky);
    let painted = scene.painted_sky.unwrap();
    assert_eq!((painted.mean, painted.least), (scene.sky, Vec3::ZERO));
    assert_eq!((painted.cleared, painted.open), (Vec3::X, Vec3::X), "what was cleared to is seen beside it");
    let draws: Vec<_> = painted.draws.iter().map(|draw| (draw.operation, draw.eye)).collect();
    assert_eq!(draws, [(sky as u32, glam::DMat4::IDENTITY)]);
}
