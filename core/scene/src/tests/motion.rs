//! What is learnt over frames: the camera, objects and what they do.

use glam::{DMat4, Mat4, Vec3};

use crate::Recovery;
use crate::testing::{Sketch, floor, thing, verdict};
use crate::types::{Class, Scene};

/// A path of a camera about the origin.
fn view(frame: u32) -> Mat4 {
    let angle = 0.05 * frame as f32;
    Mat4::from_translation(Vec3::new(0.0, -2.0, -20.0 - 0.3 * frame as f32)) * Mat4::from_rotation_y(angle)
}

/// Positions of things that stand apart.
fn places() -> Vec<Vec3> {
    (0..6).map(|i| Vec3::new(7.0 * i as f32 - 18.0, 0.0, (5 * i % 7) as f32 * 3.0 - 9.0)).collect()
}

fn understand(frame: u32, recovery: &mut Recovery, draw: impl Fn(&mut Sketch, Mat4)) -> Scene {
    let mut sketch = Sketch::new();
    draw(&mut sketch, view(frame));
    recovery.understand(&mut sketch.frame)
}

/// How far the recovered camera has gone between two scenes, beside how far it has in truth.
fn is_same_step(scenes: [&Scene; 2], frames: [u32; 2]) -> bool {
    let [a, b] = scenes.map(|scene| scene.camera.unwrap().view);
    let step = |a: DMat4, b: DMat4| b * a.inverse();
    step(a, b).abs_diff_eq(step(view(frames[0]).as_dmat4(), view(frames[1]).as_dmat4()), 1e-4)
}

/// A world in which everything has a matrix of its own, and a thing that moves.
fn own_matrices(sketch: &mut Sketch, view: Mat4, moving: Vec3) {
    for (index, place) in places().into_iter().enumerate() {
        sketch.modelview = view * Mat4::from_translation(place);
        sketch.draw(&thing(1.0 + 0.25 * index as f32));
    }
    sketch.modelview = view * Mat4::from_translation(moving);
    sketch.draw(&thing(0.8));
}

#[test]
fn the_camera_is_what_stands_still_agrees_on() {
    let mut recovery = Recovery::new();
    let scenes: Vec<Scene> = (0..20)
        .map(|frame| {
            let moving = Vec3::new(0.4 * frame as f32, 1.0, 0.0);
            understand(frame, &mut recovery, |sketch, view| own_matrices(sketch, view, moving))
        })
        .collect();
    assert!((1..20).all(|frame| is_same_step([&scenes[0], &scenes[frame]], [0, frame as u32])));
    let classes: Vec<Class> = scenes[19].verdicts.iter().map(|verdict| verdict.class).collect();
    assert_eq!(classes[..6], [Class::Static; 6]);
    assert_eq!(classes[6], Class::Movable);
    // Each keeps its name, and no two have the same.
    let ids = |scene: &Scene| scene.verdicts.iter().map(|verdict| verdict.object).collect::<Vec<_>>();
    assert_eq!(ids(&scenes[1]), ids(&scenes[19]));
    let mut unique = ids(&scenes[19]);
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(unique.len(), 7);
    // The mover says where it was.
    let mover = scenes[19].verdicts[6];
    let went = mover.model.w_axis - mover.previous.unwrap().w_axis;
    assert!((went.truncate().length() - 0.4).abs() < 1e-3, "{went}");
}

#[test]
fn a_thing_carried_before_the_camera_does_not_win_over_the_world() {
    let mut recovery = Recovery::new();
    let mut last = None;
    for frame in 0..12 {
        let scene = understand(frame, &mut recovery, |sketch, view| {
            // The car has far more triangles than the ground.
            let mut car = Vec::new();
            (0..200).for_each(|i| car.extend(thing(1.0 + 0.002 * i as f32)));
            sketch.modelview = Mat4::from_translation(Vec3::new(0.0, -1.0, -6.0));
            sketch.draw(&car);
            for place in places() {
                sketch.modelview = view * Mat4::from_translation(place * 8.0);
                sketch.draw(&floor());
            }
        });
        if let Some((before, former)) = last.replace((scene, frame)) {
            let (now, _) = last.as_ref().unwrap();
            assert!(frame < 2 || is_same_step([&before, now], [former, frame]), "frame {frame}");
        }
    }
    let (scene, _) = last.unwrap();
    assert_eq!(scene.verdicts[0].class, Class::Movable);
}

