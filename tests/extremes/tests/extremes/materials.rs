//! Materials at the ends of what they can be.

use afterglow_extremes::{Shot, World, cube, lambert, metal, pathtrace, quad, reference, shining};
use afterglow_render::Denoiser;
use afterglow_scene_file::Material;
use glam::{DVec3, Vec3};

use crate::closed_forms::{floor, room, spot};

/// The smoothest metal reflects nearly all, from whichever angle; what is no roughness counts as 0.
#[test]
fn roughness_that_is_none() {
    for roughness in [0.0, 1e-4, 1e-3, -1.0, f32::NAN, f32::NEG_INFINITY] {
        for cosine in [1.0, 0.05_f64] {
            let eye = DVec3::new((1.0 - cosine * cosine).sqrt(), cosine, 0.0) * 5.0;
            let world = spot(World::new(8).sky(1.0).with(floor(1.0), metal(roughness)), eye);
            let picture = reference(&world, &Shot::of(16));
            picture.assert_sound(&format!("roughness {roughness}"));
            picture.whole().assert(1.0, 1e-3, &format!("roughness {roughness}, cosine {cosine}"));
            pathtrace(&world, &Shot::of(4)).assert_sound(&format!("roughness {roughness}"));
        }
    }
}

/// At grazing angles nothing is divided by a cosine.
#[test]
fn grazing_angles_of_the_roughest_metal() {
    for (roughness, cosine) in
        [(1.0, 1e-2), (1.0, 1e-4), (1.0, 1e-6), (2.0, 1e-3), (f32::INFINITY, 0.1), (0.0, 1e-4)]
    {
        let eye = DVec3::new(1.0, cosine, 0.0);
        let world = World::new(8)
            .sky(1.0)
            .sun(DVec3::new(-1.0, 1e-3, 0.0), 1e-2, 1.0)
            .with(floor(0.5), metal(roughness))
            .seen_from(eye, DVec3::ZERO, 1e-3);
        for picture in [reference(&world, &Shot::of(32)), pathtrace(&world, &Shot::of(4))] {
            picture.assert_sound(&format!("roughness {roughness}, cosine {cosine}"));
        }
        let without = World { file: afterglow_scene_file::SceneFile { sun: None, ..world.file } };
        let dull = reference(&without, &Shot::of(32)).whole();
        assert!(dull.mean < 1.0 + 1e-4, "roughness {roughness}, cosine {cosine}: {dull:?}");
    }
}

/// A mirror shows what an eye behind it would see.
#[test]
fn a_mirror_shows_the_mirrored_picture() {
    let scene = || {
        let tiles = (0..16).filter(|n| (n / 4 + n % 4) % 2 == 0);
        let place = |n: i32| Vec3::new((n % 4) as f32 - 2.0, (n / 4) as f32 - 2.0, 3.0);
        // Fronts towards -z.
        let tiles = tiles.flat_map(|n| quad(place(n), Vec3::Y, Vec3::X)).collect::<Vec<_>>();
        World::new(32).with(tiles, shining(1.0, 0.0))
    };
    let mirror = quad(Vec3::new(-9.0, -9.0, 0.0), Vec3::X * 18.0, Vec3::Y * 18.0);
    let eye = DVec3::new(0.3, 0.2, 1.5);
    let reflected = scene().with(mirror, metal(0.0)).seen_from(eye, DVec3::new(0.3, 0.2, 0.0), 1.2);
    let behind = scene().seen_from(eye * DVec3::new(1.0, 1.0, -1.0), DVec3::new(0.3, 0.2, 0.0), 1.2);
    let (own, expected) = (reference(&reflected, &Shot::of(16)), reference(&behind, &Shot::of(16)));
    own.assert_sound("a mirror");
    let mirrored = |place: usize| place / 32 * 32 + 31 - place % 32;
    let far = (0..32 * 32).filter(|&place| {
        (own.radiance.mean[place][0] - expected.radiance.mean[mirrored(place)][0]).abs() > 0.3
    });
    // The lobe is a little wide: edges may be off.
    assert!(far.count() < 16);
}

