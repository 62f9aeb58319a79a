//! What the caller is told.

use crate::fit::{Bounces, Fit};
use crate::samples::Samples;
use crate::types::{Baked, Found, Light};
use glam::Vec3;

/// A relative error up to this is an explanation.
const EXPLAINED: f32 = 0.25;
/// What is darker than this share of the brightest tenth counts as this bright.
const DARK: f32 = 0.02;

/// Sums up a fit, or no light at all.
pub(crate) fn report(baked: &Baked, samples: &Samples, fit: Option<&Fit>, rays: u64) -> Found {
    let error = |i: usize| fit.map_or(samples.irradiance(i), |fit| fit.error(i));
    let floor = DARK * bright(samples);
    let mut found = Found { per_patch: vec![f32::INFINITY; baked.patches.len()], rays, ..Found::default() };
    let (mut missed, mut total, mut explained, mut area) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    for i in 0..samples.len() {
        let (error, light) = (error(i).length(), samples.irradiance(i).length());
        let share = f64::from(samples.area[i]);
        let relative = if error > 0.0 { error / light.max(floor) } else { 0.0 };
        found.per_patch[samples.number[i] as usize] = relative;
        missed += share * f64::from(error).powi(2);
        total += share * f64::from(light).powi(2);
        explained += if relative < EXPLAINED { share } else { 0.0 };
        area += share;
    }
    found.residual = if total > 0.0 { (missed / total).sqrt() as f32 } else { 0.0 };
    found.explained = if area > 0.0 { (explained / area) as f32 } else { 0.0 };
    if let Some(fit) = fit {
        found.ambient = vector(fit.ambient);
        found.bounce = vector(fit.bounce);
        found.one_bounce = fit.bounces == Bounces::First;
        found.lights = lights(fit);
    }
    found
}

impl Fit<'_> {
    /// Bake less model; 0 where a clipped bake is reached.
    fn error(&self, i: usize) -> Vec3 {
        let missed = |c: usize| {
            let left = self.residual[c][i];
            if self.optics.samples.clipped[i] { left.max(0.0) } else { left }
        };
        Vec3::new(missed(0), missed(1), missed(2))
    }
}

fn lights(fit: &Fit) -> Vec<Light> {
    let (objective, energy) = (fit.objective(), fit.energy().max(f64::MIN_POSITIVE));
    let light = |number: usize| {
        let atom = &fit.atoms[number];
        let evidence = ((fit.objective_without(number) - objective) / energy).clamp(0.0, 1.0) as f32;
        Light { source: atom.source, power: vector(atom.power), evidence }
    };
    let mut lights: Vec<Light> = (0..fit.atoms.len()).map(light).collect();
    lights.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    lights
}

/// The brightness that a tenth of the samples exceeds.
fn bright(samples: &Samples) -> f32 {
    let mut sorted: Vec<f32> = (0..samples.len()).map(|i| samples.irradiance(i).length()).collect();
    sorted.sort_unstable_by(f32::total_cmp);
    sorted.get(sorted.len() * 9 / 10).copied().unwrap_or(0.0)
}

fn vector(values: [f64; 3]) -> Vec3 {
    Vec3::from(values.map(|v| v as f32))
}