#[test]
fn nothing_drifts() {
    let mut recovery = Recovery::new();
    let frame_of = |frame: u32, recovery: &mut Recovery| {
        understand(frame, recovery, |sketch, view| own_matrices(sketch, view, Vec3::Y))
    };
    let first = frame_of(0, &mut recovery);
    let last = (1..2000).map(|frame| frame_of(frame % 60, &mut recovery)).last().unwrap();
    assert!(is_same_step([&first, &last], [0, 1999 % 60]));
}

#[test]
fn matrices_that_make_no_sense_are_borne() {
    let mut recovery = Recovery::new();
    let odd = [
        Mat4::ZERO,
        Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0)),
        Mat4::from_cols_array(&[f32::NAN; 16]),
        Mat4::from_scale(Vec3::splat(1e30)),
        Mat4::from_translation(Vec3::splat(f32::INFINITY)),
        Mat4::from_scale(Vec3::splat(1e-30)),
    ];
    for frame in 0..18 {
        let scene = understand(frame, &mut recovery, |sketch, view| {
            own_matrices(sketch, view, Vec3::ZERO);
            sketch.modelview = view * odd[frame as usize % odd.len()];
            sketch.draw(&thing(3.0));
        });
        let camera = scene.camera.unwrap();
        assert!(camera.view.is_finite(), "frame {frame}");
    }
}

/// Things that stand, one of which is somewhere else in one frame.
fn shaken(by: Vec3) -> Vec<Class> {
    let mut recovery = Recovery::new();
    let class = |frame: u32| {
        let scene = understand(frame, &mut recovery, |sketch, view| {
            for (index, place) in places().into_iter().enumerate() {
                let place = if index == 3 && frame == 12 { place + by } else { place };
                sketch.modelview = view * Mat4::from_translation(place);
                sketch.draw(&thing(1.0 + 0.25 * index as f32));
            }
        });
        verdict(&scene, 3).class
    };
    (0..24).map(class).collect()
}

#[test]
fn what_goes_and_comes_back_has_moved_but_a_tremor_is_none() {
    assert!(shaken(Vec3::Y * 1e-4)[7..].iter().all(|class| *class == Class::Static));
    let classes = shaken(Vec3::Y * 0.2);
    // One frame elsewhere is no evidence, the way back is.
    assert_eq!(classes[7..13], [Class::Static; 6]);
    assert_eq!(classes[13..], [Class::Movable; 11]);
}

#[test]
fn what_changes_its_vertices_is_dynamic_and_keeps_its_name() {
    let mut recovery = Recovery::new();
    let mut names = Vec::new();
    for frame in 0..10 {
        let scene = understand(frame, &mut recovery, |sketch, view| {
            sketch.modelview = view;
            sketch.world();
            let mut creature: Vec<Vec3> = Vec::new();
            (0..8).for_each(|i| {
                creature.extend(thing(1.0 + 0.1 * (0.7 * frame as f32 + 1.3 * i as f32).sin()))
            });
            sketch.modelview = view * Mat4::from_rotation_y(0.3);
            sketch.draw(&creature);
        });
        names.push(scene.verdicts[1].object);
        if frame > 4 {
            assert_eq!((scene.verdicts[0].class, scene.verdicts[1].class), (Class::Static, Class::Dynamic));
            assert_eq!(scene.deformed.len(), 1);
            assert_eq!(scene.deformed[0].positions.len(), 72);
        }
    }
    assert!(names.iter().all(|name| *name == names[0]), "{names:x?}");
}

