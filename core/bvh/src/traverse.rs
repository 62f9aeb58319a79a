//! The reference traversal: the twin of `shaders/include/bvh.glsl`, step by step over the same words,
//! so that a test of one is a test of the other.

use crate::intersect::{RayShear, TriangleHit, intersect_sphere, intersect_triangle};
use crate::layout::{
    FLAG_ALPHA_TESTED, FLAG_IDENTITY, INSTANCE_UNITS, InstanceRecord, MAX_STEPS, NODE_UNITS, Node,
    STACK_ENTRIES, Sphere, TRIANGLE_UNITS, Triangle, WIDTH, record,
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
    shear: RayShear,
    /// 7 less the octant: bit 2, 1, 0 set where x, y, z of the direction are not negative.
    order: u32,
}

/// Components of a direction nearer to 0 than this count as this.
const LEAST_COMPONENT: f32 = 8.271_806e-25; // 2^-80
/// Rounding of a slab's distances, relative to their terms; 8 half units in the last place.
const SLAB_ERROR: f32 = 4.768_371_6e-7; // 2^-21

impl LocalRay {
    fn new(origin: Vec3, direction: Vec3) -> Self {
        let inverse = inverse_of(direction);
        let bit = |d: f32, value: u32| if d.is_sign_negative() { 0 } else { value };
        Self {
            origin,
            inverse,
            shear: RayShear::new(direction),
            order: bit(inverse.x, 4) | bit(inverse.y, 2) | bit(inverse.z, 1),
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

/// Children or leaf records still to visit. In `mask` bits 24..32 are inner children, nearest
/// first from bit 31, with the inner mask of their node in bits 0..8; or bits 0..24 are leaf records.
#[derive(Clone, Copy, Default)]
struct Group {
    base: u32,
    mask: u32,
}

const ROOT: Group = Group { base: 0, mask: 0x8000_0000 };

impl Group {
    fn has_nodes(self) -> bool {
        self.mask > 0x00ff_ffff
    }

    /// Takes the nearest inner child; returns where it lies.
    fn take_node(&mut self, order: u32) -> u32 {
        let bit = 31 - self.mask.leading_zeros();
        let inner_mask = self.mask & 0xff;
        self.mask &= !(1 << bit);
        let slot = (bit - 24) ^ order;
        let before = (inner_mask & !(u32::MAX << slot)).count_ones();
        self.base.wrapping_add(before * NODE_UNITS)
    }

    /// Takes a leaf record; returns where it lies.
    fn take_leaf(&mut self, units: u32) -> u32 {
        let bit = 31 - self.mask.leading_zeros();
        self.mask &= !(1 << bit);
        self.base.wrapping_add(bit * units)
    }
}

/// The child slots of `node` whose boxes the ray meets in `t_min..=t_max`: bits as in [`Group`],
/// without the inner mask.
fn meet_children(node: &Node, ray: &LocalRay, t_min: f32, t_max: f32) -> u32 {
    let grid = Vec3::from(node.origin.map(f32::from_bits));
    let spacing = Vec3::from(node.exponents.map(|e| f32::from_bits(u32::from(e) << 23)));
    let scale = spacing * ray.inverse;
    let start = (grid - ray.origin) * ray.inverse;
    let error = SLAB_ERROR * (start.abs() + 256.0 * scale.abs());
    let (start_near, start_far) = (start - error, start + error);
    let mut met = 0;
    for slot in 0..WIDTH {
        let mut near = t_min;
        let mut far = t_max;
        for axis in 0..3 {
            let (low, high) = (node.low[axis][slot], node.high[axis][slot]);
            let positive = ray.order & (4 >> axis) != 0;
            let (first, last) = if positive { (low, high) } else { (high, low) };
            near = near.max(f32::from(first).mul_add(scale[axis], start_near[axis]));
            far = far.min(f32::from(last).mul_add(scale[axis], start_far[axis]));
        }
        if near <= far {
            met |= slot_bits(node.meta[slot], ray.order);
        }
    }
    met
}

/// The bits of a slot: an inner child's by its place along the ray, a leaf's by its records.
fn slot_bits(meta: u8, order: u32) -> u32 {
    let meta = u32::from(meta);
    let inner = meta & 0x18 == 0x18;
    let place = (meta ^ if inner { order } else { 0 }) & 31;
    (meta >> 5) << place
}

/// The state of a traversal.
struct Walk<'a> {
    words: &'a [u32],
    ray: LocalRay,
    /// The id, flags of the instance the ray is in, and the stack's height where it entered.
    instance: Option<(u32, u32, usize)>,
    stack: Vec<Group>,
    nodes: Group,
    leaves: Group,
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
        nodes: ROOT,
        leaves: Group::default(),
        hit: None,
        t_max: ray.t_max,
    };
    for _ in 0..MAX_STEPS {
        walk.visit_node(ray.t_min);
        while walk.leaves.mask != 0 {
            if let Some((instance, flags, _)) = walk.instance {
                walk.meet_triangle(ray, instance, flags, accept);
                if query.any_hit && walk.hit.is_some() {
                    return walk.hit;
                }
            } else {
                walk.enter_instance(scene, ray, query.mask);
            }
        }
        if !walk.nodes.has_nodes() && !walk.pop(scene, ray) {
            break;
        }
    }
    walk.hit
}

impl<'a> Walk<'a> {
    fn push(&mut self, group: Group) {
        if self.stack.len() < STACK_ENTRIES {
            self.stack.push(group);
        }
    }

