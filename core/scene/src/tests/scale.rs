//! Many objects, many frames: what is known stays known, and costs no more an object.

use std::time::{Duration, Instant};

use glam::{DMat4, DVec3, Mat4, Vec3};

use crate::Recovery;
use crate::testing::{Sketch, floor, thing};
use crate::types::{Class, Scene};

/// Where a camera is that walks a rounded path, and turns all the time.
fn view(frame: u32) -> DMat4 {
    let (walked, angle) = (0.05 * f64::from(frame), 0.011 * f64::from(frame));
    let eye = DVec3::new(30.0 * (0.03 * walked).sin(), 2.0, 30.0 * (0.021 * walked).cos());
    DMat4::from_rotation_x(0.1 * (0.7 * angle).sin())
        * DMat4::from_rotation_y(angle)
        * DMat4::from_translation(-eye)
}

/// As many things apart, each with a matrix of its own that moves, on a floor.
fn moving_things(sketch: &mut Sketch, frame: u32, count: u32) {
    let view = view(frame).as_mat4();
    sketch.modelview = view;
    sketch.draw(&floor());
    for number in 0..count {
        // So far in a frame that it shows at any distance.
        let angle = 0.3 * frame as f32 + 0.7 * number as f32;
        let place = 4.0 * Vec3::new((number % 100) as f32 - 50.0, 0.5, (number / 100) as f32 - 50.0);
        let model = Mat4::from_translation(place + Vec3::new(angle.cos(), 0.0, angle.sin()))
            * Mat4::from_rotation_y(angle);
        sketch.modelview = view * model;
        sketch.draw(&thing(0.4 + 1e-4 * (number / 2) as f32));
    }
}

fn ids(scene: &Scene) -> Vec<u64> {
    scene.verdicts.iter().map(|verdict| verdict.object).collect()
}

/// The scenes of the first frames of such a world, and the least time that one of the later frames took.
fn understood(count: u32) -> (Vec<Scene>, Duration) {
    let (mut recovery, mut least) = (Recovery::new(), Duration::MAX);
    let scene = |frame| {
        let mut sketch = Sketch::new();
        moving_things(&mut sketch, frame, count);
        let start = Instant::now();
        let scene = recovery.understand(&mut sketch.frame);
        if frame > 4 {
            least = least.min(start.elapsed());
        }
        scene
    };
    let scenes = (0..12).map(scene).collect();
    (scenes, least)
}

#[test]
fn ten_thousand_things_keep_their_names_and_cost_no_more_each() {
    let (few, many) = (understood(1000), understood(10_000));
    for (scenes, count) in [(&few.0, 1000), (&many.0, 10_000)] {
        // Two of each shape, side by side: the same names all the time, and no two the same.
        let last = ids(&scenes[11]);
        (2..11).for_each(|frame| assert!(ids(&scenes[frame]) == last, "frame {frame} of {count}"));
        let mut unique = last;
        unique.sort_unstable();
        unique.dedup();
        assert_eq!(unique.len(), count + 1);
        let movable = scenes[11].verdicts.iter().filter(|verdict| verdict.class == Class::Movable).count();
        assert_eq!(movable, count);
    }
    // Ten times as many take ten times as long; thrice that is left to caches and to other programs.
    assert!(many.1 < 30 * few.1, "{:?} and {:?}", few.1, many.1);
}

#[test]
fn nothing_drifts_in_ten_thousand_frames() {
    let places =
        |index: u32| DVec3::new(7.3 * f64::from(index) - 25.0, 0.4, f64::from(index * 5 % 7) * 6.1 - 20.0);
    let (mut recovery, mut settled, mut worst) = (Recovery::new(), None, [0.0f64; 2]);
    for frame in 0..10_000 {
        let mut sketch = Sketch::new();
        for index in 0..8 {
            let model = DMat4::from_translation(places(index)) * DMat4::from_rotation_y(f64::from(index));
            // As a program has it: all that is left of view and model is one matrix of single precision.
            sketch.modelview = (view(frame) * model).as_mat4();
            sketch.draw(&thing(1.0 + 0.3 * index as f32));
        }
        let scene = recovery.understand(&mut sketch.frame);
        let models: Vec<Mat4> = scene.verdicts.iter().map(|verdict| verdict.model).collect();
        if frame < 100 {
            settled = Some((ids(&scene), models, scene.epoch));
            worst[0] = worst[0].max(camera_error(&scene, frame));
            continue;
        }
        let (names, places, epoch) = settled.as_ref().unwrap();
        assert!(ids(&scene) == *names && scene.epoch == *epoch, "frame {frame}");
        assert!(
            models == *places,
            "frame {frame}: what stands still has the place at which it was first seen"
        );
        if frame >= 9900 {
            worst[1] = worst[1].max(camera_error(&scene, frame));
        }
    }
    // Single precision errs by as much in the last frames as in the first.
    assert!(worst[1] < 3.0 * worst[0].max(1e-6), "{worst:?}");
}

/// How far the camera is from where it is in truth, beside how far it was in the first frame: world units.
fn camera_error(scene: &Scene, frame: u32) -> f64 {
    let eye = |view: DMat4| view.inverse().w_axis.truncate();
    let found = scene.camera.unwrap().view;
    // The first frame's first guess of the view is the matrix of one of the things.
    let world = |index: usize| scene.verdicts[index].model.as_dmat4().w_axis.truncate();
    let truth = view(frame) * DVec3::new(-25.0, 0.4, -20.0).extend(1.0);
    (found * world(0).extend(1.0)).truncate().distance(truth.truncate()) / eye(view(frame)).length()
}

#[test]
fn of_too_many_objects_those_unseen_longest_are_forgotten() {
    let (mut recovery, mut first) = (Recovery::new(), None);
    for frame in 0..45 {
        let mut sketch = Sketch::new();
        sketch.modelview = view(frame).as_mat4();
        sketch.draw(&floor());
        let still = sketch.draw(&thing(3.0));
        for number in 0..2000 {
            // Seen in this frame, and never again.
            let place = Vec3::new((number % 50) as f32, 4.0 + frame as f32, (number / 50) as f32);
            sketch.modelview = view(frame).as_mat4() * Mat4::from_translation(place);
            sketch.draw(&thing(0.1 + 1e-6 * (2000 * frame + number) as f32));
        }
        let scene = recovery.understand(&mut sketch.frame);
        let verdict = scene.verdicts[still];
        if frame < 8 {
            first = Some((verdict.object, scene.epoch));
        }
        assert_eq!(first, Some((verdict.object, scene.epoch)), "frame {frame}");
        assert!(frame < 8 || verdict.class == Class::Static, "frame {frame}: {}", verdict.reason);
    }
}
