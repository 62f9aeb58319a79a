//! Worlds of rectangles with lights baked into them by brute force: every ray tries every rectangle, so nothing is
//! shared with what is tested.

#![allow(dead_code, reason = "each test and example uses a part")]

pub mod level;

use afterglow_relight::{Baked, Emitter, Patch, Sky};
use glam::Vec3;
use std::f32::consts::{PI, TAU};

/// A rectangle, lit on the side of `u` x `v`.
#[derive(Clone, Copy)]
pub struct Rect {
    pub corner: Vec3,
    pub u: Vec3,
    pub v: Vec3,
    pub albedo: Vec3,
    /// Patches along u and v; none where 0.
    pub cells: [u32; 2],
    pub first_patch: usize,
}

/// What is baked.
#[derive(Clone, Copy)]
pub enum Lamp {
    /// Position, power; inverse square.
    Point(Vec3, Vec3),
    /// Position, power, reach.
    Linear(Vec3, Vec3, f32),
    /// Towards the sun (unit), irradiance.
    Sun(Vec3, Vec3),
    /// Rectangle shining to the side of u x v: corner, u, v, radiance.
    Panel(Vec3, Vec3, Vec3, Vec3),
    /// Radiance.
    Sky(Vec3),
}

/// A world under construction.
#[derive(Default)]
pub struct Built {
    pub rects: Vec<Rect>,
    pub patches: Vec<Patch>,
    pub emitters: Vec<Emitter>,
    /// Triangles of a rectangle: two times this squared.
    pub tessellation: u32,
    /// Points of a patch that are averaged, along either side.
    pub supersampling: u32,
}

pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u32 << 24) as f32
    }

    pub fn normal(&mut self) -> f32 {
        (-2.0 * (1.0 - self.unit()).ln()).sqrt() * (TAU * self.unit()).cos()
    }
}

impl Built {
    pub fn new() -> Self {
        Self { tessellation: 1, supersampling: 1, ..Self::default() }
    }

