//! A level of rooms like an old game's, its lights baked and found again: seconds, residual, and how near they came.
//! One thread searches; seconds are those of the clock.
//!
//! `cargo run --release -p afterglow-relight --example level [BOUNCES [RAYS [SEED [WHITE]]]]`; with WHITE,
//! the bake has 2 % of noise and 8 bits, and is clipped there.

#[path = "../tests/support/mod.rs"]
mod support;

use afterglow_relight::{Options, Sky, recover};
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use support::level::{distance, level};

/// Side of a patch; rooms are 8 by 8 by 4.
const PATCH: f32 = 1.25;

fn main() {
    let arguments: Vec<u64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let bounces = arguments.first().copied().unwrap_or(1) as u32;
    let mut options = Options::default();
    options.rays = arguments.get(1).copied().unwrap_or(options.rays);
    options.seed = arguments.get(2).copied().unwrap_or(options.seed);
    let (mut built, lamps) = level(5, 5, PATCH);
    let start = Instant::now();
    built.bake(&lamps, bounces, 128);
    if let Some(&white) = arguments.get(3) {
        built.degrade(0.02, white as f32);
        options.saturation = Some(white as f32);
    }
    let triangles = built.triangles();
    println!(
        "{} triangles, {} patches, {} lamps, {bounces} bounces baked in {:.1} s",
        triangles.len(),
        built.patches.len(),
        lamps.len(),
        start.elapsed().as_secs_f64()
    );
    let start = Instant::now();
    let baked = built.baked(&triangles, Sky::None);
    let found = recover(&baked, &options, &AtomicBool::new(false)).expect("nobody cancels");
    println!(
        "{:.2} s, {:.1} million rays, residual {:.4}, explained {:.3}, {} lights, bounce {:.2}",
        start.elapsed().as_secs_f64(),
        found.rays as f64 * 1e-6,
        found.residual,
        found.explained,
        found.lights.len(),
        found.bounce
    );
    let mut distances: Vec<f32> = lamps.iter().map(|lamp| distance(lamp, &found.lights)).collect();
    distances.sort_by(f32::total_cmp);
    let within = |most: f32| distances.iter().filter(|&&d| d < most).count();
    println!(
        "lamps found within 0.25: {}, within 1: {}; median distance {:.3}",
        within(0.25),
        within(1.0),
        distances[distances.len() / 2]
    );
}
