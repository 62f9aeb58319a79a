//! Closed forms that every picture must meet: white furnaces, lights over a surface, a closed box.

use std::f64::consts::PI;

use afterglow_extremes::{Estimate, Shot, World, cube, icosphere, lambert, metal, quad, reference, shining};
use afterglow_render::{LightChoice, Target};
use glam::{DVec3, Vec3};

/// Rounding of f32 over a path.
const ROUNDING: f64 = 2e-5;
const TARGETS: [Target; 3] = [Target::Direct, Target::Bounce1, Target::Full];

/// A square of the plane y = 0 about the origin, its front above.
pub(crate) fn floor(half: f32) -> Vec<[Vec3; 3]> {
    quad(Vec3::new(-half, 0.0, -half), Vec3::Z * 2.0 * half, Vec3::X * 2.0 * half)
}

/// Looks at the middle of a floor, at so little of it that light is the same all over the picture.
pub(crate) fn spot(world: World, eye: DVec3) -> World {
    world.seen_from(eye, DVec3::ZERO, 1e-4)
}

/// What the middle of a white floor shows.
fn shown(world: World, eye: DVec3, samples: u32) -> Estimate {
    let picture =
        reference(&spot(world, eye), &Shot::of(samples).with(|options| options.target = Target::Direct));
    picture.assert_sound("a floor");
    picture.whole()
}

/// A convex body under a uniform sky L shows albedo x L, whatever the number of bounces.
#[test]
fn convex_bodies_in_a_uniform_sky() {
    let bodies = [cube(Vec3::ZERO, 1.0), icosphere(Vec3::ZERO, 1.5, 2)];
    for (body, albedo, target) in bodies
        .iter()
        .flat_map(|body| [0.3, 0.8, 0.98, 1.0].map(|albedo| (body, albedo)))
        .flat_map(|(body, albedo)| TARGETS.map(|target| (body, albedo, target)))
    {
        let world = World::new(16).sky(2.0).with(body.clone(), lambert(albedo)).seen_from(
            DVec3::new(2.0, 3.0, 5.0),
            DVec3::ZERO,
            0.5,
        );
        let picture = reference(&world, &Shot::of(4).with(|options| options.target = target));
        picture.assert_sound("a body");
        picture.middle().assert(2.0 * f64::from(albedo), ROUNDING, "radiance of a convex body");
        if albedo == 1.0 {
            picture.whole().assert(2.0, ROUNDING, "a white body cannot be seen");
        }
    }
}

/// White GGX metal without multiple scattering; values by quadrature.
#[test]
fn metal_in_a_uniform_sky() {
    let rows = [
        (0.2, [0.9984, 0.99564, 0.97495]),
        (0.6, [0.82453, 0.77642, 0.79532]),
        (1.0, [0.30685, 0.40914, 0.51142]),
    ];
    for (roughness, albedos) in rows {
        for (cosine, albedo) in [1.0, 0.5, 0.2_f64].into_iter().zip(albedos) {
            let eye = DVec3::new((1.0 - cosine * cosine).sqrt(), cosine, 0.0) * 5.0;
            let world = spot(World::new(16).sky(1.0).with(floor(1.0), metal(roughness)), eye);
            let picture = reference(&world, &Shot::of(64));
            picture.assert_sound("metal");
            picture.whole().assert(albedo, 1e-4, &format!("roughness {roughness}, cosine {cosine}"));
        }
    }
}

/// Under the middle of a square light whose half side is its height.
#[test]
fn element_under_a_square_light() {
    for height in [1.0, 0.1, 1e-2, 1e-3] {
        let light = quad(Vec3::new(-height, height, -height), Vec3::X * 2.0 * height, Vec3::Z * 2.0 * height);
        let world = World::new(16).with(floor(1.0), lambert(0.5)).with(light, shining(3.0, 0.0));
        let eye = DVec3::new(1.2, 0.9, 0.0) * f64::from(height);
        shown(world, eye, 64).assert(0.5 * 3.0 * 0.554126, 1e-3, &format!("height {height}"));
    }
}

/// Under a ceiling of light that is far larger than high: it must not hide itself.
#[test]
fn element_under_a_ceiling() {
    for half in [1e2, 1e4, 1e6] {
        let light = quad(Vec3::new(-half, 1.0, -half), Vec3::X * 2.0 * half, Vec3::Z * 2.0 * half);
        let world = World::new(8).with(floor(1.0), lambert(0.5)).with(light, shining(3.0, 0.0));
        shown(world, DVec3::new(1.2, 0.9, 0.0), 512).assert(1.5, 1e-3, &format!("half side {half}"));
    }
}

/// A light without extent is the same in every sample.
#[test]
fn directional_light_on_a_diffuse_floor() {
    let world = World::new(8).with(floor(1.0), lambert(0.5)).sun(DVec3::new(0.6, 0.8, 0.0), 0.0, 6.0);
    let shown = shown(world, DVec3::new(0.0, 3.0, 4.0), 2);
    assert!((shown.mean / 0.763944 - 1.0).abs() < 1e-5 && shown.error < 1e-6, "{shown:?}");
}

/// A sun's irradiance does not depend on its size; its radiance does.
#[test]
fn sun_discs() {
    for angular_radius in [1e-4, 0.004675, 0.1] {
        let world = World::new(8).sun(DVec3::Y, angular_radius, 2.0);
        let floor = world.clone().with(floor(1.0), lambert(0.5));
        // The share that the floor's own rays have is too rare to be seen in so few samples.
        shown(floor, DVec3::new(0.0, 3.0, 4.0), 64).assert(
            1.0 / PI,
            1e-4,
            &format!("a floor under {angular_radius}"),
        );
        let disc = world.seen_from(DVec3::ZERO, DVec3::Y, 0.5 * angular_radius);
        let radiance = 2.0 / (PI * angular_radius.sin().powi(2));
        reference(&disc, &Shot::of(2)).whole().assert(radiance, 1e-4, "the disc");
    }
}

