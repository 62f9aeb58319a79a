//! The shaders' traversal against the reference, ray by ray.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

#[path = "support/gpu.rs"]
mod gpu;
mod support;

use afterglow_bvh::layout::FLAG_ALPHA_TESTED;
use afterglow_bvh::room::room;
use afterglow_bvh::{
    Blas, BlasInput, Hit, IDENTITY, Instance, Quality, Query, Ray, TriangleAttributes, build_blas,
    build_blas_with, build_tlas,
};
use glam::{Mat4, Quat, Vec3};
use gpu::{Answer, RayRecord, Search, Tracer};
use support::World;

/// Numbers in [0, 1) by the golden ratio of dimension `axis`, the same on every run.
fn spread(index: u32, axis: u32) -> f32 {
    const STEPS: [f64; 5] = [0.754_877_67, 0.569_840_29, 0.430_159_71, 0.324_717_96, 0.245_122_33];
    (f64::from(index) * STEPS[axis as usize] + 0.37).fract() as f32
}

fn direction(index: u32, axis: u32) -> Vec3 {
    let z = spread(index, axis) * 2.0 - 1.0;
    let angle = spread(index, axis + 1) * std::f32::consts::TAU;
    let across = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(across * angle.cos(), across * angle.sin(), z)
}

/// A camera's rays, some along axes, and rays from points about the room.
fn rays(count: u32) -> Vec<Ray> {
    (0..count)
        .map(|i| {
            let inside = Vec3::new(spread(i, 2), spread(i, 3), spread(i, 4)) * 18.0 - 9.0;
            let (origin, direction) = match i % 4 {
                0 => (Vec3::new(0.3, 1.0, -0.2), direction(i, 0)),
                1 => (inside, Vec3::AXES[i as usize / 4 % 3] * if i % 8 < 4 { 1.0 } else { -1.0 }),
                2 => (inside - direction(i, 0) * 1e4, direction(i, 0)),
                _ => (inside, direction(i, 0) * 3.0),
            };
            Ray { origin, t_min: 1e-4, direction, t_max: if i % 5 == 0 { 6.0 } else { f32::INFINITY } }
        })
        .collect()
}

fn record(ray: &Ray) -> RayRecord {
    RayRecord {
        origin: ray.origin.to_array(),
        t_min: ray.t_min,
        direction: ray.direction.to_array(),
        t_max: ray.t_max,
    }
}

/// Whether an answer is the reference's; rounding may differ where a device does not fuse.
fn agrees(answer: &Answer, expected: Option<Hit>) -> bool {
    let Some(hit) = expected else {
        return !answer.found();
    };
    let near = |a: f32, b: f32, tolerance: f32| (a - b).abs() <= tolerance * b.abs().max(1.0);
    answer.found()
        && (answer.primitive, answer.instance, answer.found_and_front & 2 != 0)
            == (hit.primitive, hit.instance, hit.front)
        && near(answer.t, hit.t, 1e-5)
        && near(answer.barycentrics[0], hit.barycentrics[0], 0.02)
        && near(answer.barycentrics[1], hit.barycentrics[1], 0.02)
}

/// Uploads a world and asserts that both traversals agree but for a few rays at edges.
fn check(blases: Vec<Blas>, place: impl Fn(&[(u64, &Blas)]) -> Vec<Instance>) {
    let tracer = Tracer::new(&gpu::open(), "tests/shaders/trace.comp");
    let buffers: Vec<_> = blases.iter().map(|blas| tracer.upload(&blas.words)).collect();
    let addressed: Vec<_> = buffers.iter().map(|buffer| buffer.address()).zip(&blases).collect();
    let tlas = build_tlas(&place(&addressed)).unwrap();
    let top = tracer.upload(&tlas.words);
    let addresses: Vec<u64> = buffers.iter().map(|buffer| buffer.address()).collect();
    let world = World { tlas, blases: addresses.into_iter().zip(blases).collect() };

    let rays = rays(4000);
    let records: Vec<RayRecord> = rays.iter().map(record).collect();
    for (mask, any_hit) in [(0xff, false), (0x1, false), (0xff, true)] {
        let answers = tracer.trace(top.address(), &records, Search { mask, any_hit });
        let mut differing = 0;
        let mut found = 0;
        for (answer, ray) in answers.iter().zip(&rays) {
            let expected = world.trace(ray, Query { mask, any_hit });
            found += u32::from(expected.is_some());
            let agree = if any_hit { answer.found() == expected.is_some() } else { agrees(answer, expected) };
            differing += u32::from(!agree);
        }
        assert!(found > 1000, "{found} hits make no test");
        assert!(differing <= 8, "{differing} of {} rays differ", rays.len());
    }
    assert_eq!(tracer.gpu.validation_messages(), Vec::<String>::new());
}

