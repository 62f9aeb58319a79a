//! The reference traversal against trying every triangle: the same hit, bit for bit.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

mod support;

use afterglow_bvh::intersect::{RayShear, TriangleHit, intersect_sphere, intersect_triangle};
use afterglow_bvh::layout::{FLAG_ALPHA_TESTED, FLAG_TWO_SIDED, Sphere, Triangle};
use afterglow_bvh::room::room;
use afterglow_bvh::traverse::{in_object, inverse_of};
use afterglow_bvh::{
    BlasInput, Hit, IDENTITY, Instance, Quality, Query, Ray, TriangleAttributes, build_blas, build_blas_with,
    build_tlas,
};
use glam::Vec3;
use proptest::prelude::*;
use support::{World, accept};

/// A soup of triangles and spheres.
#[derive(Clone, Debug)]
struct Soup {
    positions: Vec<[f32; 3]>,
    indices: Vec<[u32; 3]>,
    spheres: Vec<[f32; 4]>,
}

impl Soup {
    fn input<'a>(&'a self, attributes: &'a [TriangleAttributes]) -> BlasInput<'a> {
        let Self { positions, indices, spheres } = self;
        BlasInput { positions, indices, attributes, spheres, sphere_attributes: &[] }
    }
}

fn point(scale: f32) -> impl Strategy<Value = Vec3> {
    let coordinate = -1.0f32..1.0;
    [coordinate.clone(), coordinate.clone(), coordinate].prop_map(move |point| Vec3::from(point) * scale)
}

