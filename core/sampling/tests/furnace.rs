//! White furnaces: under a sky that is 1 everywhere, a surface shows what it reflects.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

mod support;

use afterglow_sampling::bsdf::{Bsdf, sample_bsdf};
use afterglow_sampling::directions::tangents;
use afterglow_sampling::microfacet::alpha_of;
use afterglow_sampling::random::{Random, random_2d};
use glam::{Vec2, Vec3};
use std::f64::consts::TAU;
use support::{Mean, World, cube, draws};

/// Albedo of GGX metal of base colour 1, single scattering, separable Smith, by roughness and cosine to the viewer.
const COSINES: [f32; 5] = [1.0, 0.8, 0.5, 0.2, 0.05];
const ALBEDO: [(f32, [f64; 5]); 6] = [
    (0.1, [1.0, 0.99989, 0.99972, 0.99843, 0.97528]),
    (0.2, [0.9984, 0.99777, 0.99564, 0.97495, 0.88183]),
    (0.4, [0.9677, 0.95803, 0.92591, 0.86213, 0.88913]),
    (0.6, [0.82453, 0.80352, 0.77642, 0.79532, 0.84392]),
    (0.8, [0.55517, 0.56537, 0.60085, 0.67531, 0.73464]),
    (1.0, [0.30685, 0.34095, 0.40914, 0.51142, 0.58448]),
];

fn at(cos: f32) -> Vec3 {
    Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
}

fn metal(roughness: f32) -> Bsdf {
    Bsdf { diffuse: Vec3::ZERO, specular: Vec3::ONE, alpha: alpha_of(roughness) }
}

/// What the estimator makes of a sky of 1; no sample may weigh more than 1.
fn albedo_of_metal(roughness: f32, cos: f32) -> f64 {
    let count = 1 << 14;
    let weights = (0..count).map(|sample_index| {
        let random = random_2d(Random { pixel: 3, sample_index }, 0);
        let sample = sample_bsdf(&metal(roughness), at(cos), 0.5, random);
        assert!(sample.is_specular && sample.weight.min_element() >= 0.0);
        assert!(sample.weight.max_element() <= 1.0, "{roughness} {cos}: {sample:?}");
        assert!(sample.pdf.is_finite() && sample.wi.is_finite());
        f64::from(sample.weight.x)
    });
    weights.sum::<f64>() / f64::from(count)
}

/// The same by quadrature in f64, with microfacet normals distributed as D cos.
fn exact_albedo(alpha: f64, cos: f64) -> f64 {
    let g1 = |w: f64| 2.0 / (1.0 + (1.0 + alpha * alpha * (1.0 - w * w) / (w * w)).sqrt());
    let (steps, turns) = (2000, 256);
    let mut sum = 0.0;
    for i in 0..steps {
        // Its square is uniform under D cos; tangents go as 1 over it, so that equal steps of it are even.
        let rest = (f64::from(i) + 0.5) / f64::from(steps);
        let h_cos = (1.0 + alpha * alpha * (1.0 - rest * rest) / (rest * rest)).sqrt().recip();
        let h_sin = (1.0 - h_cos * h_cos).sqrt();
        for turn in 0..turns {
            let h_x = h_sin * ((f64::from(turn) + 0.5) / f64::from(turns) * TAU).cos();
            let facing = h_x * (1.0 - cos * cos).sqrt() + h_cos * cos;
            let light_cos = 2.0 * facing * h_cos - cos;
            if facing > 0.0 && light_cos > 0.0 {
                sum += 2.0 * rest * g1(light_cos) * g1(cos) * facing / (cos * h_cos);
            }
        }
    }
    sum / f64::from(steps * turns)
}

#[test]
fn metal_keeps_what_the_table_says() {
    for (roughness, row) in ALBEDO {
        for (cos, expected) in COSINES.into_iter().zip(row) {
            let albedo = albedo_of_metal(roughness, cos);
            assert!((albedo - expected).abs() < 3e-3, "{roughness} {cos}: {albedo}, not {expected}");
        }
    }
}

