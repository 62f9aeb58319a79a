//! Ray against triangle, watertight: two triangles that share an edge leave no gap between them
//! (after Woop, Benthin and Wald, Watertight Ray/Triangle Intersection, JCGT 2013); and ray against
//! sphere, as exact where the sphere is small and far away. The twin of `shaders/include/ray.glsl`: same
//! names, same operations in the same order.

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

/// Where a ray meets a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereHit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// From outside.
    pub front: bool,
}

/// Where the ray meets the sphere first beyond `t_min`. `inverse` holds the direction's reciprocals.
///
/// The square of the half chord is taken from the ray's point nearest to the centre, and the nearer of
/// two distances by the product of both, so that no digits cancel (Haines, Günther and Akenine-Möller,
/// Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019, chapter 7).
pub fn intersect_sphere(
    origin: Vec3,
    inverse: Vec3,
    shear: &RayShear,
    t_min: f32,
    centre: Vec3,
    radius: f32,
) -> Option<SphereHit> {
    // A direction whose longest component is 1: no length of the ray's own overflows.
    let scale = (shear.depth.x + shear.depth.y + shear.depth.z).abs();
    let direction = Vec3::splat(scale) / inverse;
    let from = origin - centre;
    let squared = dot_fused(direction, direction);
    let towards = -dot_fused(from, direction);
    let nearest = towards / squared;
    let aside = Vec3::new(
        nearest.mul_add(direction.x, from.x),
        nearest.mul_add(direction.y, from.y),
        nearest.mul_add(direction.z, from.z),
    );
    let half_chord_squared = radius.mul_add(radius, -dot_fused(aside, aside));
    if half_chord_squared < 0.0 || half_chord_squared.is_nan() {
        return None;
    }
    let root = (squared * half_chord_squared).sqrt();
    let sum = if towards < 0.0 { towards - root } else { towards + root };
    let product = radius.mul_add(-radius, dot_fused(from, from));
    let (one, other) = (sum / squared, if sum == 0.0 { 0.0 } else { product / sum });
    let near = one.min(other) * scale;
    let far = one.max(other) * scale;
    let front = near > t_min;
    Some(SphereHit { t: if front { near } else { far }, front })
}

/// Where a ray from surface point `position` starts, moved along `normal` (on the side of the new ray) past
/// the rounding of the point itself: by a count of representable numbers, or near 0 by a length (Wächter and
/// Binder, A Fast and Robust Method for Avoiding Self-Intersection, Ray Tracing Gems, 2019, chapter 6). Their lengths are of a
/// scene of size 1; here the greatest coordinate stands for that, so that a scene is the same at any scale.
pub fn offset_ray(position: Vec3, normal: Vec3) -> Vec3 {
    const STEPS: f32 = 256.0;
    let greatest = position.abs().max_element();
    let near_zero = greatest / 32.0;
    let length_near_zero = greatest / 65536.0;
    let along = |position: f32, normal: f32| {
        if position.abs() <= near_zero {
            return position + length_near_zero * normal;
        }
        let count = (STEPS * normal) as i32;
        let away = if position < 0.0 { -count } else { count };
        f32::from_bits(position.to_bits().wrapping_add_signed(away))
    };
    Vec3::new(along(position.x, normal.x), along(position.y, normal.y), along(position.z, normal.z))
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

    fn meet_sphere(origin: Vec3, direction: Vec3, centre: Vec3, radius: f32) -> Option<SphereHit> {
        let inverse = crate::traverse::inverse_of(direction);
        intersect_sphere(origin, inverse, &RayShear::new(direction), 0.0, centre, radius)
    }

    #[test]
    fn spheres_are_met_from_outside_and_from_inside() {
        let mut random = Random::new(4);
        for _ in 0..5000 {
            let (centre, radius) = (random.vec3() * 10.0, 0.1 + random.unit());
            let outwards = random.vec3().normalize();
            let target = centre + outwards * radius;
            let direction = random.vec3().normalize();
            let cosine = direction.dot(outwards);
            if cosine.abs() < 0.1 {
                continue;
            }
            // Forwards to the point from before it; within the sphere where that is where it comes from.
            let chord = 2.0 * radius * cosine.abs();
            let (back, front) = if cosine < 0.0 { (5.0, true) } else { (chord * 0.7, false) };
            let scale = 0.25 + random.unit();
            let hit = meet_sphere(target - direction * back, direction * scale, centre, radius).unwrap();
            assert!((hit.t * scale - back).abs() < 2e-5, "{hit:?} {back}");
            assert_eq!(hit.front, front);
        }
    }

    #[test]
    fn a_small_sphere_far_away_is_met_where_it_is() {
        // Against f64, where the schoolbook's discriminant in f32 has lost all digits.
        let mut random = Random::new(5);
        let (centre, radius) = (Vec3::new(0.0, 0.0, -4096.0), 0.125f32);
        for _ in 0..5000 {
            let target = centre + random.vec3() * radius;
            let direction = target.normalize();
            let (d, c) = (direction.as_dvec3(), centre.as_dvec3());
            let nearest = d.dot(c) / d.dot(d);
            let half_squared = f64::from(radius).powi(2) - (d * nearest - c).length_squared();
            let hit = meet_sphere(Vec3::ZERO, direction, centre, radius);
            if half_squared.abs() > 1e-3 {
                assert_eq!(hit.is_some(), half_squared > 0.0);
            }
            if half_squared > 1e-3 {
                let expected = nearest - (half_squared / d.dot(d)).sqrt();
                assert!((f64::from(hit.unwrap().t) - expected).abs() < 0.01, "{hit:?} {expected}");
            }
        }
    }

    #[test]
    fn spheres_stand_extreme_lengths_and_what_is_no_number() {
        for length in [1e-15f32, 1e15] {
            let hit =
                meet_sphere(Vec3::new(0.1, 0.2, 5.0), Vec3::new(1e-9, 1e-9, -1.0) * length, Vec3::ZERO, 1.0);
            assert!((hit.unwrap().t * length - (5.0 - 0.95f32.sqrt())).abs() < 1e-5, "{hit:?}");
        }
        assert!(meet_sphere(Vec3::NAN, Vec3::ONE, Vec3::ZERO, 1.0).is_none());
        assert!(meet_sphere(Vec3::ZERO, Vec3::splat(f32::NAN), Vec3::ZERO, 1.0).is_none());
        // At the centre, every way is out.
        let hit = meet_sphere(Vec3::ZERO, Vec3::new(0.0, 2.0, 0.0), Vec3::ZERO, 3.0);
        assert_eq!(hit, Some(SphereHit { t: 1.5, front: false }));
    }

    #[test]
    fn nothing_is_met_beside_or_edge_on() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        assert!(meet(Vec3::new(0.6, 0.6, 1.0), Vec3::NEG_Z, corners).is_none());
        assert!(meet(Vec3::new(-1.0, 0.2, 0.0), Vec3::X, corners).is_none());
        assert!(meet(Vec3::new(0.2, 0.2, 1.0), Vec3::splat(f32::NAN), corners).is_none_or(|h| h.t.is_nan()));
    }
}
