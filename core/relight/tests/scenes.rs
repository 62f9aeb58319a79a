//! Lights baked into small worlds, and how near the ones found come to them.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

mod support;

use afterglow_relight::{Falloff, FalloffModel, Found, Light, Options, Sky, Source, recover};
use glam::Vec3;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use support::level::{distance, level};
use support::{Built, Lamp};

const GREY: Vec3 = Vec3::splat(0.5);

fn options() -> Options {
    Options { rays: 1_000_000, ..Options::default() }
}

fn solve(name: &str, built: &Built, sky: Sky, options: &Options) -> Found {
    let triangles = built.triangles();
    let start = Instant::now();
    let found = recover(&built.baked(&triangles, sky), options, &AtomicBool::new(false)).unwrap();
    println!(
        "{name}: {} patches, {:.0} ms, {} rays, residual {:.4}, explained {:.3}, ambient {:.4}, bounce {:.3} {}",
        built.patches.len(),
        start.elapsed().as_secs_f64() * 1e3,
        found.rays,
        found.residual,
        found.explained,
        found.ambient,
        found.bounce,
        if found.one_bounce { "once" } else { "ever" },
    );
    for light in &found.lights {
        println!("  {:?} {:.4} evidence {:.5}", light.source, light.power, light.evidence);
    }
    found
}

/// The point light nearest to a place, its distance from it, and its power's relative error.
fn nearest(found: &Found, position: Vec3, power: Vec3) -> (f32, f32) {
    let distance = |light: &Light| match light.source {
        Source::Point { position: at, .. } => at.distance(position),
        _ => f32::INFINITY,
    };
    let light = found.lights.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
    let error = light.power.distance(power) / power.length();
    println!("  off by {:.4}, power by {:.2} %", distance(light), error * 100.0);
    (distance(light), error)
}

fn room() -> Built {
    let mut built = Built::new();
    built.supersampling = 2;
    built.cuboid(Vec3::ZERO, Vec3::new(8.0, 6.0, 4.0), true, GREY, 0.5, &[]);
    built
}

#[test]
fn one_lamp_in_an_empty_room() {
    let mut built = room();
    let (position, power) = (Vec3::new(2.3, 3.1, 3.2), Vec3::new(5.0, 4.0, 3.0));
    built.bake(&[Lamp::Point(position, power)], 0, 0);
    let found = solve("one lamp", &built, Sky::None, &options());
    let (distance, error) = nearest(&found, position, power);
    assert!(distance < 0.01 * 10.8 && error < 0.05);
    assert!(found.lights.len() == 1 && found.residual < 0.01 && found.explained > 0.99);
    assert!(found.bounce.max_element() < 0.02 && found.ambient.max_element() < 0.01);
}

/// Three coloured lamps, a pillar and a shelf between them.
fn furnished() -> (Built, [(Vec3, Vec3); 3]) {
    let mut built = Built::new();
    built.supersampling = 2;
    built.cuboid(Vec3::ZERO, Vec3::new(10.0, 8.0, 4.0), true, GREY, 0.5, &[]);
    built.cuboid(Vec3::new(4.0, 3.0, 0.0), Vec3::new(5.0, 4.5, 4.0), false, GREY, 0.5, &[4, 5]);
    built.cuboid(Vec3::new(7.0, 0.0, 1.5), Vec3::new(9.0, 2.0, 1.8), false, GREY, 0.5, &[2]);
    let lamps = [
        (Vec3::new(1.5, 1.5, 3.0), Vec3::new(6.0, 1.0, 1.0)),
        (Vec3::new(8.5, 6.0, 2.0), Vec3::new(1.0, 5.0, 1.5)),
        (Vec3::new(2.0, 6.5, 2.5), Vec3::new(0.5, 1.0, 4.0)),
    ];
    (built, lamps)
}

fn check_three(found: &Found, lamps: &[(Vec3, Vec3)], most_distance: f32, most_error: f32) {
    for &(position, power) in lamps {
        let (distance, error) = nearest(found, position, power);
        assert!(distance < most_distance && error < most_error, "{distance} {error}");
    }
}

#[test]
fn three_coloured_lamps_among_furniture() {
    let (mut built, lamps) = furnished();
    built.bake(&lamps.map(|(position, power)| Lamp::Point(position, power)), 0, 0);
    let found = solve("three lamps", &built, Sky::None, &options());
    check_three(&found, &lamps, 0.13, 0.05);
    assert!(found.lights.len() <= 5 && found.residual < 0.05 && found.explained > 0.97);
}

#[test]
fn bounced_light_is_told_from_lamps() {
    for bounces in [1, 4] {
        let (mut built, lamps) = furnished();
        built.bake(&lamps.map(|(position, power)| Lamp::Point(position, power)), bounces, 256);
        let found = solve(&format!("{bounces} bounces"), &built, Sky::None, &options());
        check_three(&found, &lamps, 0.2, 0.08);
        assert!(found.residual < 0.05 && found.explained > 0.97);
        assert!(found.bounce.min_element() > 0.8);
    }
}

#[test]
fn noise_quantisation_and_clipping_are_borne() {
    let (mut built, lamps) = furnished();
    built.bake(&lamps.map(|(position, power)| Lamp::Point(position, power)), 1, 256);
    built.degrade(0.02, 1.0);
    let clipped = built.patches.iter().filter(|patch| patch.irradiance.max_element() >= 1.0).count();
    println!("{clipped} clipped");
    assert!(clipped > 10);
    let options = Options { saturation: Some(1.0), ..options() };
    let found = solve("degraded", &built, Sky::None, &options);
    check_three(&found, &lamps, 0.25, 0.12);
    assert!(found.residual < 0.06 && found.explained > 0.95);
}

