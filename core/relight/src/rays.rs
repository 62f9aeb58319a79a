//! Fast rays through a bottom level of `afterglow-bvh`.
//!
//! That crate's own traversal is the twin of a shader, operation by operation. Here a form factor is the mean of many
//! rays, so a hit or miss on the very edge of a triangle does not matter, and speed does: boxes are tested four at once
//! without fused operations, triangles by Moller and Trumbore's test (Fast, Minimum Storage Ray/Triangle Intersection, 1997).

use afterglow_bvh::Blas;
use afterglow_bvh::layout::{Child, MOST_WAITING_BLAS, NODE_UNITS, Node, TRIANGLE_UNITS, WIDTH};
use glam::Vec3;

/// Components of a direction nearer to 0 than this count as this.
const LEAST_COMPONENT: f32 = 1e-24;
/// Rounding of box distances, relative.
const SLACK: f32 = 1e-6;

/// A ray; hits count for 0 < t <= `t_max`, in lengths of the direction.
#[derive(Clone, Copy)]
pub(crate) struct Ray {
    pub origin: Vec3,
    pub direction: Vec3,
    pub t_max: f32,
}

/// Triangles in the order of a bottom level's leaves, and its nodes.
pub(crate) struct Shapes {
    nodes: Vec<Node>,
    triangles: Vec<Shape>,
}

#[derive(Clone, Copy)]
struct Shape {
    corner: Vec3,
    edges: [Vec3; 2],
    primitive: u32,
}

impl Shapes {
    pub fn new(blas: &Blas) -> Self {
        let shape = |triangle: &afterglow_bvh::layout::Triangle| {
            let [a, b, c] = triangle.vertices.map(Vec3::from);
            Shape { corner: a, edges: [b - a, c - a], primitive: triangle.primitive }
        };
        Self { nodes: blas.nodes().to_vec(), triangles: blas.triangles().iter().map(shape).collect() }
    }

    /// Some hit where `any` will do, else the closest: its t and primitive.
    pub fn trace(&self, ray: &Ray, any: bool) -> Option<(f32, u32)> {
        let away = |d: f32| if d.abs() < LEAST_COMPONENT { LEAST_COMPONENT.copysign(d) } else { d };
        let inverse = Vec3::from(ray.direction.to_array().map(away)).recip();
        let mut hit: Option<(f32, u32)> = None;
        let mut t_max = ray.t_max;
        let mut stack = [(0.0f32, 0u32); MOST_WAITING_BLAS as usize + WIDTH];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (entry, number) = stack[height];
            let Some(node) = self.nodes.get(number as usize).filter(|_| entry <= t_max) else {
                continue;
            };
            let entries = enter(node, ray.origin, inverse, t_max);
            let floor = height;
            for (slot, &entry) in entries.iter().enumerate() {
                if entry == f32::INFINITY {
                    continue;
                }
                let leaf = match Child::of(node.children[slot]) {
                    Child::Nothing => continue,
                    Child::Inner(place) => {
                        if height < stack.len() {
                            stack[height] = (entry, place / NODE_UNITS);
                            height += 1;
                        }
                        continue;
                    }
                    Child::Leaf { place, count } => self.leaf(place, count),
                };
                for shape in leaf {
                    if let Some(t) = shape.meet(ray, t_max) {
                        (hit, t_max) = (Some((t, shape.primitive)), t);
                        if any {
                            return hit;
                        }
                    }
                }
            }
            // Nearest last, to be taken first.
            stack[floor..height].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
        hit
    }

    /// The triangles of a leaf.
    fn leaf(&self, place: u32, count: u32) -> &[Shape] {
        let nodes = self.nodes.len() as u32 * NODE_UNITS;
        let first = place.saturating_sub(nodes) / TRIANGLE_UNITS;
        self.triangles.get(first as usize..(first + count) as usize).unwrap_or(&[])
    }
}

/// Where a ray enters each child's box, infinite where it does not.
fn enter(node: &Node, origin: Vec3, inverse: Vec3, t_max: f32) -> [f32; WIDTH] {
    let (mut near, mut far) = ([0.0f32; WIDTH], [t_max; WIDTH]);
    for axis in 0..3 {
        let [low, high] = &node.planes[axis];
        let (origin, inverse) = (origin[axis], inverse[axis]);
        for slot in 0..WIDTH {
            let a = (low[slot] - origin) * inverse;
            let b = (high[slot] - origin) * inverse;
            near[slot] = near[slot].max(a.min(b));
            far[slot] = far[slot].min(a.max(b));
        }
    }
    std::array::from_fn(
        |slot| if near[slot] <= far[slot] * (1.0 + SLACK) { near[slot] } else { f32::INFINITY },
    )
}

impl Shape {
    fn meet(&self, ray: &Ray, t_max: f32) -> Option<f32> {
        let across = ray.direction.cross(self.edges[1]);
        let inverse = 1.0 / self.edges[0].dot(across);
        let from = ray.origin - self.corner;
        let u = from.dot(across) * inverse;
        let along = from.cross(self.edges[0]);
        let v = ray.direction.dot(along) * inverse;
        let t = self.edges[1].dot(along) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t <= t_max).then_some(t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{hash, unit};
    use afterglow_bvh::intersect::{RayShear, intersect_triangle};
    use afterglow_bvh::{Quality, build_blas};

    /// In [-1, 1)^3.
    fn random(number: u64) -> Vec3 {
        let at = |axis: u64| unit(hash(number, axis)) * 2.0 - 1.0;
        Vec3::new(at(0), at(1), at(2))
    }

    #[test]
    fn hits_are_those_of_trying_every_triangle() {
        let corners: Vec<Vec3> = (0..900u64).map(|i| random(i / 3) * 5.0 + random(i + 5000)).collect();
        let positions: Vec<[f32; 3]> = corners.iter().map(Vec3::to_array).collect();
        let indices: Vec<[u32; 3]> = (0..300).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let shapes = Shapes::new(&build_blas(&positions, &indices, Quality::Good).unwrap());
        let (mut hits, mut unlike) = (0, 0);
        for number in 0..2000u64 {
            let (origin, target) = (random(number + 10_000) * 8.0, random(number + 20_000) * 5.0);
            let ray = Ray { origin, direction: target - origin, t_max: 2.0 };
            let shear = RayShear::new(ray.direction);
            let ts = indices.iter().filter_map(|triangle| {
                let vertices = triangle.map(|i| positions[i as usize]);
                intersect_triangle(origin, &shear, &vertices).map(|hit| hit.t)
            });
            let nearest = ts.filter(|&t| t > 0.0 && t <= 2.0).fold(f32::INFINITY, f32::min);
            let got = shapes.trace(&ray, false).map_or(f32::INFINITY, |(t, _)| t);
            let any = shapes.trace(&ray, true).is_some();
            hits += u32::from(any);
            let same = got == nearest || (got - nearest).abs() < 1e-4;
            unlike += u32::from(!same || any != (nearest < f32::INFINITY));
        }
        // An edge may be met by one test and not by the other.
        assert!(hits > 200 && unlike <= 1, "{hits} {unlike}");
    }
}