    /// Visits the nearest node of the group, or takes a popped group of leaves.
    fn visit_node(&mut self, t_min: f32) {
        if !self.nodes.has_nodes() {
            self.leaves = std::mem::take(&mut self.nodes);
            return;
        }
        let place = self.nodes.take_node(self.ray.order);
        if self.nodes.has_nodes() {
            self.push(self.nodes);
        }
        let Some(node) = record::<Node>(self.words, place) else {
            self.nodes = Group::default();
            return;
        };
        let met = meet_children(&node, &self.ray, t_min, self.t_max);
        self.nodes = Group { base: node.child_base, mask: met & 0xff00_0000 | u32::from(node.inner_mask) };
        self.leaves = Group { base: node.leaf_base, mask: met & 0x00ff_ffff };
    }

    fn meet_triangle(&mut self, ray: &Ray, instance: u32, flags: u32, accept: Accept) {
        let place = self.leaves.take_leaf(TRIANGLE_UNITS);
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

    fn enter_instance(&mut self, scene: &Scene<'a>, ray: &Ray, mask: u32) {
        let place = self.leaves.take_leaf(INSTANCE_UNITS);
        let Some(instance) = record::<InstanceRecord>(self.words, place) else {
            return;
        };
        let Some(words) = (scene.blas)(instance.blas_address()) else {
            return;
        };
        if instance.mask() & mask == 0 {
            return;
        }
        if self.nodes.has_nodes() {
            self.push(self.nodes);
        }
        if self.leaves.mask != 0 {
            self.push(self.leaves);
        }
        if instance.flags() & FLAG_IDENTITY == 0 {
            self.ray = LocalRay::in_object(ray, &instance.world_to_object);
        }
        self.words = words;
        self.instance = Some((instance.id, instance.flags(), self.stack.len()));
        self.nodes = ROOT;
        self.leaves = Group::default();
    }

    /// The next group from the stack, leaving the instance where it has none; false at the end.
    fn pop(&mut self, scene: &Scene<'a>, ray: &Ray) -> bool {
        let outside = self.instance.is_some_and(|(_, _, floor)| self.stack.len() <= floor);
        let Some(group) = self.stack.pop() else {
            return false;
        };
        if outside {
            self.instance = None;
            self.words = scene.tlas;
            self.ray = LocalRay::new(ray.origin, ray.direction);
        }
        self.nodes = group;
        true
    }
}
