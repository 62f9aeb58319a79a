//! Where numbers get large, small or degenerate: rays that start at surfaces, slivers, triangles without area.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

mod support;

use afterglow_bvh::intersect::offset_ray;
use afterglow_bvh::room::room;
use afterglow_bvh::{Blas, Hit, IDENTITY, Instance, Quality, Query, Ray, build_blas, build_tlas};
use glam::{Quat, Vec3};
use support::World;

/// A mixed congruential generator (constants of Numerical Recipes), its upper bits.
struct Random(u32);

impl Random {
    /// In [0, 1).
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / (1 << 24) as f32
    }

    fn direction(&mut self) -> Vec3 {
        let (z, angle) = (self.unit() * 2.0 - 1.0, self.unit() * std::f32::consts::TAU);
        let across = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(across * angle.cos(), across * angle.sin(), z)
    }
}

fn world(positions: &[[f32; 3]], indices: &[[u32; 3]]) -> World {
    let blas = build_blas(positions, indices, Quality::Good).unwrap();
    world_of(blas)
}

fn world_of(blas: Blas) -> World {
    let bounds = blas.bounds;
    let instance = Instance { object_to_world: IDENTITY, blas: 16, bounds, id: 0, mask: 1, flags: 0 };
    World { tlas: build_tlas(&[instance]).unwrap(), blases: [(16, blas)].into() }
}

fn closest(world: &World, origin: Vec3, direction: Vec3) -> Option<Hit> {
    let ray = Ray { origin, t_min: 0.0, direction, t_max: f32::INFINITY };
    world.trace(&ray, Query { mask: 1, any_hit: false })
}

/// A square of two triangles around `centre`, turned by `turn` out of the plane z = 0.
fn square(centre: Vec3, turn: Quat, half: f32) -> [[f32; 3]; 4] {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| (centre + turn * (Vec3::new(x, y, 0.0) * half)).to_array())
}

const SQUARE: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// A point of one of the square's triangles, as shading has it: corners weighted by barycentrics.
fn point(corners: &[[f32; 3]; 4], random: &mut Random) -> (Vec3, Vec3) {
    let [a, b, c] =
        SQUARE[usize::from(random.unit() < 0.5)].map(|corner| Vec3::from(corners[corner as usize]));
    let (u, v) = (random.unit(), random.unit());
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    (a + (b - a) * u + (c - a) * v, (b - a).cross(c - a).normalize())
}

#[test]
fn no_ray_from_a_plane_meets_that_plane() {
    // A million rays: ten sizes, turned four ways, both sides.
    let mut random = Random(1);
    for power in -3..=6 {
        let scale = 10f32.powi(power);
        for turn in [0.0f32, 0.3, 1.1, 2.5] {
            let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.64, 0.48), turn);
            let corners = square(Vec3::new(1.0, -0.7, 0.4) * scale, turn, scale);
            let world = world(&corners, &SQUARE);
            for _ in 0..25_000 {
                let (at, normal) = point(&corners, &mut random);
                let normal = if random.unit() < 0.5 { normal } else { -normal };
                let direction = random.direction();
                let direction = if direction.dot(normal) < 0.0 { -direction } else { direction };
                let hit = closest(&world, offset_ray(at, normal), direction);
                assert!(hit.is_none(), "at {at} along {direction}: {hit:?}");
            }
        }
    }
}

/// Rays of 4,000 from one plane that are not stopped by another at distance `gap`.
fn leaks(scale: f32, gap: f32) -> usize {
    let mut random = Random(2);
    let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.64, 0.48), 1.1);
    let centre = Vec3::new(1.0, -0.7, 0.4) * scale;
    let corners = square(centre, turn, scale);
    let normal = turn * Vec3::Z;
    // Far larger, so that nothing passes beside it.
    let other = square(centre + normal * gap, turn, scale * 100.0);
    let world = world(&other, &SQUARE);
    let leaks = (0..4_000).filter(|_| {
        let (at, _) = point(&corners, &mut random);
        let aside = random.direction() * 0.9;
        closest(&world, offset_ray(at, normal), normal + aside).is_none()
    });
    leaks.count()
}

#[test]
fn the_least_gap_between_planes_that_holds_is_what_the_offset_says() {
    for power in 0..=6 {
        let scale = 10f32.powi(power);
        let spacing = scale * f32::EPSILON;
        // The offset is of 256 spacings along each axis; powers of two are tried down from where it must hold.
        let gaps = (0..=10).map(|halvings| 4096.0 * spacing / (1 << halvings) as f32);
        let least = gaps.take_while(|&gap| leaks(scale, gap) == 0).last();
        println!("10^{power}: planes {least:?} apart hold, {:?} spacings", least.map(|gap| gap / spacing));
        assert!(least.is_some_and(|gap| gap <= 1024.0 * spacing), "10^{power}: {least:?}");
    }
}

#[test]
fn slivers_leave_no_gap() {
    // A fan of slivers, a million times as long as wide, against the same square in two triangles.
    let mut positions = vec![[-1.0f32, -1.0, 0.5]];
    let count = 2000u32;
    for i in 0..=count {
        positions.push([1.0, -1.0 + 2e-6 * i as f32, 0.5]);
    }
    let fan: Vec<[u32; 3]> = (1..=count).map(|i| [0, i, i + 1]).collect();
    let whole = [[0, 1, count + 1]];
    let (slivers, whole) = (world(&positions, &fan), world(&positions, &whole));
    let mut random = Random(3);
    let mut met = 0;
    for _ in 0..100_000 {
        let (along, across) = (random.unit(), random.unit() * 1.2 - 0.1);
        let width = 2e-6 * count as f32;
        let target = Vec3::new(-1.0 + 2.0 * along, -1.0 + along * across * width, 0.5);
        let origin = target + random.direction() + Vec3::Z * 1.5;
        let (a, b) = (closest(&slivers, origin, target - origin), closest(&whole, origin, target - origin));
        assert_eq!(a.is_some(), b.is_some(), "{target}");
        met += usize::from(a.is_some());
    }
    assert!(met > 50_000, "{met} hits make no test");
}

#[test]
fn triangles_without_area_change_nothing() {
    let (positions, indices) = room(8);
    let mut with = indices.clone();
    for triangle in &indices {
        let [a, b, _] = *triangle;
        with.extend([[a, b, b], [a, a, a]]);
    }
    let plain = world(&positions, &indices);
    let blas = build_blas(&positions, &with, Quality::Good).unwrap();
    assert_eq!(blas.skipped as usize, 2 * indices.len());
    let degenerate = world_of(blas);
    let mut random = Random(4);
    for _ in 0..10_000 {
        let (origin, direction) = (random.direction() * 3.0, random.direction());
        assert_eq!(closest(&degenerate, origin, direction), closest(&plain, origin, direction));
    }
}

#[test]
fn scaled_scenes_answer_alike() {
    let (positions, indices) = room(8);
    let plain = world(&positions, &indices);
    let mut random = Random(5);
    let rays: Vec<_> = (0..2000).map(|_| (random.direction() * 3.0, random.direction())).collect();
    for power in [-30i32, -10, 10, 30] {
        // Powers of two scale without rounding.
        let scale = 2f32.powi(power);
        let scaled: Vec<[f32; 3]> = positions.iter().map(|&p| (Vec3::from(p) * scale).to_array()).collect();
        let scaled = world(&scaled, &indices);
        for &(origin, direction) in &rays {
            let expected = closest(&plain, origin, direction).map(|hit| Hit { t: hit.t * scale, ..hit });
            assert_eq!(closest(&scaled, origin * scale, direction), expected);
        }
    }
}