/// Things about these places, of twelve triangles in all.
fn alike(places: [[f32; 2]; 4]) -> Vec<Vec3> {
    places
        .into_iter()
        .flat_map(|[x, z]| thing(1.0).into_iter().map(move |c| c + Vec3::new(x, 0.0, z)))
        .collect()
}

#[test]
fn what_grows_elsewhere_is_another_thing() {
    let mut recovery = Recovery::new();
    let mut verdicts = Vec::new();
    for frame in 0..40 {
        let scene = understand(frame, &mut recovery, |sketch, view| {
            sketch.modelview = view;
            sketch.world();
            // Blocks of a land, of which one is seen after the other.
            let block = frame / 8;
            let away = [12.0, -12.0, 30.0, -30.0, 3.0][block as usize];
            sketch.modelview = view * Mat4::from_translation(Vec3::new(away, 0.0, 2.0 * away));
            let at = |i: u32| [((7 * block + 3 * i) % 10) as f32, ((5 * block + 7 * i) % 9) as f32];
            sketch.draw(&alike([0, 1, 2, 3].map(at)));
        });
        verdicts.push(verdict(&scene, 1));
    }
    assert!(verdicts.iter().all(|verdict| verdict.class != Class::Dynamic));
    let names: Vec<u64> = verdicts.chunks(8).map(|block| block[7].object).collect();
    assert!((1..5).all(|i| !names[..i].contains(&names[i])), "{names:x?}");
}

#[test]
fn what_comes_into_view_as_something_like_it_goes_has_not_changed() {
    let mut recovery = Recovery::new();
    for frame in 0..30 {
        let scene = understand(frame, &mut recovery, |sketch, view| {
            sketch.modelview = view;
            sketch.world();
            // Of alike posts all over the place, four are in sight: always the first, and three others each time.
            let at = |i: u32| match i {
                0 => [0.0, 0.0],
                _ => [((7 * frame + 3 * i) % 11) as f32 * 3.0, ((5 * frame + 7 * i) % 13) as f32 * 3.0],
            };
            sketch.draw(&alike([0, 1, 2, 3].map(at)));
        });
        assert!(scene.verdicts.iter().all(|v| v.class != Class::Dynamic), "frame {frame}");
    }
}

#[test]
fn a_lift_that_the_program_moves_is_animated() {
    let mut recovery = Recovery::new();
    for frame in 0..12 {
        let scene = understand(frame, &mut recovery, |sketch, view| {
            sketch.modelview = view;
            sketch.world();
            let lift = alike([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [2.0, 2.0]]);
            let height = Vec3::Y * (0.2 * frame as f32).sin();
            sketch.draw(&lift.into_iter().map(|corner| corner + height).collect::<Vec<_>>());
        });
        assert!(frame < 3 || scene.verdicts[1].class == Class::Dynamic, "frame {frame}");
    }
}

#[test]
fn a_cut_within_the_world_keeps_it_and_another_world_begins_anew() {
    let mut recovery = Recovery::new();
    let mut world = |frame: u32, scale: f32, count: usize| {
        understand(frame, &mut recovery, |sketch, view| {
            sketch.modelview = view;
            let corners: Vec<Vec3> = floor().into_iter().map(|corner| corner * scale).collect();
            sketch.draw(&corners[..count]);
        })
    };
    let first: Vec<Scene> = (0..6).map(|frame| world(frame, 1.0, 60)).collect();
    let cut = world(900, 1.0, 60);
    assert_eq!((cut.epoch, cut.verdicts[0].object), (first[5].epoch, first[5].verdicts[0].object));
    assert!(is_same_step([&first[5], &cut], [5, 900]));
    let other = world(901, 2.5, 54);
    assert_ne!(other.epoch, cut.epoch);
}
