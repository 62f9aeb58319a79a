//! Densities against the samples that they are of, and techniques against each other.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

mod support;

use afterglow_sampling::bsdf::{Bsdf, bsdf_pdf, diffuse_value, sample_bsdf, specular_value};
use afterglow_sampling::heuristics::{balance, power_heuristic};
use afterglow_sampling::lights::SphereLight;
use afterglow_sampling::microfacet::alpha_of;
use glam::{Vec2, Vec3};
use std::f64::consts::TAU;
use support::{Mean, assert_chi_square, draws};

fn at(cos: f32) -> Vec3 {
    Vec3::new((1.0 - cos * cos).sqrt() * 0.6, (1.0 - cos * cos).sqrt() * -0.8, cos)
}

fn surfaces() -> impl Iterator<Item = (Bsdf, Vec3)> {
    let lobes = [(0.0, 1.0), (0.5, 0.04), (0.7, 0.0)];
    let views = [1.0, 0.5, 0.1];
    let all = lobes.into_iter().flat_map(move |lobe| views.map(|cos| (lobe, cos)));
    all.flat_map(|((diffuse, specular), cos)| {
        [0.3, 0.6, 1.0].map(|roughness| {
            let bsdf = Bsdf {
                diffuse: Vec3::splat(diffuse),
                specular: Vec3::splat(specular),
                alpha: alpha_of(roughness),
            };
            (bsdf, at(cos))
        })
    })
}

const ROWS: usize = 16;
const COLUMNS: usize = 32;

/// The bin of a direction above the horizon: equal steps of cosine and azimuth, so equal solid angles.
fn bin(wi: Vec3) -> usize {
    let row = (wi.z * ROWS as f32) as usize;
    let turn = f64::from(wi.y).atan2(f64::from(wi.x)) / TAU;
    let column = (turn.rem_euclid(1.0) * COLUMNS as f64) as usize;
    row.min(ROWS - 1) * COLUMNS + column.min(COLUMNS - 1)
}

/// The integral of the density over each bin, by the midpoint rule; narrow lobes are narrow in cosine about the normal,
/// and in azimuth at grazing.
fn chances(bsdf: &Bsdf, wo: Vec3) -> Vec<f64> {
    let fine: [usize; 2] = if bsdf.alpha < 0.2 { [96, 32] } else { [24, 8] };
    let mut chances = vec![0.0; ROWS * COLUMNS];
    for row in 0..ROWS * fine[0] {
        let z = (row as f64 + 0.5) / (ROWS * fine[0]) as f64;
        for column in 0..COLUMNS * fine[1] {
            let turn = (column as f64 + 0.5) / (COLUMNS * fine[1]) as f64 * TAU;
            let across = (1.0 - z * z).sqrt();
            let wi = glam::DVec3::new(across * turn.cos(), across * turn.sin(), z).as_vec3();
            chances[row / fine[0] * COLUMNS + column / fine[1]] += f64::from(bsdf_pdf(bsdf, wo, wi));
        }
    }
    let cell = TAU / (ROWS * COLUMNS * fine[0] * fine[1]) as f64;
    chances.iter().map(|chance| chance * cell).collect()
}

#[test]
fn directions_are_as_dense_as_their_density_says() {
    const COUNT: u32 = 100_000;
    for (bsdf, wo) in surfaces() {
        // The last bin is of what goes below the horizon and is lost.
        let mut counts = vec![0.0; ROWS * COLUMNS + 1];
        for random in draws(60, COUNT) {
            let sample = sample_bsdf(&bsdf, wo, random.x, Vec2::new(random.y, random.z));
            counts[if sample.pdf > 0.0 { bin(sample.wi) } else { ROWS * COLUMNS }] += 1.0;
        }
        let mut expected = chances(&bsdf, wo);
        let above: f64 = expected.iter().sum();
        assert!(above < 1.000_1, "{bsdf:?} {wo}: {above}");
        expected.push(1.0 - above);
        expected.iter_mut().for_each(|chance| *chance *= f64::from(COUNT));
        assert_chi_square(&counts, &expected, &format!("{bsdf:?} {wo}"));
    }
}

