//! Ray against triangle, watertight: two triangles that share an edge leave no gap between them
//! (after Woop, Benthin and Wald, Watertight Ray/Triangle Intersection, JCGT 2013). The twin of
//! `shaders/include/ray.glsl`: same names, same operations in the same order.

use glam::Vec3;

/// The shear that turns a ray into the z axis: a point p relative to the origin has the ray's
/// distance at `depth . p`, and its offset from the ray at `(across . p, along . p)`.
#[derive(Clone, Copy, Debug)]
pub struct RayShear {
    across: Vec3,
    along: Vec3,
    depth: Vec3,
}

impl RayShear {
    /// The shear of rays along `direction`, of any length but 0.
    pub fn new(direction: Vec3) -> Self {
        let (d, size) = (direction, direction.abs());
        if size.x >= size.y && size.x >= size.z {
            Self {
                across: Vec3::new(-d.y / d.x, 1.0, 0.0),
                along: Vec3::new(-d.z / d.x, 0.0, 1.0),
                depth: Vec3::new(1.0 / d.x, 0.0, 0.0),
            }
        } else if size.y >= size.z {
            Self {
                across: Vec3::new(0.0, -d.z / d.y, 1.0),
                along: Vec3::new(1.0, -d.x / d.y, 0.0),
                depth: Vec3::new(0.0, 1.0 / d.y, 0.0),
            }
        } else {
            Self {
                across: Vec3::new(1.0, 0.0, -d.x / d.z),
                along: Vec3::new(0.0, 1.0, -d.y / d.z),
                depth: Vec3::new(0.0, 0.0, 1.0 / d.z),
            }
        }
    }

    /// Whether the ray runs towards negative coordinates of its longest axis.
    fn backwards(&self) -> bool {
        self.depth.x + self.depth.y + self.depth.z < 0.0
    }
}

/// Where a ray meets a triangle's plane, inside the triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Weights of the second and third corner.
    pub barycentrics: [f32; 2],
    /// The corners run counter-clockwise as seen from the ray's origin (right-handed space).
    pub front: bool,
}

/// The dot product that both twins evaluate alike.
fn dot_fused(a: Vec3, b: Vec3) -> f32 {
    a.x.mul_add(b.x, a.y.mul_add(b.y, a.z * b.z))
}

/// a b - c d within 1.5 units in the last place, its sign exact (Kahan's algorithm; Jeannerod, Louvet
/// and Muller, Further Analysis of Kahan's Algorithm, 2013).
fn difference_of_products(a: f32, b: f32, c: f32, d: f32) -> f32 {
    let product = c * d;
    let error = (-c).mul_add(d, product);
    a.mul_add(b, -product) + error
}

/// Where the ray meets the triangle, at any t, negative too.
pub fn intersect_triangle(origin: Vec3, shear: &RayShear, vertices: &[[f32; 3]; 3]) -> Option<TriangleHit> {
    let [a, b, c] = vertices.map(|vertex| Vec3::from(vertex) - origin);
    let (ax, ay) = (dot_fused(a, shear.across), dot_fused(a, shear.along));
    let (bx, by) = (dot_fused(b, shear.across), dot_fused(b, shear.along));
    let (cx, cy) = (dot_fused(c, shear.across), dot_fused(c, shear.along));
    // Signs are exact, so the triangles on both sides of an edge agree on which has the ray.
    let weight_a = difference_of_products(bx, cy, by, cx);
    let weight_b = difference_of_products(cx, ay, cy, ax);
    let weight_c = difference_of_products(ax, by, ay, bx);
    let least = weight_a.min(weight_b).min(weight_c);
    let greatest = weight_a.max(weight_b).max(weight_c);
    let determinant = weight_a + weight_b + weight_c;
    if (least < 0.0 && greatest > 0.0) || determinant == 0.0 {
        return None;
    }
    let depth_a = dot_fused(a, shear.depth);
    let depth_b = dot_fused(b, shear.depth);
    let depth_c = dot_fused(c, shear.depth);
    let scale = 1.0 / determinant;
    let t = (weight_a * depth_a + weight_b * depth_b + weight_c * depth_c) * scale;
    Some(TriangleHit {
        t,
        barycentrics: [weight_b * scale, weight_c * scale],
        front: (determinant > 0.0) == shear.backwards(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;

    fn meet(origin: Vec3, direction: Vec3, corners: [Vec3; 3]) -> Option<TriangleHit> {
        let shear = RayShear::new(direction);
        intersect_triangle(origin, &shear, &corners.map(|c| c.to_array()))
    }

    #[test]
    fn distance_and_barycentrics_are_right_along_every_axis() {
        let mut random = Random::new(1);
        for _ in 0..2000 {
            let corners = [(); 3].map(|()| random.vec3() * 10.0);
            let (u, v) = (random.unit(), random.unit());
            let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            let target = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            let origin = random.vec3() * 50.0;
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let direction = (target - origin) * 0.25;
            let grazing = normal.normalize().dot(direction.normalize()).abs() < 0.05;
            let edge = u.min(v).min(1.0 - u - v) < 1e-3;
            if grazing || edge {
                continue;
            }
            let hit = meet(origin, direction, corners).unwrap();
            assert!((hit.t - 4.0).abs() < 1e-3, "{hit:?}");
            let error = (hit.barycentrics[0] - u).abs() + (hit.barycentrics[1] - v).abs();
            assert!(error < 2e-2 / normal.length().min(1.0), "{hit:?} {u} {v}");
            assert_eq!(hit.front, normal.dot(direction) < 0.0);
        }
    }

    #[test]
    fn no_ray_slips_between_the_triangles_of_a_fan() {
        // Rays aimed at points on shared edges, and at the shared corner itself.
        let mut random = Random::new(2);
        let rim: Vec<Vec3> = (0..7)
            .map(|i| {
                let angle = i as f32 / 7.0 * std::f32::consts::TAU;
                Vec3::new(angle.cos(), angle.sin(), 0.3 * random.unit())
            })
            .collect();
        let centre = Vec3::new(0.013, -0.007, 0.11);
        for _ in 0..20_000 {
            let along = random.unit() * 0.9;
            let edge = (random.next() % 7) as usize;
            let target = centre + (rim[edge] - centre) * along;
            let origin = target + random.vec3() + Vec3::new(0.0, 0.0, 2.5);
            let direction = target - origin;
            let met = (0..7).any(|i| meet(origin, direction, [centre, rim[i], rim[(i + 1) % 7]]).is_some());
            assert!(met, "{origin} {direction}");
        }
    }

    #[test]
    fn nothing_is_met_beside_or_edge_on() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        assert!(meet(Vec3::new(0.6, 0.6, 1.0), Vec3::NEG_Z, corners).is_none());
        assert!(meet(Vec3::new(-1.0, 0.2, 0.0), Vec3::X, corners).is_none());
        assert!(meet(Vec3::new(0.2, 0.2, 1.0), Vec3::splat(f32::NAN), corners).is_none_or(|h| h.t.is_nan()));
    }
}
