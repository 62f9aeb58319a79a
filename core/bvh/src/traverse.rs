//! The reference traversal: the twin of `shaders/include/bvh.glsl`, the same visits in the same order over the same words,
//! so that a test of one is a test of the other.

use crate::intersect::{RayShear, TriangleHit, intersect_sphere, intersect_triangle};
use crate::layout::{
    Child, FLAG_ALPHA_TESTED, FLAG_IDENTITY, InstanceRecord, MAX_STEPS, Node, STACK_ENTRIES, Sphere,
    TRIANGLE_UNITS, Triangle, WIDTH, record,
};
use glam::Vec3;

/// A ray in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Hits count beyond this t; below 0 counts as 0.
    pub t_min: f32,
    /// Where it goes, of any length but 0; t counts in this length.
    pub direction: Vec3,
    /// Hits count up to this t.
    pub t_max: f32,
}

/// What to look for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Query {
    /// Instances that share a bit with this are met.
    pub mask: u32,
    /// Any hit will do, not only the closest.
    pub any_hit: bool,
}

/// A hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Weights of the second and third corner; 0 on a sphere.
    pub barycentrics: [f32; 2],
    /// The number of the triangle or sphere in its bottom level.
    pub primitive: u32,
    /// The instance's id.
    pub instance: u32,
    /// The corners run counter-clockwise as seen from the ray's origin, in object space; of a sphere the
    /// outside is met.
    pub front: bool,
}

/// Asked for alpha-tested triangles and spheres: (instance, primitive, barycentrics).
pub type Accept<'a> = &'a dyn Fn(u32, u32, [f32; 2]) -> bool;

/// A top level with the memory that its addresses mean.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// [`crate::Tlas::words`].
    pub tlas: &'a [u32],
    /// [`crate::Blas::words`] at an address.
    pub blas: &'a dyn Fn(u64) -> Option<&'a [u32]>,
}

/// A ray as nodes and triangles see it, in the world or in an object.
struct LocalRay {
    origin: Vec3,
    inverse: Vec3,
    /// Less the origin's distances from 0, those a little less for planes that are met first, and a little more for the last.
    start: [Vec3; 2],
    /// Which planes along x, y, z are met first: 0 the least ones.
    first: [usize; 3],
    shear: RayShear,
}

/// Components of a direction nearer to 0 than this count as this.
const LEAST_COMPONENT: f32 = 8.271_806e-25; // 2^-80
/// Rounding of the origin's part of a plane's distance, relative.
const ORIGIN_ERROR: f32 = 2.384_185_8e-7; // 2^-22
/// What planes are moved outwards by, so that a ray along one at 0 stays within it (2^-50).
const PLANE_ERROR: f32 = 8.881_784e-16;
/// Rounding of distances, in units in the last place.
const DISTANCE_UNITS: i32 = 4;

impl LocalRay {
    fn new(origin: Vec3, direction: Vec3) -> Self {
        let inverse = inverse_of(direction);
        let start = -(origin * inverse);
        let error = inverse.abs().mul_add(Vec3::splat(PLANE_ERROR), ORIGIN_ERROR * start.abs());
        Self {
            origin,
            inverse,
            start: [start - error, start + error],
            first: inverse.to_array().map(|inverse| usize::from(inverse.is_sign_negative())),
            shear: RayShear::new(direction),
        }
    }

    /// Where the ray meets a triangle, or a sphere beyond `t_min`.
    fn meet(&self, record: &Triangle, t_min: f32) -> Option<TriangleHit> {
        let Some(Sphere { centre, radius }) = record.sphere() else {
            return intersect_triangle(self.origin, &self.shear, &record.vertices);
        };
        intersect_sphere(self.origin, self.inverse, &self.shear, t_min, centre.into(), radius)
            .map(|met| TriangleHit { t: met.t, barycentrics: [0.0; 2], front: met.front })
    }

    fn in_object(ray: &Ray, world_to_object: &[[f32; 4]; 3]) -> Self {
        let (origin, direction) = in_object(ray.origin, ray.direction, world_to_object);
        Self::new(origin, direction)
    }
}

/// Reciprocals of a direction's components as traversal has them, all of them finite.
pub fn inverse_of(direction: Vec3) -> Vec3 {
    let away_from_zero = |d: f32| if d.abs() < LEAST_COMPONENT { LEAST_COMPONENT.copysign(d) } else { d };
    Vec3::from(direction.to_array().map(away_from_zero)).recip()
}

/// Origin and direction of a ray in object space, as traversal has them.
pub fn in_object(origin: Vec3, direction: Vec3, world_to_object: &[[f32; 4]; 3]) -> (Vec3, Vec3) {
    let linear = |v: Vec3| world_to_object.map(|r| r[0] * v.x + r[1] * v.y + r[2] * v.z);
    let offset = Vec3::from(world_to_object.map(|row| row[3]));
    (Vec3::from(linear(origin)) + offset, Vec3::from(linear(direction)))
}

/// A distance as an integer that sorts like it, down to 0.
fn sortable(distance: f32) -> i32 {
    distance.to_bits() as i32
}

/// Of a child that the ray does not meet.
const MISSED: i32 = i32::MAX;