/// Whether a ray from the origin meets a sphere.
fn meets(light: &SphereLight, direction: Vec3) -> bool {
    let (centre, direction) = (light.centre.as_dvec3(), direction.as_dvec3().normalize());
    let along = centre.dot(direction);
    along > 0.0 && (centre - along * direction).length() < f64::from(light.radius)
}

/// Reflected radiance of a sphere of radiance 1, by asking the light, by following the BSDF, and by both.
fn estimates(bsdf: &Bsdf, wo: Vec3, light: &SphereLight, heuristic: fn(f32, f32) -> f32) -> [Mean; 3] {
    let mut means = [const { Mean::new() }; 3];
    for random in draws(70, 30_000) {
        let asked = light.sample(Vec3::ZERO, Vec2::new(random.x, random.y)).unwrap();
        let value = diffuse_value(bsdf, asked.direction) + specular_value(bsdf, wo, asked.direction);
        let by_light = f64::from(value.x / asked.pdf);
        let share = f64::from(heuristic(asked.pdf, bsdf_pdf(bsdf, wo, asked.direction)));

        let followed = sample_bsdf(bsdf, wo, random.x, Vec2::new(random.z, random.w));
        let is_met = meets(light, followed.wi);
        let by_bsdf = if is_met { f64::from(followed.weight.x) } else { 0.0 };
        let light_pdf = if is_met { light.pdf(Vec3::ZERO) } else { 0.0 };
        let other_share = f64::from(heuristic(followed.pdf, light_pdf));

        means[0].add(by_light);
        means[1].add(by_bsdf);
        means[2].add(share * by_light + other_share * by_bsdf);
    }
    means
}

#[test]
fn all_techniques_find_the_same_light() {
    let lights = [(0.5, 2.0, 0.9), (1.0, 1.5, 0.4), (0.05, 1.0, 0.7)];
    for (bsdf, wo) in surfaces() {
        for (radius, distance, cos) in lights {
            // Opposite to the viewer, where highlights are.
            let mirrored = at(cos) * Vec3::new(-1.0, -1.0, 1.0);
            let light = SphereLight { centre: mirrored * distance, radius };
            for heuristic in [balance, power_heuristic] {
                let [by_light, by_bsdf, by_both] = estimates(&bsdf, wo, &light, heuristic);
                for (a, b) in [(by_light, by_bsdf), (by_light, by_both), (by_bsdf, by_both)] {
                    let error = a.standard_error().hypot(b.standard_error());
                    let apart = (a.mean() - b.mean()).abs();
                    assert!(apart < 4.0 * error + 1e-6 * a.mean(), "{bsdf:?} {wo} {light:?}: {a:?} {b:?}");
                }
            }
        }
    }
}

#[test]
fn both_techniques_together_are_never_much_worse_than_the_better() {
    // A highlight of a small light: following the BSDF is poor; a mirror of a large one: asking the light is.
    let rough = Bsdf { diffuse: Vec3::ZERO, specular: Vec3::ONE, alpha: 0.5 };
    let mirror = Bsdf { alpha: 1e-3, ..rough };
    let small = SphereLight { centre: Vec3::Z, radius: 0.02 };
    let large = SphereLight { centre: Vec3::Z * 2.0, radius: 1.0 };
    for (bsdf, light) in [(rough, small), (mirror, large)] {
        let means = estimates(&bsdf, Vec3::Z, &light, power_heuristic);
        let [by_light, by_bsdf, by_both] = means.map(|mean| mean.variance() / mean.mean().powi(2));
        assert!(by_both < 1.5 * by_light.min(by_bsdf) + 0.01, "{by_light} {by_bsdf} {by_both}");
    }
}
