//! Lights at the ends of what they can be: none, one, very many; tiny, around the eye, on a surface, without power.

use afterglow_extremes::{Shot, World, cube, lambert, pathtrace, quad, reference, shining, staged};
use afterglow_render::{LightChoice, Mode, Target};
use afterglow_scene::{LightOrigin, LightShape, Scene, SceneLight};
use glam::{DVec3, Vec3};

use crate::closed_forms::{floor, room, spot};

fn direct(samples: u32) -> Shot {
    Shot::of(samples).with(|options| options.target = Target::Direct)
}

#[test]
fn without_light_there_is_none() {
    let world = World::new(16).with(cube(Vec3::ZERO, 1.0), lambert(0.5)).seen_from(
        DVec3::new(2.0, 3.0, 5.0),
        DVec3::ZERO,
        0.8,
    );
    for picture in [reference(&world, &Shot::of(4)), pathtrace(&world, &Shot::of(4))] {
        picture.assert_sound("no light");
    }
    assert_eq!(reference(&world, &Shot::of(4)).whole().mean, 0.0);
}

/// From inside, a sphere that shines is all that there is.
#[test]
fn inside_a_sphere_light() {
    let world = World::new(16).lamp(DVec3::new(0.2, 0.1, 0.3), 10.0, 2.0);
    let eye = world.clone().seen_from(DVec3::ZERO, DVec3::NEG_Z, 1.0);
    reference(&eye, &Shot::of(2)).whole().assert(2.0, 1e-5, "seen from inside");
    let floor = spot(world.with(floor(1.0), lambert(0.5)), DVec3::new(0.0, 3.0, 4.0));
    let picture = reference(&floor, &Shot::of(16));
    picture.assert_sound("a floor inside");
    picture.whole().assert(1.0, 1e-5, "a floor inside");
}

fn gl_light(position: Vec3, attenuation: Vec3) -> SceneLight {
    let shape = LightShape::Point { position, radius: 0.0, attenuation, spot: None };
    SceneLight { shape, color: Vec3::splat(2.0), origin: LightOrigin::Gl(0) }
}

/// OpenGL's lights may lie on a surface: without a falloff they shine as much as from afar.
#[test]
fn program_lights_on_a_surface() {
    let render = |mode, lights: &[SceneLight]| {
        let world = spot(World::new(8).with(floor(1.0), lambert(0.5)), DVec3::new(3.0, 1.0, 0.0));
        let (frame, scene) = staged(&world);
        let picture = direct(4).render(mode, (frame, Scene { lights: lights.to_vec(), ..scene }));
        picture.assert_sound("a light on a surface");
        picture
    };
    for (height, brought) in [(0.0, 0.0), (1e-6, f64::NAN), (0.1, 1.0), (10.0, 1.0)] {
        let shown = render(Mode::Reference, &[gl_light(Vec3::Y * height, Vec3::X)]).whole();
        assert!(brought.is_nan() || shown.agrees(brought, 1e-2), "{height} above: {shown:?}");
        let infinite = [gl_light(Vec3::Y * height, Vec3::Z), gl_light(Vec3::Y * height, Vec3::ZERO)];
        render(Mode::Reference, &infinite);
        render(Mode::Pathtrace, &infinite);
    }
}

/// Lights that are no numbers are not there.
#[test]
fn lights_that_are_no_numbers() {
    let world = room(16);
    let expected = reference(&world, &Shot::of(64));
    let mut lights = staged(&world).1.lights;
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let good = gl_light(Vec3::ONE, Vec3::Z);
        lights.push(gl_light(Vec3::new(0.0, bad, 0.0), Vec3::X));
        lights.push(gl_light(Vec3::ONE, Vec3::new(bad, 0.0, 0.0)));
        lights.push(SceneLight { color: Vec3::new(1.0, 1.0, bad), ..good });
        let to_light = Vec3::new(bad, 1.0, 0.0);
        let sun = LightShape::Directional { to_light, angular_radius: 0.1 };
        lights.push(SceneLight { shape: sun, ..good });
        let sun = LightShape::Directional { to_light: Vec3::Y, angular_radius: bad };
        lights.push(SceneLight { shape: sun, ..good });
        let lamp = LightShape::Point { position: Vec3::ZERO, radius: bad, attenuation: Vec3::Z, spot: None };
        lights.push(SceneLight { shape: lamp, origin: LightOrigin::SceneFile, ..good });
    }
    let render = |mode, samples| {
        let (frame, scene) = staged(&world);
        let picture = Shot::of(samples).render(mode, (frame, Scene { lights: lights.clone(), ..scene }));
        picture.assert_sound("bad lights");
        picture
    };
    render(Mode::Reference, 64).assert_same(&expected, 8, 0.0, "bad lights");
    render(Mode::Pathtrace, 4);
}