    /// A rectangle with patches of about `patch` along a side.
    pub fn rect(&mut self, corner: Vec3, u: Vec3, v: Vec3, albedo: Vec3, patch: f32) {
        let along = |side: Vec3| ((side.length() / patch).round() as u32).max(1);
        let cells = [along(u), along(v)];
        let normal = u.cross(v).normalize();
        let area = u.cross(v).length() / (cells[0] * cells[1]) as f32;
        self.rects.push(Rect { corner, u, v, albedo, cells, first_patch: self.patches.len() });
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                let at = |i: u32, n: u32| (i as f32 + 0.5) / n as f32;
                let position = corner + u * at(i, cells[0]) + v * at(j, cells[1]);
                self.patches.push(Patch { position, normal, area, irradiance: Vec3::ZERO, albedo });
            }
        }
    }

    /// The six sides of a box, seen from inside or outside, of which `skip` are left out (-x, +x, -y, +y, -z, +z).
    pub fn cuboid(&mut self, min: Vec3, max: Vec3, inside: bool, albedo: Vec3, patch: f32, skip: &[usize]) {
        let size = max - min;
        for side in 0..6 {
            if skip.contains(&side) {
                continue;
            }
            let axis = side / 2;
            let (mut u, mut v) = (Vec3::AXES[(axis + 1) % 3] * size, Vec3::AXES[(axis + 2) % 3] * size);
            let upper = side % 2 == 1;
            let corner = if upper { min + Vec3::AXES[axis] * size } else { min };
            if upper == inside {
                std::mem::swap(&mut u, &mut v);
            }
            self.rect(corner, u, v, albedo, patch);
        }
    }

    pub fn emitter(&mut self, corner: Vec3, u: Vec3, v: Vec3) {
        let triangles = vec![[corner, corner + u, corner + u + v], [corner, corner + u + v, corner + v]];
        self.emitters.push(Emitter { triangles, two_sided: false, preference: 1.0 });
    }

    pub fn triangles(&self) -> Vec<[Vec3; 3]> {
        let n = self.tessellation;
        let mut triangles = Vec::new();
        for rect in &self.rects {
            let at = |i: u32, j: u32| {
                rect.corner + rect.u * (i as f32 / n as f32) + rect.v * (j as f32 / n as f32)
            };
            for i in 0..n {
                for j in 0..n {
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        triangles
    }

    pub fn baked<'a>(&'a self, triangles: &'a [[Vec3; 3]], sky: Sky<'a>) -> Baked<'a> {
        Baked { triangles, patches: &self.patches, emitters: &self.emitters, sky }
    }

    /// The nearest rectangle along a ray beyond a hair and before `most`: number, distance, place on it.
    fn hit(&self, origin: Vec3, direction: Vec3, most: f32) -> Option<(usize, f32, [f32; 2])> {
        let mut best = None;
        let mut nearest = most;
        for (number, rect) in self.rects.iter().enumerate() {
            let normal = rect.u.cross(rect.v);
            let t = normal.dot(rect.corner - origin) / normal.dot(direction);
            if t.is_nan() || t <= 1e-4 || t >= nearest {
                continue;
            }
            let at = origin + direction * t - rect.corner;
            let place = [at.dot(rect.u) / rect.u.length_squared(), at.dot(rect.v) / rect.v.length_squared()];
            if place.iter().all(|p| (0.0..=1.0).contains(p)) {
                (best, nearest) = (Some((number, t, place)), t);
            }
        }
        best
    }

    fn free(&self, from: Vec3, to: Vec3) -> bool {
        self.hit(from, to - from, 0.9999).is_none()
    }

    fn direct(&self, at: Vec3, normal: Vec3, lamp: &Lamp, random: &mut Random) -> Vec3 {
        let point = |position: Vec3, fade: &dyn Fn(f32) -> f32| {
            let to = position - at;
            let cosine = normal.dot(to.normalize());
            if cosine > 0.0 && self.free(at, position) { cosine * fade(to.length()) } else { 0.0 }
        };
        match *lamp {
            Lamp::Point(position, power) => power * point(position, &|r| 1.0 / (r * r)),
            Lamp::Linear(position, power, reach) => power * point(position, &|r| (1.0 - r / reach).max(0.0)),
            Lamp::Sun(towards, power) => {
                let cosine = normal.dot(towards);
                let lit = cosine > 0.0 && self.hit(at, towards, f32::INFINITY).is_none();
                if lit { power * cosine } else { Vec3::ZERO }
            }
            Lamp::Panel(corner, u, v, radiance) => {
                const SIDE: u32 = 10;
                let (facing, area) = (u.cross(v).normalize(), u.cross(v).length());
                let mut sum = 0.0;
                for cell in 0..SIDE * SIDE {
                    let place = |c: u32, r: f32| (c as f32 + r) / SIDE as f32;
                    let x = place(cell % SIDE, random.unit());
                    let y = place(cell / SIDE, random.unit());
                    let target = corner + u * x + v * y + facing * 1e-3;
                    let to = target - at;
                    let squared = to.length_squared();
                    let (cosine, away) = (normal.dot(to), -facing.dot(to));
                    if cosine > 0.0 && away > 0.0 && self.free(at, target) {
                        sum += cosine * away / (squared * squared);
                    }
                }
                radiance * (sum * area / (SIDE * SIDE) as f32)
            }
            Lamp::Sky(radiance) => {
                const RAYS: u32 = 512;
                let seen = (0..RAYS)
                    .filter(|_| self.hit(at, cosine(normal, random), f32::INFINITY).is_none())
                    .count();
                radiance * (PI * seen as f32 / RAYS as f32)
            }
        }
    }

    /// Bakes direct light and `bounces` reflections, by `rays` rays a patch each.
    pub fn bake(&mut self, lamps: &[Lamp], bounces: u32, rays: u32) {
        let mut random = Random(17);
        let n = self.supersampling;
        let mut light: Vec<Vec3> = vec![Vec3::ZERO; self.patches.len()];
        for rect in &self.rects {
            for cell in 0..(rect.cells[0] * rect.cells[1]) as usize {
                let patch = rect.first_patch + cell;
                let (i, j) = (cell as u32 % rect.cells[0], cell as u32 / rect.cells[0]);
                for sub in 0..n * n {
                    let at =
                        |i: u32, s: u32, cells: u32| (i as f32 + (s as f32 + 0.5) / n as f32) / cells as f32;
                    let place = rect.corner
                        + rect.u * at(i, sub % n, rect.cells[0])
                        + rect.v * at(j, sub / n, rect.cells[1]);
                    let normal = self.patches[patch].normal;
                    for lamp in lamps {
                        let received = self.direct(place + normal * 1e-3, normal, lamp, &mut random);
                        light[patch] += received / (n * n) as f32;
                    }
                }
            }
        }
        let mut total = light.clone();
        for _ in 0..bounces {
            light = self.reflect(&light, rays, &mut random);
            total.iter_mut().zip(&light).for_each(|(total, light)| *total += *light);
        }
        self.patches.iter_mut().zip(total).for_each(|(patch, light)| patch.irradiance = light);
    }

    fn reflect(&self, light: &[Vec3], rays: u32, random: &mut Random) -> Vec<Vec3> {
        let gather = |patch: &Patch, random: &mut Random| {
            let origin = patch.position + patch.normal * 1e-3;
            let mut sum = Vec3::ZERO;
            for _ in 0..rays {
                let direction = cosine(patch.normal, random);
                let Some((number, _, place)) = self.hit(origin, direction, f32::INFINITY) else {
                    continue;
                };
                let rect = &self.rects[number];
                if rect.u.cross(rect.v).dot(direction) < 0.0 {
                    let cell = |p: f32, n: u32| ((p * n as f32) as u32).min(n - 1);
                    let index = cell(place[1], rect.cells[1]) * rect.cells[0] + cell(place[0], rect.cells[0]);
                    sum += rect.albedo * light[rect.first_patch + index as usize];
                }
            }
            sum / rays as f32
        };
        self.patches.iter().map(|patch| gather(patch, random)).collect()
    }

    /// Relative noise, 8 bits between 0 and `white`; what is brighter is scaled down to it, keeping its hue.
    pub fn degrade(&mut self, noise: f32, white: f32) {
        let mut random = Random(5);
        for patch in &mut self.patches {
            let noisy = Vec3::from(patch.irradiance.to_array().map(|c| c * (1.0 + noise * random.normal())));
            let clipped = noisy / (noisy.max_element() / white).max(1.0);
            patch.irradiance = (clipped / white * 255.0).round() / 255.0 * white;
        }
    }
}

fn cosine(normal: Vec3, random: &mut Random) -> Vec3 {
    let z = random.unit() * 2.0 - 1.0;
    let angle = random.unit() * TAU;
    let across = (1.0 - z * z).max(0.0).sqrt();
    (normal + Vec3::new(across * angle.cos(), across * angle.sin(), z) * 0.9999).normalize()
}
