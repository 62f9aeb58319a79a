//! What stays, what goes, and what it takes.

use std::sync::Arc;

use afterglow_gl::frame::{
    BaseFormat, BlendFactor, Compare, Cull, Format, Operation, RetainedRange, Slot, VertexLayout,
};
use glam::{Mat4, Vec3};

use super::{MISSING_FRAMES, TEST_INTERVAL};
use crate::Recovery;
use crate::images::Images;
use crate::testing::{Sketch, perspective};
use crate::types::Scene;

/// Frames after which what is gone is surely forgotten.
const GONE: u32 = MISSING_FRAMES + TEST_INTERVAL;

/// A camera at a height that looks along the ground, turned about the vertical axis.
fn camera(turned: f32) -> Mat4 {
    Mat4::from_rotation_y(turned) * Mat4::from_translation(Vec3::new(0.0, -2.0, 0.0))
}

/// A square wall across the z axis, of two triangles that face `z = +inf`.
fn wall(z: f32, half: f32) -> Vec<Vec3> {
    let corners = [[-1.0, 0.0], [1.0, 0.0], [1.0, 2.0], [-1.0, 2.0]];
    let [a, b, c, d] = corners.map(|[x, y]| Vec3::new(x * half, y * half, z));
    vec![a, b, c, a, c, d]
}

/// Ground all about, in pieces that a program culls one by one.
fn ground() -> Vec<Vec<Vec3>> {
    let piece = |x: i32, z: i32| {
        let [x, z] = [x, z].map(|i| i as f32 * 20.0);
        let corner = |i: f32, j: f32| Vec3::new(x + i * 10.0, 0.0, z + j * 10.0);
        let [a, b, c, d] = [corner(-1., -1.), corner(-1., 1.), corner(1., 1.), corner(1., -1.)];
        vec![a, b, c, a, c, d]
    };
    (-4..=4).flat_map(|x| (-4..=4).map(move |z| piece(x, z))).collect()
}

/// A program that draws the ground and some walls, and leaves out what is behind the camera.
struct Program {
    recovery: Recovery,
    turned: f32,
    change: fn(&mut Sketch),
}

impl Program {
    fn new() -> Program {
        Program { recovery: Recovery::new(), turned: 0.0, change: |_| {} }
    }

    fn frame(&mut self, walls: &[Vec<Vec3>]) -> Scene {
        let mut sketch = Sketch::new();
        (self.change)(&mut sketch);
        sketch.modelview = camera(self.turned);
        let shows = |thing: &&Vec<Vec3>| {
            thing.iter().any(|corner| {
                let clip = perspective() * sketch.modelview * corner.extend(1.0);
                clip.w > 0.0 && clip.x.abs() < clip.w
            })
        };
        let ground = ground();
        let shown: Vec<Vec3> = ground.iter().chain(walls).filter(shows).flatten().copied().collect();
        sketch.draw(&shown);
        self.recovery.understand(&mut sketch.frame)
    }

    /// Turns about, so fast as a player may.
    fn turn(&mut self, walls: &[Vec<Vec3>]) -> Scene {
        let mut scene = Scene::default();
        for step in 1..=16 {
            self.turned = step as f32 * std::f32::consts::PI / 16.0;
            scene = self.frame(walls);
        }
        scene
    }

    fn frames(&mut self, count: u32, walls: &[Vec<Vec3>]) -> Scene {
        let mut scene = Scene::default();
        for _ in 0..count {
            scene = self.frame(walls);
        }
        scene
    }
}

/// Whether a scene has an unseen triangle with a corner there.
fn has(scene: &Scene, corner: Vec3) -> bool {
    let mut found = false;
    for unseen in &scene.unseen {
        for triangle in unseen.passes[0].triangles(unseen.model).flatten() {
            found |= triangle.iter().any(|c| c.abs_diff_eq(corner, 1e-3));
        }
    }
    found
}

fn unseen_triangles(scene: &Scene) -> u32 {
    scene.unseen.iter().map(|unseen| unseen.passes[0].index_count / 3).sum()
}

