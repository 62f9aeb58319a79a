//! Points of light sources as a place sees them, what stands between left aside.

use crate::caps::{cap_direction, cap_solid_angle, sphere_direction};
use crate::directions::triangle_barycentrics;
use glam::{Vec2, Vec3};
use std::f32::consts::PI;

/// A point of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit vector to it.
    pub direction: Vec3,
    /// How far it is; infinite for suns.
    pub distance: f32,
    /// Density of the direction, per steradian.
    pub pdf: f32,
}

/// A sphere that shines over its whole surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereLight {
    /// Where it is.
    pub centre: Vec3,
    /// Positive.
    pub radius: f32,
}

impl SphereLight {
    /// A point that the place sees, uniform in solid angle: over the sphere's cone, or from within over all directions. None
    /// where something is not a number, or the radius not positive.
    pub fn sample(&self, place: Vec3, random: Vec2) -> Option<LightSample> {
        let to_centre = self.centre - place;
        let distance2 = to_centre.length_squared();
        let radius2 = self.radius * self.radius;
        let is_outside = distance2 > radius2;
        let direction = if is_outside {
            cap_direction(to_centre / distance2.sqrt(), radius2 / distance2, random)
        } else {
            sphere_direction(random)
        };
        // By the vector from the centre to the ray, which does not cancel where a small sphere is far (Haines and others,
        // Precision Improvements for Ray/Sphere Intersection, 2019). At the rim, rounding may miss the sphere.
        let along = to_centre.dot(direction);
        let aside2 = (to_centre - along * direction).length_squared();
        let half_chord = (radius2 - aside2).max(0.0).sqrt();
        let distance = if is_outside { along - half_chord } else { along + half_chord };
        let pdf = self.pdf(place);
        let is_sane = self.radius > 0.0 && distance.is_finite() && pdf.is_finite();
        is_sane.then_some(LightSample { direction, distance: distance.max(0.0), pdf })
    }

    /// Density of each direction that meets the sphere, per steradian.
    pub fn pdf(&self, place: Vec3) -> f32 {
        let distance2 = (self.centre - place).length_squared();
        let radius2 = self.radius * self.radius;
        if distance2 > radius2 { 1.0 / cap_solid_angle(radius2 / distance2) } else { 1.0 / (4.0 * PI) }
    }
}

/// A disc infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector to it.
    pub direction: Vec3,
    /// In radians, at most a right angle.
    pub angular_radius: f32,
}

impl Sun {
    /// Squared sine of the angular radius.
    pub fn sin2(&self) -> f32 {
        self.angular_radius.sin().powi(2)
    }

    /// In steradians: 4 pi sin^2(a / 2).
    pub fn solid_angle(&self) -> f32 {
        4.0 * PI * (0.5 * self.angular_radius).sin().powi(2)
    }

    /// Irradiance of a surface that faces a sun of radiance 1: pi sin^2(a).
    pub fn irradiance(&self) -> f32 {
        PI * self.sin2()
    }

    /// A point of the disc, uniform in solid angle. None for a disc without area.
    pub fn sample(&self, random: Vec2) -> Option<LightSample> {
        let direction = cap_direction(self.direction, self.sin2(), random);
        let pdf = 1.0 / cap_solid_angle(self.sin2());
        pdf.is_finite().then_some(LightSample { direction, distance: f32::INFINITY, pdf })
    }
}

/// A triangle that shines from the side where its corners run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleLight {
    /// Its corners.
    pub corners: [Vec3; 3],
}

/// A parallelogram that shines from the side to which `edges[0] x edges[1]` points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParallelogramLight {
    /// One of its corners.
    pub corner: Vec3,
    /// From there to its neighbours.
    pub edges: [Vec3; 2],
}

