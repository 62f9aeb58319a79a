//! What is remembered of a world whose view, materials and level change: whole frames, and what is handed over.

use std::f32::consts::PI;
use std::path::PathBuf;

use afterglow_gl::frame::{BaseFormat, Hint, HintClass, HintMaterial, Operation};
use glam::{Mat4, Vec3};

use crate::testing::{Sketch, floor, thing};
use crate::types::{Class, MISSING_FRAMES, Scene};
use crate::{ProgramCache, Recovery};

/// Frames after which nothing is left of what is gone; `ARCHITECTURE.md` states it.
const GONE: u32 = MISSING_FRAMES + 4;

/// From the middle of the floor, turned about the vertical axis.
fn camera(turned: f32) -> Mat4 {
    Mat4::from_rotation_y(turned) * Mat4::from_translation(Vec3::new(0.0, -3.0, 0.0))
}

/// A thing before the camera that has not turned.
fn ahead() -> Vec<Vec3> {
    thing(2.0).into_iter().map(|corner| corner + Vec3::new(0.0, 3.0, -12.0)).collect()
}

fn understand(recovery: &mut Recovery, turned: f32, draw: impl FnOnce(&mut Sketch)) -> Scene {
    let mut sketch = Sketch::new();
    sketch.modelview = camera(turned);
    sketch.world();
    draw(&mut sketch);
    recovery.understand(&mut sketch.frame)
}

/// Whether a scene has an unseen triangle with a corner there.
fn has(scene: &Scene, corner: Vec3) -> bool {
    let mut triangles = scene.unseen.iter().flat_map(|unseen| unseen.passes[0].triangles(unseen.model));
    triangles.any(|triangle| triangle.is_some_and(|t| t.iter().any(|c| c.abs_diff_eq(corner, 1e-3))))
}

fn of_material(emission: [f32; 3]) -> Hint {
    let material = HintMaterial { emission: Some(emission), ..HintMaterial::default() };
    Hint { class: Some(HintClass::Static), material, ..Hint::default() }
}

fn say(sketch: &mut Sketch, hint: Hint) {
    sketch.frame.hints.push(hint);
    sketch.hint = sketch.frame.hints.len() as u32;
}

#[test]
fn what_gives_off_light_does_so_when_it_is_not_drawn() {
    let mut recovery = Recovery::new();
    let glow = [4.0, 2.0, 1.0];
    for _ in 0..4 {
        let scene = understand(&mut recovery, 0.0, |sketch| {
            say(sketch, of_material(glow));
            sketch.draw(&ahead());
        });
        assert_eq!(scene.verdicts[1].class, Class::Static);
    }
    let scene = understand(&mut recovery, PI, |_| {});
    let said: Vec<_> = scene.unseen.iter().map(|unseen| unseen.passes[0].look.said.emission).collect();
    assert!(has(&scene, ahead()[0]));
    assert!(said.contains(&Some(glow)), "{said:?}");
}

#[test]
fn what_looks_otherwise_by_what_is_said_is_not_what_is_remembered() {
    let mut recovery = Recovery::new();
    let mut frame = |emission: f32, draws_floor: bool| {
        let mut sketch = Sketch::new();
        sketch.modelview = camera(0.0);
        say(&mut sketch, of_material([emission; 3]));
        sketch.draw(&ahead());
        say(&mut sketch, of_material([0.0; 3]));
        let part = if draws_floor { 60 } else { 54 };
        sketch.draw(&floor()[..part]);
        recovery.understand(&mut sketch.frame)
    };
    for _ in 0..4 {
        frame(1.0, true);
    }
    assert!(frame(1.0, false).covered.contains(&0));
    assert!(!frame(2.0, false).covered.contains(&0));
}

#[test]
fn a_map_that_is_dropped_takes_what_it_covers_along() {
    let mut recovery = Recovery::new();
    let mut maps = Sketch::new();
    let image = maps.texture(0, BaseFormat::Rgb, &[[255; 4]]);
    let map = maps.bindings[0];
    let material = HintMaterial { emission_map: map, ..HintMaterial::default() };
    recovery.understand(&mut maps.frame);
    for _ in 0..4 {
        understand(&mut recovery, 0.0, |sketch| {
            say(sketch, Hint { class: Some(HintClass::Static), material, ..Hint::default() });
            sketch.draw(&ahead());
        });
    }
    let dropped = understand(&mut recovery, PI, |sketch| {
        sketch.frame.operations.push(Operation::DropImage(image));
    });
    assert!(has(&dropped, ahead()[0]), "it was still there in this frame");
    assert!(!has(&understand(&mut recovery, PI, |_| {}), ahead()[0]));
}

