//! Triangles that are none, next to ones that are: they cost themselves only.

use afterglow_extremes::{
    Picture, Shot, World, icosphere, lambert, metal, pathtrace, reference, shining, staged,
};
use afterglow_render::Mode;
use afterglow_scene_file::{Object, SequenceFrame, Stage};
use glam::{DMat4, DVec3, Vec3};

use crate::closed_forms::{floor, room};
use crate::views::{assert_alike, mirrored};

/// The room, its triangles as they are but for `bad` among them, in the same draws and in others.
fn among(bad: &[[Vec3; 3]]) -> World {
    let mut world = room(16).with(bad.to_vec(), shining(5.0, 0.5)).with(bad.to_vec(), metal(0.2));
    let all = &mut world.file.triangles;
    for triangle in bad {
        let first = all.positions.len() as u32;
        all.positions.extend(triangle);
        for material in 0..3 {
            all.corners.insert(0, [first, first + 1, first + 2]);
            all.materials.insert(0, material);
        }
    }
    world
}

fn assert_unharmed(bad: &[[Vec3; 3]], what: &str) {
    let expected = reference(&room(16), &Shot::of(96));
    let world = among(bad);
    let picture = reference(&world, &Shot::of(96).with(|options| options.seed = 1));
    picture.assert_sound(what);
    picture.assert_same(&expected, 8, 0.0, what);
    pathtrace(&world, &Shot::of(4)).assert_sound(what);
}

#[test]
fn triangles_without_area() {
    let [a, b] = [Vec3::new(0.1, 0.0, -0.2), Vec3::new(0.4, 0.3, 0.1)];
    let middle = a.midpoint(b);
    assert_unharmed(&[[a, a, a], [a, a, b], [a, b, a], [b, a, a], [a, middle, b], [a, b, middle]], "no area");
}

#[test]
fn corners_that_are_no_numbers() {
    let [a, b, c] = [Vec3::new(0.1, 0.0, -0.2), Vec3::new(0.4, 0.3, 0.1), Vec3::new(0.1, 0.5, 0.0)];
    let mut bad = Vec::new();
    for number in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, -3e38] {
        for axis in 0..3 {
            let mut lost = c;
            lost[axis] = number;
            bad.extend([[a, b, lost], [lost, a, b], [lost, lost, lost]]);
        }
    }
    let finite: Vec<_> =
        bad.iter().copied().filter(|corners| corners.iter().any(|corner| !corner.is_finite())).collect();
    assert_unharmed(&finite, "corners that are no numbers");
    // Huge ones are triangles, and may be seen.
    let world = among(&bad);
    reference(&world, &Shot::of(4)).assert_sound("huge triangles");
    pathtrace(&world, &Shot::of(4)).assert_sound("huge triangles");
}

#[test]
fn denormal_triangles() {
    let tiny = |size: f32| [Vec3::ZERO, Vec3::X * size, Vec3::Y * size];
    let bad = [1e-18, 1e-20, 1e-30, 1e-38, 1e-42, 1e-45].map(tiny);
    assert_unharmed(&bad, "tiny triangles");
}

/// A floor of slivers is a floor.
#[test]
fn slivers() {
    let eye = |world: World| world.seen_from(DVec3::new(1.0, 2.0, 2.0), DVec3::ZERO, 0.7);
    let lit = || World::new(16).sky(0.2).lamp(DVec3::new(0.3, 1.0, 0.2), 0.2, 5.0);
    let expected = reference(&eye(lit().with(floor(2.0), lambert(0.7))), &Shot::of(64));
    let corners = [
        Vec3::new(-2.0, 0.0, -2.0),
        Vec3::new(-2.0, 0.0, 2.0),
        Vec3::new(2.0, 0.0, 2.0),
        Vec3::new(2.0, 0.0, -2.0),
    ];
    for aspect in [1e3, 1e5, 1e6, 1e7] {
        // A strip along the diagonal.
        let across = Vec3::new(2.0, 0.0, 2.0) / aspect;
        let [a, b, c, d] = corners;
        let slivers = vec![[a, b - across, c], [a - across, b, c], [b, c - across, b + across], [a, c, d]];
        let picture = reference(
            &eye(lit().with(slivers, lambert(0.7))),
            &Shot::of(64).with(|options| options.seed = 1),
        );
        picture.assert_sound("slivers");
        picture.assert_same(&expected, 8, 1e-3, &format!("aspect {aspect}"));
    }
}

