//! What samples receive from the sky and from one another.
//!
//! Baked light E contains what surfaces reflect: E = direct + F(albedo x E), F being the operator that gathers over
//! the hemisphere. E is known, so the second term needs no solution of anything: it is gathered once, by rays, and
//! the direct light is what remains. A bake of fewer bounces holds less of it; how much is one more unknown.

use crate::random::{cosine_direction, hash, spread};
use crate::samples::Samples;
use crate::world::{Met, World};
use glam::{IVec3, Vec3};
use std::collections::HashMap;
use std::f32::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};

/// How many times more rays are traced where little sky is seen.
const FINE: u32 = 6;
/// Samples of a cell that are looked at: patches may all lie in one place.
const MOST_IN_CELL: u32 = 64;

/// Light of hemispheres, one a sample.
pub(crate) struct Gathered {
    /// Irradiance from a sky of radiance 1.
    pub sky: Vec<f32>,
    /// Irradiance from the radiosity of all samples, channel by channel.
    pub bounce: [Vec<f32>; 3],
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
    let mut gathered = Gathered { sky: Vec::new(), bounce: [Vec::new(), Vec::new(), Vec::new()] };
    for i in 0..samples.len() {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        let (normal, turn) = (samples.normal[i], hash(seed ^ 0x6a7e, u64::from(samples.number[i])));
        let origin = samples.position[i] + normal * world.offset();
        let (mut sky, mut bounce, mut traced) = (0u32, Vec3::ZERO, 0);
        while traced < rays || (traced < FINE * rays && uncertain(sky, traced)) {
            let direction = cosine_direction(normal, spread(traced, turn));
            traced += 1;
            match world.first(origin, direction) {
                Met::Sky => sky += 1,
                Met::Surface(t) => bounce += near.radiosity(samples, origin + direction * t, direction),
                Met::Nothing => {}
            }
        }
        // Density cosine / pi: irradiance is pi times the mean radiance, and radiance is radiosity / pi.
        let share = 1.0 / traced.max(1) as f32;
        gathered.sky.push(sky as f32 * PI * share);
        for channel in 0..3 {
            gathered.bounce[channel].push(bounce[channel] * share);
        }
    }
    Some(gathered)
}

/// The sky is seen through a gap that few rays find.
fn uncertain(sky: u32, traced: u32) -> bool {
    sky > 0 && sky < traced / 4
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

    /// Albedo x irradiance at a point that was reached along `direction`, from the samples about it.
    fn radiosity(&self, samples: &Samples, point: Vec3, direction: Vec3) -> Vec3 {
        let centre = cell_of(point, self.cell);
        let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
        for step in 0..27 {
            let key = centre.saturating_add(IVec3::new(step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1));
            let Some(&(first, end)) = self.first.get(&key) else {
                continue;
            };
            let end = end.min(first + MOST_IN_CELL);
            for &i in &self.order[first as usize..end as usize] {
                let i = i as usize;
                let (offset, normal) = (point - samples.position[i], samples.normal[i]);
                if normal.dot(direction) >= 0.0 || normal.dot(offset).abs() > 0.25 * self.cell {
                    continue;
                }
                let squared = offset.length_squared();
                let weight = 1.0 / (squared * squared + 1e-4 * self.cell.powi(4));
                sum += samples.albedo[i] * samples.irradiance(i) * weight;
                weights += weight;
            }
        }
        if weights > 0.0 { sum / weights } else { Vec3::ZERO }
    }
}

fn cell_of(position: Vec3, cell: f32) -> IVec3 {
    (position / cell).floor().as_ivec3()
}