/// A memory of ground and of walls with textures, and the images that it knows.
pub fn remembered() -> (super::Memory, Images) {
    let (mut memory, mut images) = (super::Memory::default(), Images::default());
    let mut textures = Vec::new();
    for _ in 0..4 {
        let mut sketch = Sketch::new();
        sketch.modelview = camera(0.0);
        sketch.draw(&ground().concat());
        for number in 0..3 {
            match textures.get(number) {
                None => textures.push(sketch.texture(0, BaseFormat::Rgb, &[[number as u8; 4]; 2])),
                Some(texture) => sketch.sample(0, *texture, BaseFormat::Rgb),
            }
            sketch.draw(&wall(-30.0 - number as f32, 5.0));
        }
        images.learn(&sketch.frame);
        let mut scene = Recovery::new().understand(&mut sketch.frame);
        memory.remember(&sketch.frame, &images, &mut scene);
    }
    for heap in std::mem::take(&mut memory.heaps).into_values() {
        memory.close(heap);
    }
    (memory, images)
}

#[test]
fn what_the_camera_turned_away_from_stays() {
    let mut program = Program::new();
    let walls = [wall(-30.0, 5.0)];
    assert_eq!(unseen_triangles(&program.frames(4, &walls)), 0);
    for step in 1..=32 {
        program.turned = step as f32 * 0.1;
        program.frame(&walls);
    }
    let scene = program.frames(60, &walls);
    assert!(has(&scene, walls[0][0]) && has(&scene, walls[0][2]));
    let counts = program.recovery.memory();
    assert!(counts.entries >= 120, "{counts:?}");
}

#[test]
fn what_is_seen_less_than_three_times_is_not_remembered() {
    let mut program = Program::new();
    program.frames(2, &[wall(-30.0, 5.0)]);
    program.turned = std::f32::consts::PI;
    let scene = program.frames(3, &[]);
    assert_eq!(unseen_triangles(&scene), 0);
}

#[test]
fn a_door_that_opened_leaves_no_ghost() {
    let mut program = Program::new();
    let (door, behind) = (wall(-10.0, 2.0), wall(-30.0, 30.0));
    program.frames(5, &[door.clone(), behind.clone()]);
    let open = [behind];
    assert!(has(&program.frame(&open), door[0]));
    let scene = program.frames(GONE, &open);
    assert_eq!(unseen_triangles(&scene), 0);
    // Shut again, it is as new.
    let shut = [door.clone(), open[0].clone()];
    program.frames(3, &shut);
    assert!(has(&program.turn(&shut), door[0]));
}

#[test]
fn a_bridge_before_the_sky_that_fell_leaves_no_ghost() {
    let mut program = Program::new();
    let bridge: Vec<Vec3> = wall(-20.0, 4.0).into_iter().map(|corner| corner + Vec3::Y * 6.0).collect();
    program.frames(5, std::slice::from_ref(&bridge));
    assert!(has(&program.frame(&[]), bridge[0]));
    assert!(!has(&program.frames(GONE, &[]), bridge[0]));
}

#[test]
fn what_is_hidden_stays() {
    let mut program = Program::new();
    let (hidden, before) = (wall(-30.0, 3.0), wall(-10.0, 10.0));
    program.frames(4, std::slice::from_ref(&hidden));
    let scene = program.frames(100, &[before]);
    assert!(has(&scene, hidden[0]) && has(&scene, hidden[2]));
}

#[test]
fn what_turns_its_back_stays_unless_both_sides_are_drawn() {
    let behind_the_back = |cull: fn(&mut Sketch)| {
        let mut program = Program::new();
        program.change = cull;
        // Seen from its front once, from its back later: the camera is on the other side after a half turn.
        let mut back = wall(-30.0, 5.0);
        program.frames(4, std::slice::from_ref(&back));
        let corner = back[0];
        back.clear();
        let mut sketch = Sketch::new();
        let mut scene = Scene::default();
        for _ in 0..4 * GONE {
            sketch = Sketch::new();
            cull(&mut sketch);
            sketch.modelview = Mat4::from_rotation_y(std::f32::consts::PI)
                * Mat4::from_translation(Vec3::new(0.0, -2.0, 50.0));
            let ground: Vec<Vec3> = ground().into_iter().flatten().collect();
            sketch.draw(&ground);
            scene = program.recovery.understand(&mut sketch.frame);
        }
        drop(sketch);
        has(&scene, corner)
    };
    assert!(behind_the_back(|sketch| {
        (sketch.fixed.raster.cull, sketch.fixed.raster.front_ccw) = (Cull::Back, true);
    }));
    assert!(behind_the_back(|_| {}), "it was never seen from there");
}