#[test]
fn one_identity_instance() {
    let (positions, indices) = room(12);
    let blas = build_blas(&positions, &indices, Quality::Good).unwrap();
    check(vec![blas], |blases| {
        let (address, blas) = blases[0];
        vec![Instance {
            object_to_world: IDENTITY,
            blas: address,
            bounds: blas.bounds,
            id: 5,
            mask: 1,
            flags: 0,
        }]
    });
}

/// Spheres hang in the room, some cut by its walls and by one another.
#[test]
fn spheres_among_triangles() {
    let (positions, indices) = room(6);
    let spheres: Vec<[f32; 4]> = (0..150)
        .map(|i| {
            let at = Vec3::new(spread(i, 0), spread(i, 1), spread(i, 2)) * 18.0 - 9.0;
            at.extend(0.05 + spread(i, 3) * if i % 10 == 0 { 3.0 } else { 0.8 }).to_array()
        })
        .collect();
    let flags = |i: u32| if i.is_multiple_of(7) { FLAG_ALPHA_TESTED } else { 0 };
    let first = indices.len() as u32;
    let attributes: Vec<TriangleAttributes> =
        (0..150).map(|i| TriangleAttributes { primitive: first + i, flags: flags(i) }).collect();
    let input = BlasInput {
        positions: &positions,
        indices: &indices,
        spheres: &spheres,
        sphere_attributes: &attributes,
        ..BlasInput::default()
    };
    let blas = build_blas_with(&input, Quality::Good).unwrap();
    check(vec![blas], |blases| {
        let (address, blas) = blases[0];
        let turn = Mat4::from_rotation_y(0.4).transpose();
        let rows = [0, 1, 2].map(|row| turn.col(row).to_array());
        let instance = Instance {
            object_to_world: IDENTITY,
            blas: address,
            bounds: blas.bounds,
            id: 5,
            mask: 1,
            flags: 0,
        };
        vec![instance, Instance { object_to_world: rows, id: 6, mask: 2, ..instance }]
    });
}

#[test]
fn many_instances_masks_and_alpha() {
    let (positions, indices) = room(4);
    let small = build_blas(&positions, &indices, Quality::Fast).unwrap();
    let empty = build_blas(&[], &[], Quality::Fast).unwrap();
    check(vec![small, empty], |blases| {
        (0..60)
            .map(|i| {
                let at = Vec3::new(spread(i, 0), spread(i, 1), spread(i, 2)) * 20.0 - 10.0;
                let turn = Quat::from_axis_angle(direction(i, 3), i as f32);
                let scale = Vec3::new(0.1, 0.15 + spread(i, 3) * 0.1, if i % 3 == 0 { -0.1 } else { 0.12 });
                let matrix = Mat4::from_scale_rotation_translation(scale, turn, at).transpose();
                let (address, blas) = blases[usize::from(i % 10 == 9)];
                Instance {
                    object_to_world: [0, 1, 2].map(|row| matrix.col(row).to_array()),
                    blas: address,
                    bounds: blas.bounds,
                    id: 100 + i,
                    mask: if i % 4 == 0 { 2 } else { 3 },
                    flags: if i % 2 == 0 { FLAG_ALPHA_TESTED } else { 0 },
                }
            })
            .collect()
    });
}