/// Where nothing is lost there is an end all the same.
#[test]
fn white_rooms() {
    let world = |albedo| {
        World::new(8).with(cube(Vec3::ZERO, -1.0), shining(0.5, albedo)).seen_from(
            DVec3::new(0.3, 0.2, 0.1),
            DVec3::new(-1.0, -0.8, -0.9),
            1.0,
        )
    };
    let picture = reference(&world(1.0), &Shot::of(8));
    picture.assert_sound("albedo 1");
    picture.whole().assert(0.5 * 65.0, 1e-4, "albedo 1");
    // More than all is not carried on.
    let picture = reference(&world(4.0), &Shot::of(32));
    picture.assert_sound("albedo 4");
    let value = 0.5 * (1.0 - 0.98_f64.powi(65)) / 0.02;
    picture.whole().assert(value, 1e-4, "albedo 4");
    pathtrace(&world(4.0), &Shot::of(4)).assert_sound("albedo 4");
}

/// Colours that are no numbers cost themselves only.
#[test]
fn colours_that_are_no_numbers() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 1e30, 1e-40] {
        let odd = Material { base_color: Vec3::new(0.5, bad, 0.5), ..lambert(0.0) };
        let metal = Material { base_color: Vec3::new(0.5, bad, 0.5), ..metal(0.3) };
        let world = room(16)
            .with(cube(Vec3::new(0.1, -0.5, -0.3), 0.1), odd)
            .with(cube(Vec3::new(0.5, 0.5, -0.3), 0.1), metal);
        reference(&world, &Shot::of(16)).assert_sound(&format!("a colour of {bad}"));
        pathtrace(&world, &Shot::of(4)).assert_sound(&format!("a colour of {bad}"));
    }
}

/// Radiance that squares would overflow is limited, and counted.
#[test]
fn radiance_beyond_all_bounds() {
    for radiance in [1e17, 1e20, 1e30, 1e38, f64::INFINITY, f64::NAN] {
        let lamp = quad(Vec3::new(-0.1, 0.9, -0.1), Vec3::X * 0.2, Vec3::Z * 0.2);
        let world = room(16).with(lamp, shining(radiance, 0.0)).lamp(DVec3::ZERO, 0.05, radiance);
        for picture in [reference(&world, &Shot::of(16)), pathtrace(&world, &Shot::of(4))] {
            assert!(picture.is_sound(), "radiance {radiance}");
            let errors = picture.radiance.standard_error.iter().flatten();
            assert!(errors.into_iter().all(|error| error.is_finite()), "radiance {radiance}");
            let is_counted = picture.non_finite + picture.limited > 0;
            assert!(is_counted || radiance < 1e18 || radiance.is_nan(), "radiance {radiance}");
        }
    }
}

/// What a limit removes is what is missing.
#[test]
fn limits_tell_what_they_remove() {
    let bright = quad(Vec3::new(-0.05, 0.98, -0.05), Vec3::X * 0.1, Vec3::Z * 0.1);
    let world = World::new(32)
        .with(cube(Vec3::ZERO, -1.0), lambert(1.0))
        .with(bright, shining(5000.0, 0.0))
        .seen_from(DVec3::new(0.0, -0.2, 0.9), DVec3::new(0.0, -0.6, 0.0), 1.0);
    let picture = |most| {
        pathtrace(
            &world,
            &Shot::of(16).with(|options| (options.most_radiance, options.denoiser) = (most, Denoiser::None)),
        )
    };
    let (whole, limited) = (picture(f32::INFINITY), picture(2.0));
    assert_eq!((whole.limited, whole.removed), (0, 0.0));
    let missing = (whole.whole().mean - limited.whole().mean) * 32.0 * 32.0 * 16.0;
    let share = limited.removed / missing;
    assert!(
        limited.limited > 0 && (share - 1.0).abs() < 0.02,
        "{} of {missing} are counted",
        limited.removed
    );
}