#[test]
fn another_level_has_no_ghosts() {
    let mut program = Program::new();
    let walls = [wall(-30.0, 5.0)];
    program.frames(4, &walls);
    assert!(unseen_triangles(&program.turn(&walls)) > 0);
    let mut memory = super::Memory::default();
    let mut scene = program.frame(&walls);
    let mut sketch = Sketch::new();
    sketch.modelview = camera(0.0);
    sketch.world();
    for epoch in [1, 1, 1, 2] {
        scene.epoch = epoch;
        memory.remember(&sketch.frame, &Images::default(), &mut scene);
    }
    assert_eq!(memory.epoch, 2);
    assert!(scene.unseen.is_empty() && memory.cells.is_empty());
}

#[test]
fn an_image_that_is_dropped_takes_what_it_covers_along() {
    let mut recovery = Recovery::new();
    let mut sketch = Sketch::new();
    sketch.modelview = camera(0.0);
    let image = sketch.texture(0, BaseFormat::Rgb, &[[200; 4]; 2]);
    sketch.draw(&wall(-30.0, 5.0));
    sketch.unbind(0);
    sketch.world();
    for _ in 0..4 {
        recovery.understand(&mut sketch.frame);
        sketch.frame.operations.retain(|operation| matches!(operation, Operation::Draw(_)));
    }
    let mut other = Sketch::new();
    other.modelview = camera(std::f32::consts::PI);
    other.world();
    assert!(has(&recovery.understand(&mut other.frame), wall(-30.0, 5.0)[0]));
    other.frame.operations.push(Operation::DropImage(image));
    recovery.understand(&mut other.frame);
    other.frame.operations.pop();
    assert!(!has(&recovery.understand(&mut other.frame), wall(-30.0, 5.0)[0]));
}

#[test]
fn lightmaps_stay_on_what_they_light() {
    let mut recovery = Recovery::new();
    let mut image = None;
    for _ in 0..4 {
        let mut sketch = Sketch::new();
        sketch.modelview = camera(0.0);
        sketch.draw(&ground().concat());
        sketch.draw(&wall(-30.0, 5.0));
        sketch.depth(Some((Compare::LessEqual, false)));
        sketch.blend(Some((BlendFactor::DestinationColor, BlendFactor::Zero)));
        let lightmap = *image.get_or_insert_with(|| sketch.texture(0, BaseFormat::Rgb, &[[90; 4]; 2]));
        sketch.sample(0, lightmap, BaseFormat::Rgb);
        sketch.draw(&wall(-30.0, 5.0));
        recovery.understand(&mut sketch.frame);
    }
    let mut sketch = Sketch::new();
    sketch.modelview = camera(std::f32::consts::PI);
    sketch.draw(&ground().concat());
    let scene = recovery.understand(&mut sketch.frame);
    let unseen = scene.unseen.iter().find(|unseen| unseen.passes.len() == 2).unwrap();
    let [base, layer] = &*unseen.passes else { panic!("{unseen:?}") };
    assert_eq!((base.index_count, layer.index_count), (6, 6));
    assert!(unseen.baked);
    assert_eq!(layer.look.images().next(), image);
    let corners = |pass: &super::Pass| pass.triangles(Mat4::IDENTITY).flatten().collect::<Vec<_>>();
    assert_eq!(corners(base), corners(layer));
}

#[test]
fn draws_of_retained_ranges_are_kept_whole_and_without_a_copy() {
    let layout = VertexLayout::default().with(Slot::Position as usize, Format::F3);
    let words = wall(-30.0, 5.0).iter().flat_map(|corner| corner.to_array().map(f32::to_bits)).collect();
    let range = Arc::new(RetainedRange::new(layout, words, (0..6).collect()));
    let mut recovery = Recovery::new();
    for _ in 0..3 {
        let mut sketch = Sketch::new();
        sketch.modelview = camera(0.0);
        sketch.draw(&ground().concat());
        sketch.draw_retained(&range, 0, 6);
        assert!(recovery.understand(&mut sketch.frame).unseen.is_empty());
    }
    let mut sketch = Sketch::new();
    sketch.modelview = camera(std::f32::consts::PI);
    sketch.draw(&ground().concat());
    let scene = recovery.understand(&mut sketch.frame);
    assert!(Arc::ptr_eq(&scene.unseen[0].passes[0].range, &range));
    for _ in 0..GONE {
        let mut sketch = Sketch::new();
        sketch.modelview = camera(0.0);
        sketch.draw(&ground().concat());
        recovery.understand(&mut sketch.frame);
    }
    let mut sketch = Sketch::new();
    sketch.modelview = camera(0.0);
    sketch.draw(&ground().concat());
    assert!(recovery.understand(&mut sketch.frame).unseen.is_empty(), "it should be visible");
}