/// Corners of one triangle of some awkward kind.
fn triangle() -> impl Strategy<Value = Vec<Vec3>> {
    let corners = |spread: f32| {
        (point(10.0), [point(spread), point(spread), point(spread)])
            .prop_map(|(at, corners)| corners.map(|corner| at + corner).to_vec())
    };
    let sliver = (point(10.0), point(8.0), point(1e-4))
        .prop_map(|(at, along, aside)| vec![at, at + along, at + along * 0.5 + aside]);
    // On a grid, in planes of equal coordinate: edges, corners and planes coincide.
    let flat = (0usize..3, -2i32..=2, -4i32..=4, -4i32..=4).prop_map(|(axis, height, u, v)| {
        let corner = |du: i32, dv: i32| {
            let mut at = Vec3::ZERO;
            at[axis] = height as f32;
            at[(axis + 1) % 3] = (u + du) as f32;
            at[(axis + 2) % 3] = (v + dv) as f32;
            at
        };
        let (a, b, c, d) = (corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
        vec![a, b, c, a, c, d]
    });
    prop_oneof![corners(2.0), corners(1e-4), corners(30.0), sliver, flat]
}

/// Small and large ones, and some of which a grid's rays graze the poles.
fn sphere() -> impl Strategy<Value = [f32; 4]> {
    let free = |radius: f32| {
        (point(10.0), 0.01f32..1.0).prop_map(move |(at, share)| at.extend(radius * share).to_array())
    };
    let on_grid = ([-4i32..=4, -4i32..=4, -4i32..=4], 1i32..=3)
        .prop_map(|([x, y, z], radius)| [x, y, z, radius].map(|number| number as f32));
    prop_oneof![free(3.0), free(1e-3), free(30.0), on_grid]
}

fn soup(most: usize) -> impl Strategy<Value = Soup> {
    let spheres = prop::collection::vec(sphere(), 0..most / 4);
    let triangles = prop::collection::vec(triangle(), 1..most);
    (triangles, spheres, 1usize..3).prop_map(|(triangles, spheres, copies)| {
        let corners: Vec<[f32; 3]> = triangles.concat().iter().map(Vec3::to_array).collect();
        let count = corners.len() as u32 / 3;
        // Copies lie upon one another exactly.
        let indices = (0..count * copies as u32).map(|i| (i % count) * 3);
        let indices = indices.map(|i| [i, i + 1, i + 2]).collect();
        Soup { indices, positions: corners, spheres: spheres.repeat(copies) }
    })
}

fn ray() -> impl Strategy<Value = Ray> {
    let towards =
        |distance: f32| (point(12.0), point(distance)).prop_map(|(target, from)| (target + from, -from));
    let on_grid = ([-5i32..=5, -5i32..=5, -5i32..=5], [-1i32..=1, -1i32..=1, -1i32..=1])
        .prop_filter("a direction", |(_, d)| *d != [0; 3])
        .prop_map(|(o, d)| {
            let vector = |v: [i32; 3]| Vec3::from(v.map(|c| c as f32));
            (vector(o), vector(d))
        });
    let unit = (towards(20.0), 0usize..3).prop_map(|((origin, _), axis)| {
        let mut direction = Vec3::splat(-0.0);
        direction[axis] = -1.0;
        (origin, direction)
    });
    let lines = prop_oneof![towards(20.0), towards(1e5), on_grid, unit];
    let range =
        prop_oneof![Just((0.0, f32::INFINITY)), Just((0.01, 1.5)), Just((f32::NEG_INFINITY, f32::INFINITY))];
    (lines, range).prop_map(|((origin, direction), (t_min, t_max))| Ray { origin, t_min, direction, t_max })
}

/// Rotations, scales, mirrors and shears away from singular.
fn transform() -> impl Strategy<Value = [[f32; 4]; 3]> {
    let general = ([point(1.0), point(1.0), point(1.0)], point(30.0))
        .prop_filter("an inverse", |([x, y, z], _)| x.cross(*y).dot(*z).abs() > 0.05)
        .prop_map(|(rows, offset)| [0, 1, 2].map(|i| [rows[i].x, rows[i].y, rows[i].z, offset[i]]));
    prop_oneof![Just(IDENTITY), general]
}

/// Where a ray meets a leaf record.
fn meet(
    origin: Vec3,
    direction: Vec3,
    shear: &RayShear,
    t_min: f32,
    record: &Triangle,
) -> Option<TriangleHit> {
    let Some(Sphere { centre, radius }) = record.sphere() else {
        return intersect_triangle(origin, shear, &record.vertices);
    };
    let inverse = inverse_of(direction);
    intersect_sphere(origin, inverse, shear, t_min.max(0.0), centre.into(), radius).map(|met| TriangleHit {
        t: met.t,
        barycentrics: [0.0; 2],
        front: met.front,
    })
}

/// The hit found by trying every triangle and sphere.
fn trace_without_tree(world: &World, ray: &Ray, mask: u32) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    for instance in world.tlas.instances() {
        if instance.mask() & mask == 0 {
            continue;
        }
        let blas = &world.blases[&instance.blas_address()];
        let (origin, direction) = in_object(ray.origin, ray.direction, &instance.world_to_object);
        let shear = RayShear::new(direction);
        for triangle in blas.triangles() {
            let Some(met) = meet(origin, direction, &shear, ray.t_min, triangle) else {
                continue;
            };
            let key = (instance.id, triangle.primitive);
            let nearer = best.is_none_or(|b| met.t < b.t || met.t == b.t && key < (b.instance, b.primitive));
            let within = met.t > ray.t_min.max(0.0) && met.t <= ray.t_max;
            let tested = (instance.flags() | triangle.flags) & FLAG_ALPHA_TESTED != 0;
            if nearer && within && (!tested || accept(key.0, key.1, met.barycentrics)) {
                best = Some(Hit {
                    t: met.t,
                    barycentrics: met.barycentrics,
                    primitive: key.1,
                    instance: key.0,
                    front: met.front,
                });
            }
        }
    }
    best
}

/// Asserts that tree and no tree agree on every ray.
fn check(world: &World, rays: &[Ray], mask: u32) -> Result<(), TestCaseError> {
    for ray in rays {
        let expected = trace_without_tree(world, ray, mask);
        let closest = Query { mask, any_hit: false };
        prop_assert_eq!(world.trace(ray, closest), expected, "{:?}", ray);
        let any = world.trace(ray, Query { mask, any_hit: true });
        prop_assert_eq!(any.is_some(), expected.is_some(), "{:?}", ray);
    }
    Ok(())
}