#[test]
fn a_change_of_coordinates_loses_nothing() {
    let mut recovery = Recovery::new();
    // What is largest at first has a matrix of its own, which is taken for the view, and then goes out of sight.
    let model = Mat4::from_translation(Vec3::new(0.0, -5.0, 0.0)) * Mat4::from_rotation_y(0.6);
    let large: Vec<Vec3> = floor().into_iter().map(|corner| 2.0 * corner).collect();
    let view = |number: u32| camera(0.02 * number as f32 + if number < 4 { 0.0 } else { PI });
    let frame = |recovery: &mut Recovery, number: u32, draws_it: bool| {
        let mut sketch = Sketch::new();
        sketch.modelview = view(number) * model;
        if draws_it {
            sketch.draw(&large);
        }
        sketch.modelview = view(number);
        sketch.world();
        recovery.understand(&mut sketch.frame)
    };
    let is_own =
        |scene: &Scene, number: u32| scene.camera.unwrap().view.abs_diff_eq(view(number).as_dmat4(), 1e-4);
    let first: Vec<Scene> = (0..4).map(|number| frame(&mut recovery, number, true)).collect();
    assert!(!is_own(&first[3], 3));
    let mut settled = 4;
    let scene = loop {
        let scene = frame(&mut recovery, settled, false);
        let corner = scene.camera.unwrap().view.as_mat4().inverse() * view(settled) * model;
        assert!(has(&scene, corner.transform_point3(large[0])), "frame {settled}");
        if is_own(&scene, settled) {
            break scene;
        }
        settled += 1;
        assert!(settled <= 12, "the world gets the program's coordinates");
    };
    assert!(scene.epoch > first[3].epoch);
    // What is drawn there again is known: nothing is remembered twice.
    let before = recovery.memory().entries;
    frame(&mut recovery, 3, true);
    assert_eq!(recovery.memory().entries, before);
}

#[test]
fn another_level_has_no_ghosts_from_its_first_frame_on() {
    let mut recovery = Recovery::new();
    for _ in 0..6 {
        understand(&mut recovery, 0.0, |sketch| {
            sketch.draw(&ahead());
        });
    }
    let before = understand(&mut recovery, PI, |_| {});
    assert!(has(&before, ahead()[0]));
    let level: Vec<Vec3> = floor().into_iter().map(|corner| corner * 2.5).collect();
    for frame in 0..2 * GONE {
        let mut sketch = Sketch::new();
        sketch.modelview = camera(0.01 * frame as f32);
        sketch.draw(&level[..54]);
        let scene = recovery.understand(&mut sketch.frame);
        assert!(scene.epoch > before.epoch && scene.unseen.is_empty(), "frame {frame}");
    }
}

fn folder(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("afterglow-kept-{name}-{}", std::process::id()))
}

#[test]
fn the_next_run_knows_what_this_one_saw() {
    let folder = folder("next");
    let cache = ProgramCache::new(&folder, "/usr/games/game".as_ref());
    // Pieces of several colours: a world of a few cells.
    let draw = |sketch: &mut Sketch, draws_it: bool| {
        for number in 0..6 {
            sketch.color = [number as f32 / 8.0, 1.0, 1.0, 1.0];
            let aside = Vec3::new(6.0 * number as f32 - 15.0, 0.0, -8.0);
            let piece: Vec<Vec3> = floor().into_iter().map(|corner| 0.05 * corner + aside).collect();
            sketch.draw(&piece);
        }
        if draws_it {
            say(sketch, of_material([3.0; 3]));
            sketch.draw(&ahead());
        }
    };
    let run = |draws_it: bool| {
        let mut recovery = Recovery::new();
        recovery.set_cache(&cache);
        let mut scene = Scene::default();
        for frame in 0..40 {
            // In the second run the camera has looked elsewhere.
            let turned = if frame > 36 { PI } else { 0.0 };
            scene = understand(&mut recovery, turned, |sketch| {
                if turned == 0.0 {
                    draw(sketch, draws_it);
                }
            });
        }
        scene
    };
    assert!(has(&run(true), ahead()[0]));
    let mut recovery = Recovery::new();
    recovery.set_cache(&cache);
    let mut scene = Scene::default();
    for _ in 0..18 {
        scene = understand(&mut recovery, 0.0, |sketch| draw(sketch, false));
    }
    assert!(has(&scene, ahead()[0]), "it comes from the run before");
    let glows = |unseen: &crate::Unseen| unseen.passes[0].look.said.emission == Some([3.0; 3]);
    assert!(scene.unseen.iter().any(glows));
    // It is not drawn where it should be visible: it is gone as all else is.
    for _ in 0..GONE {
        scene = understand(&mut recovery, 0.0, |sketch| draw(sketch, false));
    }
    assert!(!has(&scene, ahead()[0]));
    drop(recovery);
    assert!(!has(&run(false), ahead()[0]), "nor does the run after know of it");
    drop(std::fs::remove_dir_all(folder));
}

#[test]
fn a_damaged_file_is_nothing_and_is_replaced() {
    let folder = folder("damaged");
    let cache = ProgramCache::new(&folder, "/usr/games/game".as_ref());
    std::fs::create_dir_all(cache.worlds.parent().unwrap()).unwrap();
    let run = || {
        let mut recovery = Recovery::new();
        recovery.set_cache(&cache);
        for _ in 0..20 {
            understand(&mut recovery, 0.0, |sketch| {
                for number in 0..6 {
                    sketch.color = [number as f32 / 8.0, 1.0, 1.0, 1.0];
                    let aside = Vec3::X * (6.0 * number as f32 - 15.0);
                    sketch.draw(&ahead().into_iter().map(|corner| corner + aside).collect::<Vec<_>>());
                }
            });
        }
        understand(&mut recovery, PI, |_| {});
    };
    run();
    let sound = std::fs::read(&cache.worlds).unwrap();
    for damaged in [&sound[..sound.len() / 2], b"", b"something else", &[sound.as_slice(), b"more"].concat()]
    {
        std::fs::write(&cache.worlds, damaged).unwrap();
        run();
        assert_eq!(std::fs::read(&cache.worlds).unwrap(), sound);
    }
    drop(std::fs::remove_dir_all(folder));
}