#[test]
fn the_bound_holds_and_the_farthest_leaves_first() {
    let mut program = Program::new();
    program.recovery.set_memory(40_000);
    for step in 0..63 {
        program.turned = step as f32 * 0.1;
        program.frames(3, &[]);
        assert!(program.recovery.memory().bytes <= 40_000);
    }
    let near_and_far = |limit: u64| {
        let mut program = Program::new();
        program.recovery.set_memory(limit);
        let walls: Vec<_> = (0..2000).map(|i| wall(-2.0 - i as f32 * 0.1, 0.01)).collect();
        // Each of a look of its own, so that each is a cell.
        for _ in 0..3 {
            let mut sketch = Sketch::new();
            sketch.modelview = camera(0.0);
            sketch.draw(&ground().concat());
            for (number, wall) in walls.iter().enumerate() {
                sketch.color = [number as f32, 0.0, 0.0, 1.0];
                sketch.draw(wall);
            }
            program.recovery.understand(&mut sketch.frame);
        }
        let mut sketch = Sketch::new();
        sketch.modelview = camera(std::f32::consts::PI);
        sketch.draw(&ground().concat());
        let scene = program.recovery.understand(&mut sketch.frame);
        (has(&scene, walls[0][0]), has(&scene, walls[1999][0]))
    };
    assert_eq!(near_and_far(1 << 24), (true, true));
    assert_eq!(near_and_far(300_000), (true, false));
    assert_eq!(near_and_far(0), (false, false));
}

#[test]
fn small_cells_grow_together_and_nothing_is_lost() {
    let mut program = Program::new();
    // Walls that come one after the other, as a program finds them while the camera goes on.
    let walls: Vec<_> = (0..60).map(|i| wall(-100.0 + i as f32, 0.5)).collect();
    for first in 0..58 {
        program.frame(&walls[first..first + 3]);
    }
    let scene = program.turn(&walls[55..]);
    let kept = (2..58).filter(|&i| has(&scene, walls[i][0])).count();
    assert!(kept >= 50, "{kept}");
    assert!(program.recovery.memory().cells < 20, "{:?}", program.recovery.memory());
}

#[test]
fn two_runs_give_the_same_bits() {
    let run = || {
        let mut program = Program::new();
        let mut bytes = Vec::new();
        for step in 0..40 {
            program.turned = step as f32 * 0.15;
            for unseen in program.frame(&[wall(-30.0, 5.0), wall(20.0, 3.0)]).unseen {
                bytes.extend(unseen.passes.iter().map(|pass| pass.range.content_hash()));
            }
        }
        bytes
    };
    let first = run();
    assert!(first.len() > 20);
    assert_eq!(first, run());
}

#[test]
fn draws_within_what_is_handed_over_are_told_unless_they_look_otherwise() {
    let mut recovery = Recovery::new();
    let mut frame = |turned: f32, color: f32| {
        let mut sketch = Sketch::new();
        sketch.modelview = camera(turned);
        let floor = sketch.draw(&ground().concat());
        sketch.color = [color, 1.0, 1.0, 1.0];
        let wall = if turned == 0.0 { Some(sketch.draw(&wall(-30.0, 5.0))) } else { None };
        (recovery.understand(&mut sketch.frame), floor as u32, wall.map(|wall| wall as u32))
    };
    for _ in 0..4 {
        assert!(frame(0.0, 1.0).0.covered.is_empty());
    }
    let (scene, floor, _) = frame(1.5, 1.0);
    assert_eq!(scene.covered, [floor]);
    assert!(unseen_triangles(&scene) >= 2 * 81 + 2);
    // Drawn otherwise, it is not what is remembered; all drawn, nothing is handed over.
    let (scene, ..) = frame(0.0, 0.5);
    assert!(scene.covered.is_empty() && scene.unseen.is_empty());
}