#[test]
fn mirrors_and_grazing_views_are_finite_and_right() {
    for roughness in [0.0, 1e-4, 1e-3, 0.1, 0.5, 1.0, f32::NAN, -1.0] {
        for cos in [1.0, 0.2, 0.05, 1e-4, 1e-6] {
            let albedo = albedo_of_metal(roughness, cos);
            let expected = exact_albedo(alpha_of(roughness).into(), cos.into());
            assert!((albedo - expected).abs() < 3e-3, "{roughness} {cos}: {albedo}, not {expected}");
        }
    }
}

/// The mean radiance that a cube under a sky of 1 shows, by paths from outside that end in the sky.
fn cube_under_sky(bsdf: &Bsdf, each: impl Fn(Vec3)) -> Mean {
    let triangles = cube();
    let world = World::new(&triangles);
    let mut mean = Mean::new();
    for (i, random) in (0..).zip(draws(40, 20_000)) {
        let eye = Vec3::splat(0.5)
            + 3.0 * afterglow_sampling::caps::sphere_direction(Vec2::new(random.x, random.y));
        let target = Vec3::new(random.z, random.w, random.x * 0.9 + 0.05);
        let direction = (target - eye).normalize();
        let Some(hit) = world.trace(eye, 0.0, direction) else { continue };
        let [a, b, c] = triangles[hit.primitive as usize];
        let normal = (b - a).cross(c - a).normalize();
        let [tangent, bitangent] = tangents(normal);
        let wo = Vec3::new(-tangent.dot(direction), -bitangent.dot(direction), -normal.dot(direction));
        let random = random_2d(Random { pixel: 7, sample_index: i }, 1);
        let sample = sample_bsdf(bsdf, wo, random_2d(Random { pixel: 7, sample_index: i }, 2).x, random);
        if sample.weight == Vec3::ZERO {
            mean.add(0.0);
            continue;
        }
        let away = tangent * sample.wi.x + bitangent * sample.wi.y + normal * sample.wi.z;
        assert_eq!(
            world.trace(eye + direction * hit.t, 1e-4, away),
            None,
            "nothing of a convex body is in the way"
        );
        each(sample.weight);
        mean.add(sample.weight.x.into());
    }
    mean
}

#[test]
fn a_lambertian_body_shows_its_albedo() {
    for albedo in [1.0, 0.8, 0.18, 0.0] {
        let bsdf = Bsdf { diffuse: Vec3::splat(albedo), specular: Vec3::ZERO, alpha: 1.0 };
        // Each path has it, not only their mean: no bias at albedo 1.
        let mean = cube_under_sky(&bsdf, |weight| assert!((weight - albedo).abs().max_element() <= 6e-8));
        assert!((mean.mean() - f64::from(albedo)).abs() <= 6e-8, "{mean:?}");
    }
}

#[test]
fn two_lobes_show_the_sum_of_both() {
    // Against the lobes one by one, whose chances are 0 and 1.
    let both = Bsdf { diffuse: Vec3::new(0.5, 0.2, 0.1), specular: Vec3::splat(0.04), alpha: 0.09 };
    let diffuse = Bsdf { specular: Vec3::ZERO, ..both };
    let specular = Bsdf { diffuse: Vec3::ZERO, ..both };
    for cos in [1.0, 0.5, 0.1] {
        let mean = |bsdf: &Bsdf| {
            let mut mean = Mean::new();
            for random in draws(50, 100_000) {
                let sample = sample_bsdf(bsdf, at(cos), random.x, Vec2::new(random.y, random.z));
                let most =
                    (bsdf.diffuse + Vec3::ONE).max_element() / afterglow_sampling::bsdf::LEAST_LOBE_CHANCE;
                assert!(sample.weight.max_element() <= most, "{sample:?}");
                mean.add(sample.weight.x.into());
            }
            mean
        };
        let [both, diffuse, specular] = [both, diffuse, specular].map(|bsdf| mean(&bsdf));
        both.assert_near(
            diffuse.mean() + specular.mean(),
            4.0 + 4.0 * specular.standard_error() / both.standard_error(),
        );
    }
}