/// Ninety-nine lights that are switched off cost no sample: the error is that of one light.
#[test]
fn lights_without_power_are_never_asked() {
    let place = |number: u32| DVec3::new(f64::from(number % 10) - 4.5, 3.0, f64::from(number / 10) - 4.5);
    let base = World::new(16).with(floor(5.0), lambert(0.5)).with(cube(Vec3::Y * 0.5, 0.5), lambert(0.8));
    let eye = |world: World| world.seen_from(DVec3::new(3.0, 2.5, 5.0), DVec3::ZERO, 0.8);
    let one = eye(base.clone().lamp(place(55), 0.2, 5.0));
    let many = (0..100)
        .fold(base, |world, number| world.lamp(place(number), 0.2, if number == 55 { 5.0 } else { 0.0 }));
    let many = eye(many);
    let shot = Shot::of(64).with(|options| options.target = Target::Bounce1);
    let (one, many) = (reference(&one, &shot), reference(&many, &shot));
    many.assert_sound("99 lights off");
    let [own, theirs] = [&many, &one].map(|picture| picture.whole());
    // What is switched off still hides a little of what is reflected.
    assert!(own.agrees_with(theirs, 0.01), "{own:?}, {theirs:?}");
    assert!(own.error < 1.3 * theirs.error, "{own:?}, {theirs:?}");
}

/// Ten thousand lights, by their sum.
#[test]
fn ten_thousand_lights() {
    let place =
        |number: u32| DVec3::new(f64::from(number % 100) - 49.5, 20.0, f64::from(number / 100) - 49.5);
    let irradiance: f64 = (0..10_000).map(|number| 20.0 / place(number).length().powi(3)).sum();
    let world = World::new(8).with(floor(1.0), lambert(1.0));
    let world = (0..10_000).fold(world, |world, number| world.lamp(place(number), 0.1, 100.0));
    let world = spot(world, DVec3::new(0.0, 3.0, 4.0));
    for choice in [LightChoice::Resampled, LightChoice::Uniform] {
        let picture = reference(&world, &direct(64).with(|options| options.light_choice = choice));
        picture.assert_sound("many lights");
        picture.whole().assert(irradiance, 1e-4, &format!("{choice:?}"));
    }
}

/// A light with more power than there are numbers for cannot be asked for in proportion: rays find it.
#[test]
fn lights_of_power_beyond_all_numbers() {
    let half = 1e6;
    let ceiling = quad(Vec3::new(-half, 1.0, -half), Vec3::X * 2.0 * half, Vec3::Z * 2.0 * half);
    for radiance in [1e10, 1e14, 1e30] {
        let world = World::new(8)
            .with(floor(1.0), lambert(0.5))
            .with(ceiling.clone(), shining(radiance, 0.0))
            .lamp(DVec3::new(0.0, 0.4, 0.0), 0.1, 1.0)
            .lamp(DVec3::new(0.3, 0.3, 0.0), 0.1, 1e38);
        let picture = reference(&spot(world, DVec3::new(1.2, 0.2, 0.0)), &direct(64));
        picture.assert_sound(&format!("radiance {radiance}"));
        let is_limited = picture.limited > 0;
        assert!(is_limited && picture.whole().error.is_finite(), "radiance {radiance}");
    }
}

/// A ceiling of very many triangles shines as one of two, also where there are too many to be asked.
#[test]
fn seventy_thousand_shining_triangles() {
    for side in [150, 187] {
        let step = 2.0 / side as f32;
        let place = |x: u32, z: u32| Vec3::new(x as f32 * step - 1.0, 1.0, z as f32 * step - 1.0);
        let tiles =
            (0..side * side).flat_map(|n| quad(place(n % side, n / side), Vec3::X * step, Vec3::Z * step));
        let world = World::new(8).with(floor(1.0), lambert(0.5)).with(tiles, shining(3.0, 0.0));
        let picture = reference(&spot(world, DVec3::new(1.2, 0.9, 0.0)), &direct(128));
        picture.assert_sound("a ceiling");
        picture.whole().assert(0.5 * 3.0 * 0.554126, 1e-3, &format!("{} triangles", 2 * side * side));
    }
}