#[test]
fn a_panel_on_the_ceiling_is_found_among_dark_ones() {
    let mut built = room();
    let (u, v) = (Vec3::new(0.0, 1.0, 0.0), Vec3::new(1.5, 0.0, 0.0));
    let corners = [(1.0, 1.0), (5.0, 1.0), (1.0, 4.0), (5.0, 4.0)].map(|(x, y)| Vec3::new(x, y, 3.99));
    corners.iter().for_each(|&corner| built.emitter(corner, u, v));
    let radiance = Vec3::new(2.0, 1.5, 1.0);
    built.bake(&[Lamp::Panel(corners[1], u, v, radiance)], 1, 256);
    let found = solve("panel", &built, Sky::None, &options());
    assert_eq!(found.lights[0].source, Source::Area { emitter: 1 });
    let error = found.lights[0].power.distance(radiance) / radiance.length();
    println!("  power off by {:.2} %", error * 100.0);
    assert!(error < 0.05 && found.residual < 0.05);
    assert!(found.lights[1..].iter().all(|light| light.evidence < 1e-3));
}

#[test]
fn sun_and_sky_come_through_a_window() {
    let mut built = Built::new();
    built.supersampling = 2;
    built.cuboid(Vec3::ZERO, Vec3::new(8.0, 6.0, 4.0), true, GREY, 0.4, &[1]);
    // The wall at x = 8 around an opening of 2.4 by 2.
    let wall = |built: &mut Built, y: [f32; 2], z: [f32; 2]| {
        let corner = Vec3::new(8.0, y[0], z[0]);
        built.rect(corner, Vec3::Z * (z[1] - z[0]), Vec3::Y * (y[1] - y[0]), GREY, 0.4);
    };
    wall(&mut built, [0.0, 1.8], [0.0, 4.0]);
    wall(&mut built, [4.2, 6.0], [0.0, 4.0]);
    wall(&mut built, [1.8, 4.2], [0.0, 1.2]);
    wall(&mut built, [1.8, 4.2], [3.2, 4.0]);
    let towards = Vec3::new(0.7, 0.2, 0.6).normalize();
    let (sun, sky) = (Vec3::new(3.0, 2.8, 2.4), Vec3::new(0.3, 0.4, 0.6));
    built.supersampling = 3;
    for bounces in [0, 1] {
        built.bake(&[Lamp::Sun(towards, sun), Lamp::Sky(sky)], bounces, 256);
        let found = solve(&format!("window, {bounces} bounces"), &built, Sky::Open, &options());
        let power_of =
            |wanted: fn(&Source) -> bool| found.lights.iter().find(|light| wanted(&light.source)).unwrap();
        let found_sun = power_of(|source| matches!(source, Source::Sun { .. }));
        let Source::Sun { direction, .. } = found_sun.source else { unreachable!() };
        let angle = direction.angle_between(towards).to_degrees();
        let sun_error = found_sun.power.distance(sun) / sun.length();
        let found_sky = power_of(|source| *source == Source::Sky);
        let sky_error = found_sky.power.distance(sky) / sky.length();
        println!(
            "  sun off by {angle:.2} degrees, {:.2} %; sky {:.2} %",
            sun_error * 100.0,
            sky_error * 100.0
        );
        assert!(angle < 2.0 && sun_error < 0.08 && sky_error < 0.1);
        assert!(found.residual < 0.13);
    }
}

#[test]
fn lights_that_fade_linearly_are_found_as_such() {
    let mut built = room();
    let (position, power, reach) = (Vec3::new(5.0, 2.0, 2.5), Vec3::new(0.8, 0.9, 1.0), 5.0);
    built.bake(&[Lamp::Linear(position, power, reach)], 0, 0);
    let options = Options { falloff: FalloffModel::Either, ..options() };
    let found = solve("linear", &built, Sky::None, &options);
    let (distance, error) = nearest(&found, position, power);
    assert!(distance < 0.1 && error < 0.05 && found.residual < 0.02);
    let Source::Point { falloff: Falloff::Linear { reach: got }, .. } = found.lights[0].source else {
        panic!("{:?}", found.lights[0]);
    };
    assert!((got / reach - 1.0).abs() < 0.05, "{got}");
}

#[test]
fn nearly_all_lamps_of_a_level_are_found() {
    let (mut built, lamps) = level(3, 1, 1.0);
    built.bake(&lamps, 0, 0);
    let options = Options { rays: 3_000_000, ..Options::default() };
    let found = solve("level", &built, Sky::None, &options);
    let near = lamps.iter().filter(|lamp| distance(lamp, &found.lights) < 0.3).count();
    println!("  {near} of {} lamps, {} lights", lamps.len(), found.lights.len());
    assert!(near * 10 >= lamps.len() * 8 && found.lights.len() <= lamps.len() + 2);
    assert!(found.residual < 0.1 && found.explained > 0.9);
}

#[test]
fn darkness_has_no_sources_and_ambient_light_neither() {
    let mut built = room();
    let found = solve("dark", &built, Sky::Open, &options());
    assert!(found.lights.is_empty() && found.residual == 0.0 && found.explained == 1.0);
    built.patches.iter_mut().for_each(|patch| patch.irradiance = Vec3::new(0.3, 0.2, 0.1));
    let found = solve("ambient", &built, Sky::None, &options());
    assert!(found.lights.is_empty() && found.residual < 1e-3);
    let uniform = found.ambient + found.bounce * 0.5 * Vec3::new(0.3, 0.2, 0.1);
    assert!(uniform.distance(Vec3::new(0.3, 0.2, 0.1)) < 0.01, "{uniform}");
}