/// How far the ray goes until it is in the box of each child, in t_min..=t_max, as integers that sort like distances with the
/// child's slot in their last bits; `MISSED` where it does not meet it.
fn enter_children(node: &Node, ray: &LocalRay, t_min: f32, t_max: f32) -> [i32; WIDTH] {
    std::array::from_fn(|slot| {
        let mut near = sortable(t_min);
        let mut far = sortable(t_max);
        for axis in 0..3 {
            let first = ray.first[axis];
            let planes = &node.planes[axis];
            let [enters, leaves] = [(first, 0), (1 - first, 1)]
                .map(|(plane, end)| planes[plane][slot].mul_add(ray.inverse[axis], ray.start[end][axis]));
            near = near.max(sortable(enters));
            far = far.min(sortable(leaves));
        }
        if near <= far.wrapping_add(DISTANCE_UNITS) { near & !3 | slot as i32 } else { MISSED }
    })
}

/// The state of a traversal.
struct Walk<'a> {
    words: &'a [u32],
    ray: LocalRay,
    /// The id, flags of the instance the ray is in, and the stack's height where it entered.
    instance: Option<(u32, u32, usize)>,
    stack: Vec<u32>,
    /// What comes next.
    reference: u32,
    hit: Option<Hit>,
    t_max: f32,
}

/// The closest hit of `ray`, or some hit where `query` wants any. Of hits at the same t the one with
/// the lesser (instance, primitive) counts, so that the answer depends on no tree.
pub fn trace(scene: &Scene, ray: &Ray, query: Query, accept: Accept) -> Option<Hit> {
    let ray = &Ray { t_min: ray.t_min.max(0.0), ..*ray };
    let mut walk = Walk {
        words: scene.tlas,
        ray: LocalRay::new(ray.origin, ray.direction),
        instance: None,
        stack: Vec::with_capacity(STACK_ENTRIES),
        reference: Child::Inner(0).reference(),
        hit: None,
        t_max: ray.t_max,
    };
    for _ in 0..MAX_STEPS {
        if let Child::Inner(place) = Child::of(walk.reference) {
            walk.visit_node(place, ray.t_min, query.any_hit);
        }
        if let Child::Leaf { place, count } = Child::of(walk.reference) {
            if let Some((instance, flags, _)) = walk.instance {
                let next = Child::Leaf { place: place + TRIANGLE_UNITS, count: count.max(2) - 1 };
                walk.reference = if count > 1 { next } else { Child::Nothing }.reference();
                walk.meet_triangle(place, ray, instance, flags, accept);
                if query.any_hit && walk.hit.is_some() {
                    return walk.hit;
                }
            } else {
                walk.reference = Child::Nothing.reference();
                walk.enter_instance(place, scene, ray, query.mask);
            }
        }
        if walk.reference == Child::Nothing.reference() && !walk.pop(scene, ray) {
            break;
        }
    }
    walk.hit
}

impl<'a> Walk<'a> {
    /// Goes to the nearest of a node's children that the ray meets; the others wait, the farthest below. Where any hit
    /// will do, to the first.
    fn visit_node(&mut self, place: u32, t_min: f32, any_hit: bool) {
        self.reference = Child::Nothing.reference();
        let Some(node) = record::<Node>(self.words, place) else {
            return;
        };
        let mut met = enter_children(&node, &self.ray, t_min, self.t_max);
        if !any_hit {
            met.sort_unstable();
        }
        for met in met.into_iter().rev().filter(|&met| met != MISSED) {
            if self.reference != Child::Nothing.reference() && self.stack.len() < STACK_ENTRIES {
                self.stack.push(self.reference);
            }
            self.reference = node.children[(met & 3) as usize];
        }
    }

    fn meet_triangle(&mut self, place: u32, ray: &Ray, instance: u32, flags: u32, accept: Accept) {
        let Some(triangle) = record::<Triangle>(self.words, place) else {
            return;
        };
        let met = self.ray.meet(&triangle, ray.t_min);
        let Some(met) = met.filter(|met| met.t > ray.t_min && met.t <= self.t_max) else {
            return;
        };
        let tie = self.hit.is_some_and(|hit| {
            met.t == hit.t && (instance, triangle.primitive) > (hit.instance, hit.primitive)
        });
        let tested = (flags | triangle.flags) & FLAG_ALPHA_TESTED != 0;
        if tie || (tested && !accept(instance, triangle.primitive, met.barycentrics)) {
            return;
        }
        self.t_max = met.t;
        self.hit = Some(Hit {
            t: met.t,
            barycentrics: met.barycentrics,
            primitive: triangle.primitive,
            instance,
            front: met.front,
        });
    }

    fn enter_instance(&mut self, place: u32, scene: &Scene<'a>, ray: &Ray, mask: u32) {
        let Some(instance) = record::<InstanceRecord>(self.words, place) else {
            return;
        };
        let Some(words) = (scene.blas)(instance.blas_address()) else {
            return;
        };
        if instance.mask() & mask == 0 {
            return;
        }
        if instance.flags() & FLAG_IDENTITY == 0 {
            self.ray = LocalRay::in_object(ray, &instance.world_to_object);
        }
        self.words = words;
        self.instance = Some((instance.id, instance.flags(), self.stack.len()));
        self.reference = Child::Inner(0).reference();
    }

    /// The next child that waits, leaving the instance where none does in it; false at the end.
    fn pop(&mut self, scene: &Scene<'a>, ray: &Ray) -> bool {
        let outside = self.instance.is_some_and(|(_, _, floor)| self.stack.len() <= floor);
        let Some(reference) = self.stack.pop() else {
            return false;
        };
        if outside {
            self.instance = None;
            self.words = scene.tlas;
            self.ray = LocalRay::new(ray.origin, ray.direction);
        }
        self.reference = reference;
        true
    }
}
