//! The usable patches, as columns of numbers.

use crate::types::{Baked, Patch};
use glam::Vec3;

/// Coordinates and light beyond this are damage: their squares would overflow sums.
const LARGEST: f32 = 1e9;
/// Most patches that are looked at; of more, every n-th.
const MOST: usize = 1 << 15;

/// Patches to fit to, in the order of a space-filling curve: every n-th of them is spread evenly.
#[derive(Clone, Default)]
pub(crate) struct Samples {
    /// Their numbers among the patches given.
    pub number: Vec<u32>,
    pub position: Vec<Vec3>,
    /// Unit.
    pub normal: Vec<Vec3>,
    pub area: Vec<f32>,
    /// Clamped to 0..1.
    pub albedo: Vec<Vec3>,
    /// The baked irradiance, channel by channel.
    pub target: [Vec<f32>; 3],
    /// The target is a lower bound.
    pub clipped: Vec<bool>,
    /// Squared errors count this much.
    pub weight: Vec<f32>,
}

/// Whether a patch means anything.
pub(crate) fn usable(patch: &Patch) -> bool {
    // NaN fails the comparisons too.
    let sane = |v: Vec3| v.to_array().iter().all(|c| c.abs() < LARGEST);
    sane(patch.position)
        && sane(patch.normal)
        && sane(patch.irradiance)
        && sane(patch.albedo)
        && patch.normal.length_squared() > 1e-12
        && patch.area > 0.0
        && patch.area < LARGEST
}

impl Samples {
    pub fn new(baked: &Baked, saturation: Option<f32>) -> Self {
        let usable = (0u32..).zip(baked.patches).filter(|(_, patch)| usable(patch));
        let mut numbers: Vec<(u64, u32)> = usable.map(|(number, _)| (0, number)).collect();
        let bounds = Bounds::of(numbers.iter().map(|&(_, n)| baked.patches[n as usize].position));
        for (code, number) in &mut numbers {
            *code = morton(bounds.place(baked.patches[*number as usize].position));
        }
        numbers.sort_unstable();
        let stride = numbers.len().div_ceil(MOST).max(1);
        let mut samples = Self::default();
        for &(_, number) in numbers.iter().step_by(stride) {
            samples.push(number, &baked.patches[number as usize], saturation);
        }
        samples.weigh();
        samples
    }

    fn push(&mut self, number: u32, patch: &Patch, saturation: Option<f32>) {
        let irradiance = patch.irradiance.max(Vec3::ZERO);
        self.number.push(number);
        self.position.push(patch.position);
        self.normal.push(patch.normal.normalize());
        self.area.push(patch.area);
        self.albedo.push(patch.albedo.clamp(Vec3::ZERO, Vec3::ONE));
        for channel in 0..3 {
            self.target[channel].push(irradiance[channel]);
        }
        // Compilers clip a colour as a whole to keep its hue, so one full channel makes all doubtful.
        self.clipped.push(saturation.is_some_and(|level| irradiance.max_element() >= level * 0.998));
        self.weight.push(0.0);
    }

    /// Errors of a bake grow with its brightness: half of the way to relative errors, so that places that
    /// a lamp lights from nearby do not outweigh all others.
    fn weigh(&mut self) {
        let brightness: Vec<f32> = (0..self.len()).map(|i| self.irradiance(i).length()).collect();
        let total: f64 = brightness.iter().zip(&self.area).map(|(&b, &a)| f64::from(b * a)).sum();
        let area: f64 = self.area.iter().map(|&a| f64::from(a)).sum();
        let mean = (total / area.max(f64::MIN_POSITIVE)) as f32;
        let mean_area = (area / self.len().max(1) as f64) as f32;
        for (i, brightness) in brightness.into_iter().enumerate() {
            let expected = brightness + 0.2 * mean;
            // One huge patch is one observation still.
            let area = (self.area[i] / mean_area).min(16.0);
            self.weight[i] = if mean > 0.0 { area * mean / expected } else { 0.0 };
        }
    }

    pub fn len(&self) -> usize {
        self.number.len()
    }

    /// The baked irradiance of sample `i`.
    pub fn irradiance(&self, i: usize) -> Vec3 {
        Vec3::new(self.target[0][i], self.target[1][i], self.target[2][i])
    }

    /// At most `most` of them, evenly spread.
    pub fn thinned(&self, most: usize) -> (Self, Vec<usize>) {
        let stride = self.len().div_ceil(most.max(1)).max(1);
        let kept: Vec<usize> = (stride / 2..self.len()).step_by(stride).collect();
        let samples = Self {
            number: pick(&self.number, &kept),
            position: pick(&self.position, &kept),
            normal: pick(&self.normal, &kept),
            area: pick(&self.area, &kept),
            albedo: pick(&self.albedo, &kept),
            target: self.target.each_ref().map(|target| pick(target, &kept)),
            clipped: pick(&self.clipped, &kept),
            weight: pick(&self.weight, &kept),
        };
        (samples, kept)
    }

    /// The box around them.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.position.iter().copied())
    }
}

/// The values at `kept`.
pub(crate) fn pick<T: Copy>(values: &[T], kept: &[usize]) -> Vec<T> {
    kept.iter().map(|&i| values[i]).collect()
}

/// A box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub min: Vec3,
    pub max: Vec3,
}

impl Bounds {
    /// The point 0 for no points.
    pub fn of(points: impl Iterator<Item = Vec3>) -> Self {
        let around = |bounds: Option<Self>, point: Vec3| {
            let Self { min, max } = bounds.unwrap_or(Self { min: point, max: point });
            Some(Self { min: min.min(point), max: max.max(point) })
        };
        points.fold(None, around).unwrap_or(Self { min: Vec3::ZERO, max: Vec3::ZERO })
    }

    pub fn extent(&self) -> Vec3 {
        self.max - self.min
    }

    /// Where a point lies in the cube around the box, 0..2^20 along each axis.
    fn place(&self, point: Vec3) -> [u32; 3] {
        let scale = 1_048_575.0 / self.extent().max_element().max(f32::MIN_POSITIVE);
        ((point - self.min) * scale).to_array().map(|c| c as u32)
    }
}

/// Interleaves the low 20 bits of three numbers.
fn morton(place: [u32; 3]) -> u64 {
    let mut code = 0;
    for bit in 0..20 {
        for (axis, &value) in (0u32..).zip(&place) {
            code |= u64::from(value >> bit & 1) << (3 * bit + axis);
        }
    }
    code
}
