//! A level of rooms like an old game's, its lights baked and found again: seconds, residual, and how near they came.
//!
//! `cargo run --release -p afterglow-relight --example level [BOUNCES [RAYS]]`

#[path = "../tests/support/mod.rs"]
mod support;

use afterglow_relight::{Options, Sky, Source, recover};
use glam::Vec3;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use support::{Built, Lamp, Random};

/// Rooms along either side of the level; 8 by 8 by 4 each.
const ROOMS: usize = 5;
const ROOM: f32 = 8.0;
const HEIGHT: f32 = 4.0;
const PATCH: f32 = 1.25;

fn main() {
    let arguments: Vec<u64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let bounces = arguments.first().copied().unwrap_or(1) as u32;
    let mut options = Options::default();
    options.rays = arguments.get(1).copied().unwrap_or(options.rays);
    let (mut built, lamps) = level();
    let start = Instant::now();
    built.bake(&lamps, bounces, 128);
    let triangles = built.triangles();
    println!(
        "{} triangles, {} patches, {} lamps, {bounces} bounces baked in {:.1} s",
        triangles.len(),
        built.patches.len(),
        lamps.len(),
        start.elapsed().as_secs_f64()
    );
    let start = Instant::now();
    let baked = built.baked(&triangles, Sky::None);
    let found = recover(&baked, &options, &AtomicBool::new(false)).expect("nobody cancels");
    println!(
        "{:.2} s, {:.1} million rays, residual {:.4}, explained {:.3}, {} lights, bounce {:.2}",
        start.elapsed().as_secs_f64(),
        found.rays as f64 * 1e-6,
        found.residual,
        found.explained,
        found.lights.len(),
        found.bounce
    );
    let mut distances: Vec<f32> = lamps.iter().map(|lamp| distance(lamp, &found.lights)).collect();
    distances.sort_by(f32::total_cmp);
    let within = |most: f32| distances.iter().filter(|&&d| d < most).count();
    println!(
        "lamps found within 0.25: {}, within 1: {}; median distance {:.3}",
        within(0.25),
        within(1.0),
        distances[distances.len() / 2]
    );
}

/// How far a lamp is from the light found nearest to it, infinite where its power is off by more than a quarter.
fn distance(lamp: &Lamp, lights: &[afterglow_relight::Light]) -> f32 {
    let Lamp::Point(at, power) = *lamp else { return f32::INFINITY };
    let to = |light: &afterglow_relight::Light| match light.source {
        Source::Point { position, .. } => position.distance(at),
        _ => f32::INFINITY,
    };
    let nearest = lights.iter().min_by(|a, b| to(a).total_cmp(&to(b)));
    nearest.filter(|light| light.power.distance(power) < 0.25 * power.length()).map_or(f32::INFINITY, to)
}

/// Rooms with doors between them, a crate and one or two lamps in each.
fn level() -> (Built, Vec<Lamp>) {
    let mut built = Built::new();
    built.tessellation = 5;
    built.supersampling = 2;
    let mut lamps = Vec::new();
    let mut random = Random(3);
    let albedo = |random: &mut Random| Vec3::new(0.3 + 0.4 * random.unit(), 0.3 + 0.3 * random.unit(), 0.3);
    for room in 0..ROOMS * ROOMS {
        let corner = Vec3::new((room % ROOMS) as f32, (room / ROOMS) as f32, 0.0) * ROOM;
        let shade = albedo(&mut random);
        let (x, y, z) = (Vec3::X * ROOM, Vec3::Y * ROOM, Vec3::Z * HEIGHT);
        built.rect(corner, x, y, shade, PATCH);
        built.rect(corner + z, y, x, shade, PATCH);
        wall(&mut built, corner, y, Vec3::X, room % ROOMS > 0, shade);
        wall(&mut built, corner + x, y, Vec3::NEG_X, room % ROOMS + 1 < ROOMS, shade);
        wall(&mut built, corner, x, Vec3::Y, room / ROOMS > 0, shade);
        wall(&mut built, corner + y, x, Vec3::NEG_Y, room / ROOMS + 1 < ROOMS, shade);
        let at = |random: &mut Random, low: f32, high: f32| low + (high - low) * random.unit();
        let place = corner + Vec3::new(at(&mut random, 1.0, 5.0), at(&mut random, 1.0, 5.0), 0.0);
        built.cuboid(place, place + Vec3::new(1.4, 1.4, 1.2), false, shade, PATCH, &[4]);
        for _ in 0..1 + (random.unit() * 2.0) as usize {
            let position = corner
                + Vec3::new(at(&mut random, 1.0, 7.0), at(&mut random, 1.0, 7.0), at(&mut random, 2.2, 3.5));
            let power =
                Vec3::new(1.0 + 4.0 * random.unit(), 1.0 + 4.0 * random.unit(), 1.0 + 3.0 * random.unit());
            lamps.push(Lamp::Point(position, power));
        }
    }
    (built, lamps)
}

/// A wall from `corner` along `along`, lit to the side of `normal`, with a door amid it.
fn wall(built: &mut Built, corner: Vec3, along: Vec3, normal: Vec3, door: bool, albedo: Vec3) {
    let mut panel = |from: f32, to: f32, low: f32, high: f32| {
        let (u, v) = (along * (to - from), Vec3::Z * (high - low));
        let at = corner + along * from + Vec3::Z * low;
        if u.cross(v).dot(normal) > 0.0 {
            built.rect(at, u, v, albedo, PATCH);
        } else {
            built.rect(at, v, u, albedo, PATCH);
        }
    };
    if door {
        panel(0.0, 0.4, 0.0, HEIGHT);
        panel(0.6, 1.0, 0.0, HEIGHT);
        panel(0.4, 0.6, 2.4, HEIGHT);
    } else {
        panel(0.0, 1.0, 0.0, HEIGHT);
    }
}