impl TriangleLight {
    /// A point, uniform by area. None where the place sees the back or an edge, or where the triangle has no area.
    pub fn sample(&self, place: Vec3, random: Vec2) -> Option<LightSample> {
        let [a, b, c] = self.corners;
        let weights = triangle_barycentrics(random);
        let edges = [b - a, c - a];
        let point = a + edges[0] * weights.x + edges[1] * weights.y;
        seen_from(place, point, 0.5 * edges[0].cross(edges[1]))
    }
}

impl ParallelogramLight {
    /// A point, uniform by area. None where the place sees the back or an edge, or where there is no area.
    pub fn sample(&self, place: Vec3, random: Vec2) -> Option<LightSample> {
        let point = self.corner + self.edges[0] * random.x + self.edges[1] * random.y;
        seen_from(place, point, self.edges[0].cross(self.edges[1]))
    }
}

/// A point that is uniform over an area, with the density of its direction: distance^2 / (area cos). `facing` is
/// the surface's normal, as long as the area.
fn seen_from(place: Vec3, point: Vec3, facing: Vec3) -> Option<LightSample> {
    let to_point = point - place;
    let distance2 = to_point.length_squared();
    let distance = distance2.sqrt();
    let direction = to_point / distance;
    let projected_area = -facing.dot(direction);
    let pdf = distance2 / projected_area;
    (projected_area > 0.0 && pdf > 0.0 && pdf.is_finite()).then_some(LightSample { direction, distance, pdf })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Mean, draws};

    /// Irradiance at the origin, where the normal is +z, of a light of radiance 1.
    fn irradiance(seed: u32, sample: impl Fn(Vec2) -> Option<LightSample>) -> Mean {
        let mut mean = Mean::new();
        for random in draws(seed, 200_000) {
            let found = sample(Vec2::new(random.x, random.y));
            mean.add(found.map_or(0.0, |light| f64::from(light.direction.z.max(0.0) / light.pdf)));
        }
        mean
    }

    /// A sphere of this radius at this distance from the origin, at an angle to z whose cosine is given.
    fn sphere(radius: f32, distance: f32, cos: f32) -> SphereLight {
        SphereLight { centre: Vec3::new(0.0, (1.0 - cos * cos).sqrt(), cos) * distance, radius }
    }

    #[test]
    fn spheres_give_their_irradiance() {
        let cases = [(0.1, 2.0, 1.0), (0.5, 2.0, 0.5), (1e-4, 1.0, 0.8), (1e-5, 1.0, 1.0), (1.0, 1.001, 1.0)];
        for (radius, distance, cos) in cases {
            let expected = std::f64::consts::PI * (f64::from(radius) / f64::from(distance)).powi(2);
            let mean = irradiance(1, |random| sphere(radius, distance, cos).sample(Vec3::ZERO, random));
            mean.assert_near(expected * f64::from(cos), 4.0);
        }
        let known = irradiance(2, |random| sphere(0.5, 2.0, 0.5).sample(Vec3::ZERO, random)).mean();
        assert!((known - 0.098_174_77).abs() < 1e-3, "{known}");
    }

    #[test]
    fn points_of_spheres_lie_on_them() {
        for (radius, distance) in [(0.1, 2.0), (1.0, 1.001), (1e-4, 1.0), (1.0, 0.5), (1.0, 0.0), (1.0, 1.0)]
        {
            let light = sphere(radius, distance, 0.3);
            for random in draws(3, 10_000) {
                let found = light.sample(Vec3::ZERO, Vec2::new(random.x, random.y)).unwrap();
                let off = (found.direction * found.distance - light.centre).length() / radius;
                // The direction's last digit, as long as the ray, beside the radius.
                let most = 1e-5 + (2e-7 * distance / radius).sqrt();
                assert!((off - 1.0).abs() < most, "{radius} {distance}: {off}");
                assert!(found.distance >= 0.0 && found.pdf > 0.0, "{found:?}");
            }
        }
    }

    #[test]
    fn light_from_within_a_sphere_comes_from_everywhere() {
        let mean = irradiance(4, |random| sphere(1.0, 0.5, 0.3).sample(Vec3::ZERO, random));
        mean.assert_near(std::f64::consts::PI, 4.0);
    }

    #[test]
    fn damaged_lights_give_nothing() {
        let at = Vec2::new(0.3, 0.6);
        let damaged = [
            sphere(0.0, 1.0, 1.0),
            sphere(-1.0, 2.0, 1.0),
            sphere(1e-30, 1e20, 1.0),
            sphere(f32::NAN, 1.0, 1.0),
            sphere(1.0, f32::INFINITY, 1.0),
        ];
        assert_eq!(damaged.map(|light| light.sample(Vec3::ZERO, at)), [None; 5]);
        assert_eq!(Sun { direction: Vec3::Z, angular_radius: 0.0 }.sample(at), None);
        let sliver = TriangleLight { corners: [Vec3::Z, Vec3::Z, Vec3::ONE] };
        assert_eq!(sliver.sample(Vec3::ZERO, at), None);
        let below = TriangleLight { corners: [Vec3::ZERO, Vec3::X, Vec3::Y] };
        assert_eq!(below.sample(Vec3::ZERO, Vec2::ZERO), None);
        assert_eq!(below.sample(Vec3::NEG_Z, at), None, "the back");
    }

    #[test]
    fn the_sun_is_as_large_and_as_bright_as_it_should_be() {
        let sun = Sun { direction: Vec3::Z, angular_radius: 0.004_675 };
        assert!((f64::from(sun.solid_angle()) / 6.866_134_588_6e-5 - 1.0).abs() < 1e-6);
        assert!((f64::from(sun.irradiance()) / 6.866_097_072_8e-5 - 1.0).abs() < 1e-6);
        let found = sun.sample(Vec2::new(0.2, 0.9)).unwrap();
        assert!((found.pdf * sun.solid_angle() - 1.0).abs() < 1e-6);
        irradiance(5, |random| sun.sample(random)).assert_near(6.866_097_072_8e-5, 4.0);
        // A large one, low: still wholly above the horizon.
        let low = Sun { direction: Vec3::new(0.8, 0.0, 0.6), angular_radius: 0.5 };
        let expected = std::f64::consts::PI * 0.5f64.sin().powi(2) * f64::from(0.6f32);
        irradiance(6, |random| low.sample(random)).assert_near(expected, 4.0);
    }

    #[test]
    fn a_square_over_an_element_gives_lamberts_formula() {
        // Half its side as long as its height.
        let [a, b] = [Vec3::new(-1.0, -1.0, 1.0), Vec3::new(1.0, 1.0, 1.0)];
        let (right, far) = (Vec3::new(1.0, -1.0, 1.0), Vec3::new(-1.0, 1.0, 1.0));
        let expected = 0.554_126_423_979_571_9 * std::f64::consts::PI;
        let square = ParallelogramLight { corner: a, edges: [far - a, right - a] };
        irradiance(7, |random| square.sample(Vec3::ZERO, random)).assert_near(expected, 4.0);
        // And as two triangles that are lit one by one.
        let halves = [[a, far, b], [a, b, right]].map(|corners| TriangleLight { corners });
        let parts = halves.map(|half| irradiance(8, move |random| half.sample(Vec3::ZERO, random)));
        let error = parts[0].standard_error() + parts[1].standard_error();
        let sum = parts[0].mean() + parts[1].mean();
        assert!((sum - expected).abs() < 4.0 * error, "{sum} {expected}");
    }

    #[test]
    fn a_light_straight_over_a_lambertian_surface_is_exact() {
        // Albedo 0.5, irradiance 6 of a surface that faces the light, cosine 0.8.
        let bsdf = crate::bsdf::Bsdf { diffuse: Vec3::splat(0.5), specular: Vec3::ZERO, alpha: 1.0 };
        let value = crate::bsdf::diffuse_value(&bsdf, Vec3::new(0.6, 0.0, 0.8)) * 6.0;
        assert!((f64::from(value.x) - 0.763_943_726_841_097_7).abs() < 1e-6);
    }
}
