//! A level like an old game's.

use super::{Built, Lamp, Random};
use afterglow_relight::{Light, Source};
use glam::Vec3;

const ROOM: f32 = 8.0;
const HEIGHT: f32 = 4.0;

/// How far a lamp is from the light found nearest to it, infinite where its power is off by more than a quarter.
pub fn distance(lamp: &Lamp, lights: &[Light]) -> f32 {
    let Lamp::Point(at, power) = *lamp else { return f32::INFINITY };
    let to = |light: &Light| match light.source {
        Source::Point { position, .. } => position.distance(at),
        _ => f32::INFINITY,
    };
    let nearest = lights.iter().min_by(|a, b| to(a).total_cmp(&to(b)));
    nearest.filter(|light| light.power.distance(power) < 0.25 * power.length()).map_or(f32::INFINITY, to)
}

/// A square of rooms with doors between them, in each a crate, one or two lamps, and a panel that
/// might shine but does not.
pub fn level(rooms: usize, tessellation: u32, patch: f32) -> (Built, Vec<Lamp>) {
    let mut built = Built::new();
    built.tessellation = tessellation;
    built.supersampling = 2;
    let mut lamps = Vec::new();
    let mut random = Random(3);
    let albedo = |random: &mut Random| Vec3::new(0.3 + 0.4 * random.unit(), 0.3 + 0.3 * random.unit(), 0.3);
    for room in 0..rooms * rooms {
        let corner = Vec3::new((room % rooms) as f32, (room / rooms) as f32, 0.0) * ROOM;
        let shade = albedo(&mut random);
        let (x, y, z) = (Vec3::X * ROOM, Vec3::Y * ROOM, Vec3::Z * HEIGHT);
        built.rect(corner, x, y, shade, patch);
        built.rect(corner + z, y, x, shade, patch);
        wall(&mut built, corner, [y, Vec3::X], room % rooms > 0, shade, patch);
        wall(&mut built, corner + x, [y, Vec3::NEG_X], room % rooms + 1 < rooms, shade, patch);
        wall(&mut built, corner, [x, Vec3::Y], room / rooms > 0, shade, patch);
        wall(&mut built, corner + y, [x, Vec3::NEG_Y], room / rooms + 1 < rooms, shade, patch);
        let centre = corner + Vec3::new(3.5, 3.5, HEIGHT - 0.01);
        built.emitter(centre, Vec3::Y, Vec3::X);
        let at = |random: &mut Random, low: f32, high: f32| low + (high - low) * random.unit();
        let place = corner + Vec3::new(at(&mut random, 1.0, 5.0), at(&mut random, 1.0, 5.0), 0.0);
        built.cuboid(place, place + Vec3::new(1.4, 1.4, 1.2), false, shade, patch, &[4]);
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
fn wall(built: &mut Built, corner: Vec3, [along, normal]: [Vec3; 2], door: bool, albedo: Vec3, patch: f32) {
    let mut panel = |from: f32, to: f32, low: f32, high: f32| {
        let (u, v) = (along * (to - from), Vec3::Z * (high - low));
        let at = corner + along * from + Vec3::Z * low;
        if u.cross(v).dot(normal) > 0.0 {
            built.rect(at, u, v, albedo, patch);
        } else {
            built.rect(at, v, u, albedo, patch);
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
