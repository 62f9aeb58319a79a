//! Form factors: what each sample receives from a source of power 1.

use crate::lambert::irradiance;
use crate::random::{hash, spread, unit};
use crate::samples::Samples;
use crate::types::{Emitter, Falloff, Source};
use crate::world::World;
use glam::Vec3;

/// Squared distances up to this many areas of a patch are near.
const NEAR: f32 = 16.0;
/// Most triangles of an emitter that are looked at.
const MOST_TRIANGLES: usize = 512;

/// An emitter's triangles that have an area.
pub(crate) struct Panel {
    triangles: Vec<Facet>,
    two_sided: bool,
}

struct Facet {
    corners: [Vec3; 3],
    centre: Vec3,
    /// Unit.
    normal: Vec3,
    area: f32,
}

impl Panel {
    /// Of very many triangles the largest; their areas stand for all.
    pub fn new(emitter: &Emitter) -> Self {
        let mut triangles: Vec<Facet> = emitter.triangles.iter().filter_map(Facet::new).collect();
        triangles.sort_by(|a, b| b.area.total_cmp(&a.area));
        triangles.truncate(MOST_TRIANGLES);
        Self { triangles, two_sided: emitter.two_sided }
    }

    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }
}

impl Facet {
    fn new(corners: &[Vec3; 3]) -> Option<Self> {
        let [a, b, c] = *corners;
        let cross = (b - a).cross(c - a);
        let area = 0.5 * cross.length();
        // NaN and infinity fail too.
        let sane = area > 1e-18 && area < 1e18;
        sane.then(|| Self {
            corners: *corners,
            centre: (a + b + c) / 3.0,
            normal: cross / (2.0 * area),
            area,
        })
    }

    /// Irradiance from radiance 1, nothing between.
    fn unoccluded(&self, position: Vec3, normal: Vec3, two_sided: bool) -> f32 {
        if !two_sided && self.normal.dot(position - self.corners[0]) <= 0.0 {
            return 0.0;
        }
        let to = self.centre - position;
        let squared = to.length_squared();
        // Far away the triangle is as good as a point; the error is below 1 %.
        if squared > 60.0 * self.area && normal.dot(to) > 2.0 * self.area.sqrt() {
            return normal.dot(to) * self.normal.dot(to).abs() * self.area / (squared * squared);
        }
        irradiance(normal, self.corners.map(|corner| corner - position))
    }

    fn point(&self, square: glam::Vec2) -> Vec3 {
        let root = square.x.sqrt();
        let [a, b, c] = self.corners;
        a * (1.0 - root) + b * (root * (1.0 - square.y)) + c * (root * square.y)
    }
}

/// What form factors depend on besides the source.
pub(crate) struct Optics<'a> {
    pub world: &'a World,
    pub samples: &'a Samples,
    pub panels: &'a [Panel],
    /// Irradiance from a sky of radiance 1.
    pub sky: Vec<f32>,
    /// Where a sun may shine.
    pub near_sky: Vec<bool>,
    /// Points of a sample that suns are looked for from, 1 or 4: where a sun's light ends, a patch has a part of it.
    pub sun_points: usize,
    /// Rays to an emitter or to a sun with a width, from one sample.
    pub area_rays: u32,
    /// A point that fewer samples tell of is none: any point near them would fit.
    pub least_witnesses: f64,
    pub seed: u64,
}

