//! Form factors by rays against their closed forms (Howell, A Catalog of Radiation Heat Transfer Configuration
//! Factors: C-11, C-14, C-40).

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

mod support;

use afterglow_sampling::directions::{cosine_direction, disc_point};
use glam::{Vec2, Vec3};
use support::{Mean, World, cube, draws, parallelogram};

/// The share of what leaves points, in a cosine's directions about +z, that meets the triangles.
fn form_factor(seed: u32, triangles: &[[Vec3; 3]], point: impl Fn(Vec2) -> Vec3) -> Mean {
    let world = World::new(triangles);
    let mut mean = Mean::new();
    for random in draws(seed, 200_000) {
        let origin = point(Vec2::new(random.x, random.y));
        let direction = cosine_direction(Vec3::Z, Vec2::new(random.z, random.w));
        mean.add(f64::from(u8::from(world.trace(origin, 0.0, direction).is_some())));
    }
    mean
}

#[test]
fn parallel_squares_near_and_far() {
    let distances =
        [(1.0, 0.199_824_895_698_387_46), (0.1, 0.826_994_522_397_256_5), (10.0, 0.003_162_056_838_754_685)];
    for (seed, (distance, expected)) in (0..).zip(distances) {
        let other = parallelogram(Vec3::Z * distance, [Vec3::Y, Vec3::X]);
        form_factor(seed, &other, |at| at.extend(0.0)).assert_near(expected, 4.0);
    }
}

#[test]
fn perpendicular_squares_with_a_common_edge() {
    let other = parallelogram(Vec3::ZERO, [Vec3::Y, Vec3::Z]);
    form_factor(10, &other, |at| at.extend(0.0)).assert_near(0.200_043_776_075_403_16, 4.0);
    // The other twice as high.
    let other = parallelogram(Vec3::ZERO, [Vec3::Y, Vec3::Z * 2.0]);
    form_factor(11, &other, |at| at.extend(0.0)).assert_near(0.232_852_602_795_361_9, 4.0);
}

#[test]
fn coaxial_discs() {
    const SIDES: u32 = 1000;
    for (seed, radius, height, expected) in
        [(20, 1.0, 1.0, 0.381_966_011_250_105_1), (21, 0.5, 2.0, 0.048_058_983_988_962_02)]
    {
        let rim = |i: u32| {
            let angle = std::f32::consts::TAU * i as f32 / SIDES as f32;
            Vec3::new(radius * angle.cos(), radius * angle.sin(), height)
        };
        let fan: Vec<_> = (0..SIDES).map(|i| [Vec3::Z * height, rim(i), rim((i + 1) % SIDES)]).collect();
        form_factor(seed, &fan, |at| disc_point(at).extend(0.0)).assert_near(expected, 4.0);
    }
}

#[test]
fn a_cube_closes() {
    // From the floor, all that leaves arrives: a share on the ceiling, the rest evenly on four walls.
    // The floor itself is left out: rays that begin in it may meet it.
    let world = World::new(&[&cube()[..8], &cube()[10..]].concat());
    let mut faces = [const { Mean::new() }; 5];
    for random in draws(30, 200_000) {
        let direction = cosine_direction(Vec3::Z, Vec2::new(random.z, random.w));
        let hit = world.trace(Vec3::new(random.x, random.y, 0.0), 0.0, direction).unwrap();
        for (face, mean) in (0..).zip(&mut faces) {
            mean.add(f64::from(u8::from(hit.primitive / 2 == face)));
        }
    }
    let [x0, x1, y0, y1, ceiling] = faces;
    ceiling.assert_near(0.199_824_895_698_387_46, 4.0);
    [x0, x1, y0, y1].iter().for_each(|wall| wall.assert_near(0.200_043_776_075_403_16, 4.0));
}
