//! What samples receive from the sky and from one another.
//!
//! Baked light E contains what surfaces reflect: E = direct + F(albedo x E), F being the operator that gathers over
//! the hemisphere. E is known, so the second term needs no solution of anything: it is gathered once, by rays, and
//! the direct light is what remains. A bake of one bounce holds F(albedo x direct) instead, which is known once the direct light
//! about is.

use crate::random::{cosine_direction, hash, spread};
use crate::samples::Samples;
use crate::world::{Met, World};
use glam::{IVec3, Vec3};
use std::collections::HashMap;
use std::f32::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};

/// How many times more rays are traced where little sky is seen.
const FINE: u32 = 6;
const LEAST_FINE: u32 = 512;
/// Samples of a cell that are looked at: patches may all lie in one place.
const MOST_IN_CELL: u32 = 64;

/// What the hemispheres of samples hold.
pub(crate) struct Gathered {
    /// Irradiance from a sky of radiance 1, one a sample.
    pub sky: Vec<f32>,
    /// It, or a sample near it, has seen the sky: a sun may shine on it.
    pub near_sky: Vec<bool>,
    /// The samples that rays met, sample by sample, and where those of each begin.
    met: Vec<u32>,
    first: Vec<u32>,
    /// Rays of a sample.
    rays: u32,
}

impl Gathered {
    /// F(albedo x E): what samples receive from one another where they receive `irradiance`, channel by channel.
    pub fn bounce(&self, samples: &Samples, irradiance: &[Vec<f32>; 3]) -> [Vec<f32>; 3] {
        let radiosity = |i: u32| {
            let i = i as usize;
            samples.albedo[i] * Vec3::new(irradiance[0][i], irradiance[1][i], irradiance[2][i])
        };
        let mut bounced = [const { Vec::new() }; 3];
        for (i, &first) in self.first.iter().enumerate() {
            let end = self.first.get(i + 1).map_or(self.met.len(), |&next| next as usize);
            let sum: Vec3 = self.met[first as usize..end].iter().map(|&i| radiosity(i)).sum();
            // Density cosine / pi: irradiance is pi times the mean radiance, and radiance is radiosity / pi.
            let mean = sum / self.rays.max(1) as f32;
            for channel in 0..3 {
                bounced[channel].push(mean[channel]);
            }
        }
        bounced
    }
}

/// Gathers by `rays` rays a sample; None where it was cancelled.
pub(crate) fn gather(
    world: &World,
    samples: &Samples,
    rays: u32,
    seed: u64,
    cancel: &AtomicBool,
) -> Option<Gathered> {
    let near = Near::new(samples);
    let mut gathered =
        Gathered { sky: Vec::new(), near_sky: Vec::new(), met: Vec::new(), first: Vec::new(), rays };
    let hemisphere = |i: usize, ray: u32| {
        let (normal, turn) = (samples.normal[i], hash(seed ^ 0x6a7e, u64::from(samples.number[i])));
        let origin = samples.position[i] + normal * world.offset();
        (origin, cosine_direction(normal, spread(ray, turn)))
    };
    let mut skies = Vec::new();
    for i in 0..samples.len() {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        gathered.first.push(gathered.met.len() as u32);
        let mut sky = 0u32;
        for ray in 0..rays {
            let (origin, direction) = hemisphere(i, ray);
            match world.first(origin, direction) {
                Met::Sky => sky += 1,
                Met::Surface(t) => {
                    gathered.met.extend(near.sample(samples, origin + direction * t, direction));
                }
                Met::Nothing => {}
            }
        }
        skies.push(sky);
    }
    for (i, &sky) in skies.iter().enumerate() {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        let (mut seen, mut traced) = (sky, rays);
        let near_sky = sees_sky_about(&skies, i);
        if near_sky && sky < rays / 4 {
            traced = (FINE * rays).max(LEAST_FINE);
            let more = (rays..traced).map(|ray| hemisphere(i, ray));
            seen += more.filter(|&(origin, direction)| world.sees_sky(origin, direction)).count() as u32;
        }
        gathered.near_sky.push(near_sky);
        gathered.sky.push(seen as f32 * PI / traced.max(1) as f32);
    }
    Some(gathered)
}

/// Sample `i` or one next to it has seen the sky. Through a small gap few rays do; to go by its own alone would prefer samples
/// that met it by chance.
fn sees_sky_about(skies: &[u32], i: usize) -> bool {
    let about = &skies[i.saturating_sub(8)..(i + 9).min(skies.len())];
    about.iter().any(|&sky| sky > 0)
}

/// Samples by the cell they lie in.
struct Near {
    cell: f32,
    first: HashMap<IVec3, (u32, u32)>,
    order: Vec<u32>,
}

impl Near {
    fn new(samples: &Samples) -> Self {
        let mut areas = samples.area.clone();
        areas.sort_unstable_by(f32::total_cmp);
        let large = areas.get(areas.len() * 3 / 4).copied().unwrap_or(1.0);
        let cell = (1.5 * large.sqrt()).max(samples.bounds().extent().max_element() * 1e-3).max(1e-12);
        let mut keyed: Vec<([i32; 3], u32)> = (0u32..)
            .zip(&samples.position)
            .map(|(i, &position)| (cell_of(position, cell).to_array(), i))
            .collect();
        keyed.sort_unstable();
        let mut first: HashMap<IVec3, (u32, u32)> = HashMap::new();
        for (place, (key, _)) in (0u32..).zip(&keyed) {
            let range = first.entry(IVec3::from(*key)).or_insert((place, place));
            range.1 = place + 1;
        }
        Self { cell, first, order: keyed.into_iter().map(|(_, i)| i).collect() }
    }

    /// The nearest sample of the surface that was reached at `point` along `direction`.
    fn sample(&self, samples: &Samples, point: Vec3, direction: Vec3) -> Option<u32> {
        let centre = cell_of(point, self.cell);
        let mut nearest = (f32::INFINITY, None);
        for step in 0..27 {
            let key = centre.saturating_add(IVec3::new(step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1));
            let Some(&(first, end)) = self.first.get(&key) else {
                continue;
            };
            let end = end.min(first + MOST_IN_CELL);
            for &i in &self.order[first as usize..end as usize] {
                let (offset, normal) = (point - samples.position[i as usize], samples.normal[i as usize]);
                let faces = normal.dot(direction) < 0.0 && normal.dot(offset).abs() < 0.25 * self.cell;
                let squared = offset.length_squared();
                if faces && squared < nearest.0 {
                    nearest = (squared, Some(i));
                }
            }
        }
        nearest.1
    }
}

fn cell_of(position: Vec3, cell: f32) -> IVec3 {
    (position / cell).floor().as_ivec3()
}