/// E = pi L (R / d)^2 while the sphere is above the horizon.
#[test]
fn sphere_lights_over_a_floor() {
    // Distance in radii, and an eye that is not behind the sphere.
    for (away, eye) in [
        (1.001, DVec3::new(0.1, 0.003, 0.0)),
        (1.1, DVec3::new(0.2, 0.06, 0.0)),
        (2.0, DVec3::new(3.0, 1.0, 0.0)),
        (10.0, DVec3::new(3.0, 1.0, 0.0)),
        (1e4, DVec3::new(3.0, 1.0, 0.0)),
        (1e5, DVec3::new(3.0, 1.0, 0.0)),
    ] {
        // So bright that the irradiance is pi.
        let world = World::new(8).with(floor(30.0), lambert(0.5)).lamp(DVec3::Y * away, 1.0, away * away);
        shown(world, eye, 128).assert(0.5, 1e-4, &format!("{away} radii away"));
    }
}

/// A closed box whose walls all shine: E (1 - rho^(K+1)) / (1 - rho) after K bounces.
#[test]
fn closed_box_that_shines() {
    for albedo in [0.5, 0.9_f64] {
        for (target, bounces) in TARGETS.into_iter().zip([1, 2, 64]) {
            let world = World::new(16).with(cube(Vec3::ZERO, -1.0), shining(0.5, albedo as f32)).seen_from(
                DVec3::new(0.3, 0.2, 0.1),
                DVec3::new(-1.0, -0.8, -0.9),
                1.0,
            );
            let picture = reference(&world, &Shot::of(64).with(|options| options.target = target));
            picture.assert_sound("a box");
            let value = 0.5 * (1.0 - albedo.powi(bounces + 1)) / (1.0 - albedo);
            picture.whole().assert(value, 1e-4, &format!("{target:?} of albedo {albedo}"));
        }
    }
}

/// A room with lights of all kinds, that is closed but for a window.
pub(crate) fn room(size: u32) -> World {
    let light = quad(Vec3::new(-0.3, 0.95, -0.3), Vec3::X * 0.6, Vec3::Z * 0.6);
    let window = quad(Vec3::new(-1.0, -1.0, 1.0), Vec3::X * 2.0, Vec3::Y * 1.2);
    let walls =
        cube(Vec3::ZERO, -1.0).into_iter().filter(|triangle| triangle.iter().any(|corner| corner.z < 0.0));
    World::new(size)
        .sky(0.4)
        .sun(DVec3::new(0.1, 0.5, 1.0), 0.05, 0.6)
        .lamp(DVec3::new(0.5, -0.2, -0.4), 0.15, 3.0)
        .lamp(DVec3::new(-0.7, 0.5, 0.2), 0.02, 60.0)
        .with(walls, lambert(0.6))
        .with(window, lambert(0.3))
        .with(light, shining(2.0, 0.2))
        .with(cube(Vec3::new(-0.4, -0.7, -0.3), 0.3), metal(0.5))
        .seen_from(DVec3::new(0.3, 0.1, 0.9), DVec3::new(-0.2, -0.3, -0.6), 1.3)
}

/// However lights are chosen, the mean is the same.
#[test]
fn choices_of_lights_agree() {
    let world = room(32);
    let picture = |choice, candidates| {
        let shot =
            Shot::of(64).with(|options| (options.light_choice, options.candidates) = (choice, candidates));
        reference(&world, &shot)
    };
    let uniform = picture(LightChoice::Uniform, 1);
    uniform.assert_sound("uniform");
    for candidates in [1, 8] {
        let resampled = picture(LightChoice::Resampled, candidates);
        resampled.assert_sound("resampled");
        resampled.assert_same(&uniform, 8, 0.0, &format!("{candidates} candidates"));
    }
}

/// The error falls as one over the root of the number of samples: what is left would be a bias.
#[test]
fn errors_fall_as_the_root_of_samples() {
    // Light that comes by all directions alike has no rare bright paths.
    let world = World::new(32)
        .sky(1.0)
        .with(cube(Vec3::ZERO, -1.0).into_iter().skip(2), lambert(0.6))
        .with(cube(Vec3::new(-0.4, -0.7, -0.3), 0.3), lambert(0.4))
        .seen_from(DVec3::new(0.3, 0.1, 0.9), DVec3::new(-0.2, -0.3, -0.6), 1.3);
    let picture = |samples, seed| reference(&world, &Shot::of(samples).with(|options| options.seed = seed));
    let converged = picture(512, 1);
    let logs = [1, 2, 4, 8_u32].map(|samples| {
        let error = picture(samples, 2 + samples).distance(&converged);
        (f64::from(samples).ln(), error.ln())
    });
    let (x, y) = logs.iter().fold((0.0, 0.0), |(x, y), log| (x + log.0 / 4.0, y + log.1 / 4.0));
    let along: f64 = logs.iter().map(|log| (log.0 - x) * (log.1 - y)).sum();
    let slope = along / logs.iter().map(|log| (log.0 - x).powi(2)).sum::<f64>();
    assert!((slope + 0.5).abs() < 0.05, "slope {slope}: {logs:?}");
}

#[test]
fn the_same_run_has_the_same_bits() {
    let picture = || reference(&room(32), &Shot::of(4));
    let (first, second) = (picture(), picture());
    assert_eq!(first.radiance, second.radiance);
    assert_eq!(first.shown, second.shown);
}