impl Optics<'_> {
    /// The form factors of `source`, one a sample.
    pub fn column(&self, source: &Source) -> Vec<f32> {
        match *source {
            Source::Point { position, radius, falloff } => {
                self.each(|i| self.point_at(i, position, radius, falloff))
            }
            Source::Sun { direction, angular_radius } => {
                self.each(|i| self.sun_at(i, direction, angular_radius))
            }
            Source::Area { emitter } => self.each(|i| self.panel_at(i, &self.panels[emitter])),
            Source::Sky => self.sky.clone(),
        }
    }

    fn each(&self, factor: impl Fn(usize) -> f32) -> Vec<f32> {
        (0..self.samples.len()).map(factor).collect()
    }

    /// Where rays from sample `i` start.
    pub fn origin(&self, i: usize) -> Vec3 {
        self.samples.position[i] + self.samples.normal[i] * self.world.offset()
    }

    /// The factor of sample `i`.
    fn point_at(&self, i: usize, position: Vec3, radius: f32, falloff: Falloff) -> f32 {
        let (normal, to) = (self.samples.normal[i], position - self.samples.position[i]);
        let mut factor = point_factor(normal, to, radius, falloff);
        if factor <= 0.0 || !self.world.visible(self.origin(i), position) {
            return 0.0;
        }
        // Near a light the middle of a patch is brighter than the rest.
        if to.length_squared() < NEAR * self.samples.area[i] {
            let aside = self.quarters(i).map(|aside| point_factor(normal, to - aside, radius, falloff));
            factor = 0.25 * aside.iter().sum::<f32>();
        }
        factor
    }

    /// The middles of a patch's quarters, from its own. How the square lies is not known, but whatever way it is turned,
    /// these points are inside.
    fn quarters(&self, i: usize) -> [Vec3; 4] {
        let (tangent, bitangent) = self.samples.normal[i].any_orthonormal_pair();
        let side = 0.25 * self.samples.area[i].sqrt();
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(x, y)| (tangent * x + bitangent * y) * side)
    }

    fn sun_at(&self, i: usize, direction: Vec3, angular_radius: f32) -> f32 {
        if !self.near_sky[i] || self.samples.normal[i].dot(direction) < -angular_radius.sin() {
            return 0.0;
        }
        let origin = self.origin(i);
        let lit = |aside: Vec3, towards: Vec3| {
            let cosine = self.samples.normal[i].dot(towards);
            if cosine > 0.0 && self.world.sees_sky(origin + aside, towards) { cosine } else { 0.0 }
        };
        if angular_radius == 0.0 {
            let asides = if self.sun_points == 1 { [Vec3::ZERO; 4] } else { self.quarters(i) };
            let asides = &asides[..self.sun_points];
            return asides.iter().map(|&aside| lit(aside, direction)).sum::<f32>() / self.sun_points as f32;
        }
        let (tangent, bitangent) = direction.any_orthonormal_pair();
        let turn = hash(self.seed, u64::from(self.samples.number[i]));
        let one = |ray: u32| {
            let square = spread(ray, turn);
            let (across, angle) = (angular_radius * square.x.sqrt(), square.y * std::f32::consts::TAU);
            let aside = tangent * angle.cos() + bitangent * angle.sin();
            lit(Vec3::ZERO, (direction + aside * across.tan()).normalize())
        };
        (0..self.area_rays).map(one).sum::<f32>() / self.area_rays as f32
    }

    /// Exact without occluders; the share that is seen is estimated by rays to where most light comes from.
    fn panel_at(&self, i: usize, panel: &Panel) -> f32 {
        let (position, normal) = (self.samples.position[i], self.samples.normal[i]);
        let mut sums = Vec::with_capacity(panel.triangles.len());
        let mut total = 0.0;
        for facet in &panel.triangles {
            total += facet.unoccluded(position, normal, panel.two_sided);
            sums.push(total);
        }
        if total <= 0.0 {
            return 0.0;
        }
        let turn = hash(self.seed ^ 0x9a11, u64::from(self.samples.number[i]));
        let (mut tried, mut seen) = (0, 0);
        for ray in 0..self.area_rays {
            let at = (ray as f32 + unit(turn)) / self.area_rays as f32 * total;
            let facet = &panel.triangles[sums.partition_point(|&sum| sum <= at).min(sums.len() - 1)];
            let target = facet.point(spread(ray, turn));
            if normal.dot(target - position) <= 0.0 {
                continue;
            }
            tried += 1;
            seen += u32::from(self.world.visible(self.origin(i), target + facet.lift(position, self.world)));
        }
        total * seen as f32 / tried.max(1) as f32
    }
}

impl Facet {
    /// Just off the panel, towards a point: the panel is an occluder itself.
    fn lift(&self, position: Vec3, world: &World) -> Vec3 {
        self.normal * world.offset().copysign(self.normal.dot(position - self.corners[0]))
    }
}

/// Irradiance from a point light of power 1 at `to` from the surface, nothing between.
pub(crate) fn point_factor(normal: Vec3, to: Vec3, radius: f32, falloff: Falloff) -> f32 {
    let squared = to.length_squared();
    let distance = squared.sqrt();
    if squared <= 0.0 {
        return 0.0;
    }
    let cosine = (normal.dot(to) / distance).max(0.0);
    match falloff {
        Falloff::InverseSquare => cosine / squared.max(radius * radius),
        Falloff::Linear { reach } => cosine * (1.0 - distance / reach).max(0.0),
    }
}

/// What [`point_factor`] changes by as the light moves along each axis, and as a linear light's reach grows.
pub(crate) fn point_gradient(normal: Vec3, to: Vec3, radius: f32, falloff: Falloff) -> [f32; 4] {
    let distance = to.length().max(radius);
    let along = to / distance;
    let cosine = normal.dot(along);
    let cosine_gradient = (normal - along * cosine) / distance;
    let (fade, fade_gradient, by_reach) = match falloff {
        Falloff::InverseSquare => {
            let fade = 1.0 / (distance * distance);
            (fade, along * (-2.0 * fade / distance), 0.0)
        }
        Falloff::Linear { reach } => {
            (1.0 - distance / reach, along * (-1.0 / reach), cosine * distance / (reach * reach))
        }
    };
    let [x, y, z] = (cosine_gradient * fade + fade_gradient * cosine).to_array();
    [x, y, z, by_reach]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_are_those_of_differences() {
        let normal = Vec3::new(0.48, 0.6, 0.64);
        let to = Vec3::new(1.0, 2.0, 3.0);
        for falloff in [Falloff::InverseSquare, Falloff::Linear { reach: 9.0 }] {
            let gradient = point_gradient(normal, to, 0.01, falloff);
            for axis in 0..3 {
                let step = Vec3::AXES[axis] * 1e-2;
                let at = |to| point_factor(normal, to, 0.01, falloff);
                let difference = (at(to + step) - at(to - step)) / 2e-2;
                assert!((difference - gradient[axis]).abs() < 1e-4, "{axis} {difference} {gradient:?}");
            }
        }
        let at = |reach| point_factor(normal, to, 0.01, Falloff::Linear { reach });
        let by_reach = point_gradient(normal, to, 0.01, Falloff::Linear { reach: 9.0 })[3];
        assert!(((at(9.05) - at(8.95)) / 0.1 - by_reach).abs() < 1e-4);
    }
}
