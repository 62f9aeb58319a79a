//! What becomes of a scene.

use afterglow_gl::frame::{Frame, Operation};
use afterglow_scene::{Class, LightShape, Scene};
use glam::{DVec3, Mat4, Vec3};

use super::sample::{document, parse};
use crate::Stage;

fn stage() -> Stage {
    Stage::new(parse(&document()).unwrap()).unwrap()
}

/// Corners of a frame's draws, in object space.
fn corners(frame: &Frame) -> Vec<Vec<[f32; 3]>> {
    let of_draw = |(_, draw)| {
        let (words, indices) = frame.geometry(draw);
        let corner =
            |index: &u32| std::array::from_fn(|axis| f32::from_bits(words[3 * *index as usize + axis]));
        indices.iter().map(corner).collect()
    };
    frame.draws().map(of_draw).collect()
}

fn models(scene: &Scene) -> Vec<(u64, Class, Mat4, Option<Mat4>)> {
    scene
        .verdicts
        .iter()
        .map(|verdict| (verdict.object, verdict.class, verdict.model, verdict.previous))
        .collect()
}

#[test]
fn each_object_and_material_is_a_draw_with_its_own_vertices() {
    let (frame, scene) = stage().still();
    assert!(
        matches!(frame.operations[0], Operation::Clear(clear) if clear.color.is_some() && clear.depth.is_some())
    );
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.1]];
    let lid = vec![c, b, a, d, c, a];
    assert_eq!(corners(&frame), [vec![a, b, c], vec![a, c, d], lid]);
    assert_eq!(frame.retained.iter().map(|range| range.vertex_count()).collect::<Vec<_>>(), [3, 3, 4]);
    assert_eq!(scene.verdicts.iter().map(|verdict| verdict.operation).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(scene.verdicts.iter().map(|verdict| verdict.triangles).collect::<Vec<_>>(), [1, 1, 2]);
}

#[test]
fn vertices_are_the_same_memory_in_all_frames() {
    let stage = stage();
    let ids = |frame: &Frame| frame.retained.iter().map(|range| range.id()).collect::<Vec<_>>();
    assert_eq!(ids(&stage.still().0), ids(&stage.staged(2).0));
}

#[test]
fn materials_are_said() {
    let (frame, _) = stage().still();
    let said: Vec<_> = frame.draws().map(|(_, draw)| frame.hint(draw).unwrap().material).collect();
    assert_eq!(said[0].base_color, Some([0.5, 0.25, 1.0]));
    assert_eq!((said[0].roughness_metallic, said[0].emission), (None, None));
    assert_eq!((said[1].roughness_metallic, said[1].emission), (Some([0.2, 1.0]), Some([2.0, 0.0, 0.0])));
}

#[test]
fn lights_are_in_the_renderers_units() {
    let (_, scene) = stage().still();
    assert_eq!(scene.sky, Vec3::new(0.5, 0.25, 0.125));
    let [sun, lamp, other] = &scene.lights[..] else { panic!("{:?}", scene.lights) };
    assert_eq!(sun.shape, LightShape::Directional { to_light: Vec3::Y, angular_radius: 0.005 });
    assert!((sun.color * std::f32::consts::PI).abs_diff_eq(Vec3::new(3.0, 2.0, 1.0), 1e-6));
    assert_eq!((lamp.color, other.color), (Vec3::new(2.0, 1.0, 0.5), Vec3::splat(4.0)));
    let LightShape::Point { position, radius, attenuation, spot: None } = lamp.shape else {
        panic!("{lamp:?}")
    };
    assert_eq!((position, radius, attenuation), (Vec3::Y, 0.5, Vec3::Z));
}

#[test]
fn frames_move_what_they_name_and_scale_light() {
    let stage = stage();
    let (frame, scene) = stage.staged(1);
    let moved = Mat4::from_translation(Vec3::new(3.0, 0.0, 0.0));
    let rest = (1, Class::Static, Mat4::IDENTITY, Some(Mat4::IDENTITY));
    assert_eq!(models(&scene), [rest, rest, (2, Class::Movable, moved, Some(Mat4::IDENTITY))]);
    assert_eq!(frame.transforms[2].modelview[3], [3.0, 0.0, -5.0, 1.0]);
    assert_eq!(scene.lights[0].color, Vec3::ZERO);
    assert_eq!((scene.lights[1].color, scene.lights[2].color), (Vec3::new(1.0, 0.5, 0.25), Vec3::splat(8.0)));
    assert_eq!(scene.sky, Vec3::new(2.0, 1.0, 0.5));
    assert_eq!(frame.hints[1].material.emission, Some([1.0, 0.0, 0.0]));
    // The next one is complete in itself, and knows where the object was.
    let (_, after) = stage.staged(2);
    assert_eq!(models(&after)[2], (2, Class::Movable, Mat4::IDENTITY, Some(moved)));
    assert_eq!(after.lights[0].color, stage.still().1.lights[0].color);
    assert_eq!(models(&stage.staged(0).1)[2], (2, Class::Movable, Mat4::IDENTITY, Some(Mat4::IDENTITY)));
}

#[test]
fn another_size_keeps_the_vertical_field_of_view() {
    let (frame, scene) = stage().with_size([64, 64]).still();
    assert_eq!((frame.size, frame.viewports[0].rect.width), ((64, 64), 64));
    let camera = scene.camera.unwrap();
    assert_eq!((camera.projection.x_axis.x, camera.projection.y_axis.y), (2.0, 1.0));
    assert_eq!(camera.view.w_axis.truncate(), DVec3::new(0.0, 0.0, -5.0));
}
