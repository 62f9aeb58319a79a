//! The shaders' functions against their twins, input by input, and densities that integrate to 1 there too.

#![allow(clippy::unwrap_used, reason = "what cannot go on is to fail loudly")]

#[path = "support/gpu.rs"]
mod gpu;
#[path = "support/twins.rs"]
mod twins;

use afterglow_sampling::bsdf::{Bsdf, specular_chance};
use afterglow_sampling::caps::{cap_direction_z, sphere_direction};
use afterglow_sampling::microfacet::alpha_of;
use afterglow_sampling::random::{Random, independent, random_2d};
use bytemuck::Zeroable;
use glam::{Vec2, Vec3};
use std::collections::BTreeMap;
use twins::{Field, Fields, Input, Tolerance, expected};

/// Words of one input's answers.
fn width() -> usize {
    expected(&Input::zeroed(), &[0; 256]).0.iter().map(|field| field.words.len()).sum()
}

/// One of several at random.
fn pick<T: Copy>(random: f32, of: &[T]) -> T {
    of[(random * of.len() as f32) as usize]
}

/// A direction above the horizon, of any cosine or of an awkward one.
fn upward(random: Vec2, awkward: f32) -> Vec3 {
    let w = cap_direction_z(1.0, random);
    if awkward > 0.2 {
        return w;
    }
    let cos = pick(awkward * 5.0, &[1.0, 0.999_999, 0.999, 1e-2, 1e-4, 1e-6f32]);
    let flat = w.truncate().normalize_or(Vec2::X) * (1.0 - cos * cos).max(0.0).sqrt();
    flat.extend(cos)
}

/// A colour, or none.
fn colour(numbers: Vec3, awkward: f32) -> Vec3 {
    if awkward < 0.25 {
        pick(awkward * 4.0, &[Vec3::ZERO, Vec3::ONE, Vec3::X, Vec3::splat(1e-30)])
    } else {
        numbers
    }
}

/// Input `index`: random, a share of it extreme.
fn input(index: u32) -> Input {
    let draw = |dimension| independent(index, 0, dimension, 5);
    let [a, b, c, d, e, f, g] = [draw(0), draw(1), draw(2), draw(3), draw(4), draw(5), draw(6)];
    let most = 1.0 - f32::EPSILON / 2.0;
    let wo = upward(Vec2::new(a.x, a.y), a.z);
    let near_mirrored = (wo * Vec3::new(-1.0, -1.0, 1.0) + (d.truncate() - 0.5) * 0.01).normalize();
    let wi = match (a.w * 8.0) as u32 {
        0 => -upward(Vec2::new(b.x, b.y), b.z),
        1 | 2 => near_mirrored,
        _ => upward(Vec2::new(b.x, b.y), b.z),
    };
    let extreme =
        |random: f32, other: f32| if random < 0.05 { pick(random * 20.0, &[0.0, 0.5, most]) } else { other };
    let density = |random: f32| {
        if random < 0.2 { pick(random * 5.0, &[0.0, 1e-45, 1e30]) } else { 10f32.powf(random * 66.0 - 36.0) }
    };
    let roughness = if c.x < 0.2 {
        pick(c.x * 5.0, &[0.0, 1e-4, 1e-3, 1.0, 5.0, -1.0, f32::NAN, f32::INFINITY, -0.0])
    } else {
        c.y
    };
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30, 3e38, 0.0];
    let channel = |random: f32| if random < 0.2 { pick(random * 5.0, &bad) } else { random * 1e5 };
    Input {
        wo: wo.to_array(),
        roughness,
        wi: wi.to_array(),
        choice: extreme(c.z, c.w),
        diffuse: colour(d.truncate(), d.w).to_array(),
        sin2: pick(e.x, &[10f32.powf(-12.0 * e.y), e.y, 0.0, 1.0, 4.0]),
        specular: colour(e.truncate(), e.w).to_array(),
        own: density(f.x),
        axis: pick(g.z, &[Vec3::Z, Vec3::NEG_Z, Vec3::X, sphere_direction(Vec2::new(g.x, g.y))]).to_array(),
        other: density(f.y),
        radiance: [channel(f.z), channel(f.w), g.w],
        cos_half: extreme(g.w, g.x),
        words: [b, d, f, g].map(|v| v.x.to_bits() ^ index),
        random: [extreme(b.w, b.x), extreme(b.z, b.y)],
    }
}