fn instance(blas: &afterglow_bvh::Blas, address: u64) -> Instance {
    Instance { object_to_world: IDENTITY, blas: address, bounds: blas.bounds, id: 0, mask: 0xff, flags: 0 }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn one_level(soup in soup(60), rays in prop::collection::vec(ray(), 30)) {
        // Without spheres, large triangles are in parts.
        let triangles = Soup { spheres: Vec::new(), ..soup.clone() };
        let builds = [(&soup, Quality::Fast), (&soup, Quality::Good), (&triangles, Quality::Good), (&triangles, Quality::Best)];
        for (soup, quality) in builds {
            let blas = build_blas_with(&soup.input(&[]), quality).unwrap();
            let tlas = build_tlas(&[instance(&blas, 16)]).unwrap();
            check(&World { tlas, blases: [(16, blas)].into() }, &rays, 1)?;
        }
    }

    #[test]
    fn refitted(soup in soup(60), moved in soup(60), rays in prop::collection::vec(ray(), 30)) {
        // The triangles of one soup in the tree of another.
        let mut blas = build_blas_with(&soup.input(&[]), Quality::Good).unwrap();
        blas.refit(&moved.positions, |primitive| [0, 1, 2].map(|corner| primitive * 3 + corner));
        let tlas = build_tlas(&[instance(&blas, 16)]).unwrap();
        check(&World { tlas, blases: [(16, blas)].into() }, &rays, 1)?;
    }

    #[test]
    fn two_levels(
        soups in prop::collection::vec(soup(20), 1..4),
        places in prop::collection::vec((0usize..4, transform(), any::<u8>(), 0u32..4), 1..30),
        rays in prop::collection::vec(ray(), 30),
        mask in 1u32..256,
    ) {
        let blases: Vec<_> = soups.iter().enumerate().map(|(number, soup)| {
            let attributes: Vec<_> = (0..(soup.indices.len() + soup.spheres.len()) as u32).map(|i| TriangleAttributes {
                primitive: 1000 * number as u32 + i,
                flags: if i % 5 == 0 { FLAG_ALPHA_TESTED } else { 0 },
            }).collect();
            let (attributes, of_spheres) = attributes.split_at(soup.indices.len());
            let input = BlasInput { sphere_attributes: of_spheres, ..soup.input(attributes) };
            (16 * number as u64, build_blas_with(&input, Quality::Fast).unwrap())
        }).collect();
        let instances: Vec<_> = places.iter().zip(0..).map(|(&(blas, object_to_world, mask, flags), id)| {
            let (address, blas) = &blases[blas % blases.len()];
            Instance { object_to_world, id, mask, flags: flags & (FLAG_ALPHA_TESTED | FLAG_TWO_SIDED), ..instance(blas, *address) }
        }).collect();
        let tlas = build_tlas(&instances).unwrap();
        check(&World { tlas, blases: blases.into_iter().collect() }, &rays, mask)?;
    }

    #[test]
    fn any_words_end(words in prop::collection::vec(any::<u32>(), 0..200), rays in prop::collection::vec(ray(), 3)) {
        // Damaged structures give some answer in bounded time and never read outside.
        let blas = |address: u64| address.is_multiple_of(2).then_some(words.as_slice());
        let scene = afterglow_bvh::Scene { tlas: &words, blas: &blas };
        for ray in rays {
            afterglow_bvh::trace(&scene, &ray, Query { mask: 0xff, any_hit: false }, &|_, _, _| true);
        }
    }
}

#[test]
fn no_ray_leaves_a_closed_room() {
    let (positions, indices) = room(24);
    let blas = build_blas(&positions, &indices, Quality::Good).unwrap();
    let tlas = build_tlas(&[instance(&blas, 16)]).unwrap();
    let world = World { tlas, blases: [(16, blas)].into() };
    // At corners and edges of the walls, where a gap would be.
    let of_wall = |triangle: &&[u32; 3]| {
        triangle.iter().all(|&corner| Vec3::from(positions[corner as usize]).abs().max_element() > 9.0)
    };
    for (i, triangle) in indices.iter().filter(of_wall).enumerate() {
        let [a, b, _] = triangle.map(|corner| Vec3::from(positions[corner as usize]));
        let origin = Vec3::new(0.1, 3.0, -0.2);
        for target in [a, (a + b) * 0.5, a + (b - a) * (i as f32 * 0.618).fract()] {
            let ray = Ray { origin, t_min: 0.0, direction: target - origin, t_max: f32::INFINITY };
            let query = Query { mask: 1, any_hit: false };
            let hit = world.trace(&ray, query);
            assert!(hit.is_some_and(|hit| hit.t < 1.01), "{ray:?} {hit:?}");
        }
    }
}