/// A ball in the room as an object under a matrix: `corners` takes its triangles to the object's space.
fn with_ball(matrix: DMat4, corners: impl Fn(Vec3) -> Vec3) -> World {
    let ball = icosphere(Vec3::new(0.2, -0.4, -0.2), 0.3, 1);
    let mut world = room(16);
    let first_triangle = world.file.triangles.corners.len();
    world = world.with(ball.iter().map(|triangle| triangle.map(&corners)), lambert(0.9));
    let file = &mut world.file;
    file.objects.push(Object { name: "ball".into(), first_triangle, triangle_count: ball.len() });
    file.frames.push(SequenceFrame {
        view: file.view,
        transforms: vec![(0, matrix)],
        emission_scales: Vec::new(),
        light_scales: Vec::new(),
        sphere_light_scale: 1.0,
        sun_scale: 1.0,
        sky_scale: 1.0,
    });
    world
}

fn both(world: &World, seed: u32) -> [Picture; 2] {
    let stage = Stage::new(world.file.clone()).unwrap();
    let shot = Shot::of(96).with(|options| options.seed = seed);
    [Mode::Reference, Mode::Pathtrace].map(|mode| shot.render(mode, stage.staged(0)))
}

/// Objects far from round, under matrices that make them round.
#[test]
fn matrices_of_any_scale() {
    let expected = both(&with_ball(DMat4::IDENTITY, |corner| corner), 0);
    for scale in [
        DVec3::new(1e3, 1e-3, 1.0),
        DVec3::new(1e-3, 1e3, 1.0),
        DVec3::splat(1e-6),
        DVec3::new(1.0, 1.0, 1e6),
    ] {
        let world = with_ball(DMat4::from_scale(scale), |corner| (corner.as_dvec3() / scale).as_vec3());
        assert_alike(&both(&world, 1), &expected, &format!("scale {scale}"));
    }
    for scale in [DVec3::new(-1.0, 1.0, 1.0), DVec3::new(-1.0, -2.0, -1.0)] {
        let world = with_ball(DMat4::from_scale(scale), |corner| (corner.as_dvec3() / scale).as_vec3());
        assert_alike(&both(&world, 1), &expected, &format!("mirrored by {scale}"));
    }
}

/// What a matrix makes flat stays a surface: a shadow as programs draw them.
#[test]
fn flattened_objects() {
    let flat = |corner: Vec3| Vec3::new(corner.x, -0.6, corner.z);
    let matrix =
        DMat4::from_translation(DVec3::new(0.0, -0.6, 0.0)) * DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0));
    let expected = both(&with_ball(DMat4::IDENTITY, flat), 0);
    assert_alike(&both(&with_ball(matrix, |corner| corner), 1), &expected, "flattened");
    for bad in [
        DMat4::ZERO,
        DMat4::from_cols_array(&[f64::NAN; 16]),
        DMat4::from_scale(DVec3::splat(1e-30)),
        DMat4::from_scale(DVec3::splat(f64::INFINITY)),
    ] {
        for picture in both(&with_ball(bad, |corner| corner), 0) {
            picture.assert_sound(&format!("a matrix {bad}"));
        }
    }
}

/// A room under a mirroring matrix is the mirrored room, lights that are triangles too.
#[test]
fn mirrored_rooms() {
    let mut world = room(16);
    let count = world.file.triangles.corners.len();
    world.file.objects.push(Object { name: "all".into(), first_triangle: 0, triangle_count: count });
    let mirror = DVec3::new(-1.0, 1.0, 1.0);
    world.file.sphere_lights.iter_mut().for_each(|light| light.center *= mirror);
    world.file.sun.iter_mut().for_each(|sun| sun.direction *= mirror);
    let view = &mut world.file.view;
    view.modelview = DMat4::from_scale(mirror) * view.modelview * DMat4::from_scale(mirror);
    let still = SequenceFrame {
        view: *view,
        transforms: vec![(0, DMat4::from_scale(mirror))],
        emission_scales: Vec::new(),
        light_scales: Vec::new(),
        sphere_light_scale: 1.0,
        sun_scale: 1.0,
        sky_scale: 1.0,
    };
    world.file.frames.push(still);
    let pictures = both(&world, 1).map(|picture| mirrored(&picture));
    let expected =
        [Mode::Reference, Mode::Pathtrace].map(|mode| Shot::of(96).render(mode, staged(&room(16))));
    assert_alike(&pictures, &expected, "a mirrored room");
}