/// How far an answer is from its twin's, as a share of what is allowed.
fn distance(field: &Field, answered: &[u32]) -> f32 {
    let same = field.words == answered;
    let values = || field.words.iter().zip(answered).map(|(&a, &b)| (f32::from_bits(a), f32::from_bits(b)));
    let most = values().fold(0.0, |most: f32, (a, b)| most.max((a - b).abs()));
    let finite = values().all(|(_, b)| b.is_finite());
    let allowed = match field.tolerance {
        Tolerance::Bits => return if same { 0.0 } else { f32::INFINITY },
        // What is flushed to 0 may be: the least normal number.
        Tolerance::Ulps(ulps) => {
            ulps * f32::EPSILON * values().fold(0.0, |most: f32, (a, _)| most.max(a.abs()))
                + f32::MIN_POSITIVE
        }
        Tolerance::Absolute(most) => most + f32::MIN_POSITIVE,
        Tolerance::Direction(most) => {
            let length = Vec3::from_slice(bytemuck::cast_slice(answered)).length();
            if (length - 1.0).abs() > 1e-6 {
                return f32::INFINITY;
            }
            most
        }
    };
    if finite { most / allowed } else { f32::INFINITY }
}

/// Whether rounding alone may choose another lobe.
fn is_undecided(given: &Input) -> bool {
    let bsdf = Bsdf {
        diffuse: given.diffuse.into(),
        specular: given.specular.into(),
        alpha: alpha_of(given.roughness),
    };
    (given.choice - specular_chance(&bsdf, given.wo.into())).abs() < 1e-6 && given.choice > 0.0
}

#[test]
fn shaders_answer_as_their_twins_do() {
    let inputs: Vec<Input> = (0..100_000).map(input).filter(|given| !is_undecided(given)).collect();
    assert!(inputs.len() > 99_000);
    let answers = gpu::evaluate(&inputs, width());
    let mut worst = BTreeMap::<&str, (f32, usize)>::new();
    for (number, (given, mut answered)) in inputs.iter().zip(answers.chunks_exact(width())).enumerate() {
        let Fields(fields) = expected(given, answered);
        for field in fields {
            let (own, rest) = answered.split_at(field.words.len());
            answered = rest;
            let distance = distance(&field, own);
            let known = worst.entry(field.name).or_default();
            if distance > known.0 {
                *known = (distance, number);
            }
        }
    }
    for (name, (distance, number)) in &worst {
        println!("{name}: {distance:.3} of what is allowed, input {number}");
    }
    let far: Vec<_> = worst.iter().filter(|(_, (distance, _))| *distance > 1.0).collect();
    let examples: Vec<_> = far.iter().map(|(_, (_, number))| inputs[*number]).collect();
    assert!(far.is_empty(), "{far:#?} {examples:#?}");
}

/// Where a function's answer is.
fn place(name: &str) -> usize {
    let fields = expected(&Input::zeroed(), &[0; 256]).0;
    fields.iter().take_while(|field| field.name != name).map(|field| field.words.len()).sum()
}

#[test]
fn densities_integrate_to_one_on_the_device() {
    const COUNT: u32 = 1 << 14;
    let lobes = [(0.0, 1.0, 0.4), (0.5, 0.04, 0.3), (0.0, 0.5, 1.0), (0.7, 0.0, 1.0)];
    let cases: Vec<_> = lobes.iter().flat_map(|lobe| [1.0, 0.5, 0.1f32].map(|cos| (*lobe, cos))).collect();
    let inputs = cases.iter().flat_map(|&((diffuse, specular, roughness), cos)| {
        (0..COUNT).map(move |sample_index| {
            let point = |dimension| random_2d(Random { pixel: 9, sample_index }, dimension);
            Input {
                wo: [(1.0 - cos * cos).sqrt(), 0.0, cos],
                roughness,
                wi: cap_direction_z(1.0, point(0)).to_array(),
                choice: point(1).x,
                random: point(2).to_array(),
                diffuse: [diffuse; 3],
                specular: [specular; 3],
                axis: [0.0, 0.0, 1.0],
                ..Input::zeroed()
            }
        })
    });
    let inputs: Vec<Input> = inputs.collect();
    let answers = gpu::evaluate(&inputs, width());
    let (pdf, sampled) = (place("bsdf_pdf"), place("sample_bsdf.pdf"));
    for (case, threads) in cases.iter().zip(answers.chunks_exact(width() * COUNT as usize)) {
        let threads = threads.chunks_exact(width());
        let of = |thread: &[u32], at: usize| f64::from(f32::from_bits(thread[at]));
        let above: f64 = threads.clone().map(|thread| of(thread, pdf)).sum::<f64>() * std::f64::consts::TAU;
        let lost = threads.filter(|thread| of(thread, sampled) == 0.0).count();
        let whole = (above + lost as f64) / f64::from(COUNT);
        assert!((whole - 1.0).abs() < 5e-3, "{case:?}: {whole}, {lost} lost");
    }
}
