//! The search: sources are added one after the other where they explain most, and moved to where they explain
//! more (Boyd, Schiebinger and Recht, The Alternating Descent Conditional Gradient Method for Sparse Inverse Problems,
//! SIAM Journal on Optimization 27(2), 2017).
//!
//! A coarse subset of the patches decides which sources there are; all patches decide where they are and how strong.

use crate::candidates::{Candidates, Extent, candidates};
use crate::column::{Optics, Panel};
use crate::descend::{descend, groups};
use crate::fit::{Atom, Bounces, Fit};
use crate::gather::{Gathered, gather};
use crate::reduce::{is_told, likeness, merge, prune};
use crate::refine::{Trial, aim, aim_sun, search};
use crate::report::report;
use crate::samples::{Samples, pick};
use crate::types::{Baked, FalloffModel, Found, Options, Source};
use crate::world::World;
use std::sync::atomic::{AtomicBool, Ordering};

/// Relative residual below which no other falloff is tried.
const GOOD: f32 = 0.05;
/// Most sources, whatever is asked for.
const MOST_SOURCES: usize = 512;
/// Most emitters that are looked at.
const MOST_EMITTERS: usize = 512;
/// A source explains at least this share of what the others leave.
const LEAST_GAIN: f64 = 0.02;
/// How often all sources are moved in the end.
const SWEEPS: u32 = 4;
/// Samples that must tell of a point.
const LEAST_WITNESSES: f64 = 4.0;
/// The least angle between suns, in radians.
const SUNS_APART: f32 = 0.25;
/// Sources that are added before all are fitted anew.
const BATCH: usize = 6;
/// Sources whose form factors are more alike than this (cosine) are not added at once.
const ALIKE: f64 = 0.3;

/// Finds the light sources of a baked world; None where `cancel` was set meanwhile. The same input gives the same bits.
///
/// Nothing usable in `baked` finds nothing. Lights that the bake cannot tell apart are found as one. Time is about that of
/// [`Options::rays`] rays; memory is a few hundred bytes a triangle and at most some 100 MB for the rest.
pub fn recover(baked: &Baked, options: &Options, cancel: &AtomicBool) -> Option<Found> {
    if options.falloff != FalloffModel::Either {
        return recover_with(baked, options, cancel);
    }
    let first = recover_with(baked, &Options { falloff: FalloffModel::InverseSquare, ..*options }, cancel)?;
    if first.residual < GOOD {
        return Some(first);
    }
    let second = recover_with(baked, &Options { falloff: FalloffModel::Linear, ..*options }, cancel)?;
    let rays = first.rays + second.rays;
    let better = if second.residual < 0.8 * first.residual { second } else { first };
    Some(Found { rays, ..better })
}

fn recover_with(baked: &Baked, options: &Options, cancel: &AtomicBool) -> Option<Found> {
    let samples = Samples::new(baked, options.saturation);
    let size = samples.bounds().extent().length();
    let dark = samples.weight.iter().all(|&weight| weight == 0.0);
    let world = World::new(baked, size).filter(|_| size > 0.0 && !dark);
    let Some(world) = world else {
        return Some(report(baked, &samples, None, 0));
    };
    let effort = Effort::of(options.rays, samples.len());
    let gathered = gather(&world, &samples, effort.hemisphere, options.seed, cancel)?;
    let bounced = gathered.bounce(&samples, &samples.target);
    let panels: Vec<Panel> = baked.emitters.iter().take(MOST_EMITTERS).map(Panel::new).collect();
    let atoms = choose(
        baked,
        options,
        &effort,
        Scene { world: &world, samples: &samples, panels: &panels, gathered: &gathered, bounced: &bounced },
        cancel,
    )?;
    let optics = Optics {
        world: &world,
        samples: &samples,
        panels: &panels,
        sky: gathered.sky.clone(),
        near_sky: gathered.near_sky.clone(),
        sun_points: 4,
        area_rays: effort.area_rays,
        least_witnesses: LEAST_WITNESSES,
        seed: options.seed,
    };
    let mut fit = Fit::new(&optics, bounced.clone());
    for atom in atoms {
        let column = optics.column(&atom.source);
        fit.atoms.push(Atom { column, ..atom });
    }
    fit.refit();
    for sweep in 0..SWEEPS {
        let last = sweep + 1 == SWEEPS;
        if last {
            // Not sooner: what a source in a wrong place misses is no fault of the bake.
            fit.distrust();
        }
        relocate(&mut fit, sweep, cancel)?;
        choose_bounces(&mut fit, &gathered);
        if !last {
            let least = (f64::from(options.least_evidence) * fit.energy()).max(LEAST_GAIN * fit.objective());
            merge(&mut fit, least, cancel)?;
            prune(&mut fit, least, cancel)?;
        }
    }
    Some(report(baked, &samples, Some(&fit), world.rays()))
}

/// What was made of the input.
#[derive(Clone, Copy)]
struct Scene<'a> {
    world: &'a World,
    samples: &'a Samples,
    panels: &'a [Panel],
    gathered: &'a Gathered,
    bounced: &'a [Vec<f32>; 3],
}

/// How a number of rays is spent.
struct Effort {
    /// Samples that choose sources.
    coarse: usize,
    /// Rays over a sample's hemisphere.
    hemisphere: u32,
    /// Rays to an emitter.
    area_rays: u32,
    extent: Extent,
}

impl Effort {
    fn of(rays: u64, samples: usize) -> Self {
        // Candidates and the samples that judge them grow alike.
        let scale = (rays as f64 / 8e6).sqrt().clamp(0.1, 2.0);
        let part = |full: f64| (full * scale) as usize;
        Self {
            coarse: part(1024.0).max(768),
            hemisphere: (rays / (8 * samples.max(1) as u64)).clamp(48, 256) as u32,
            area_rays: (16.0 * scale).clamp(4.0, 32.0) as u32,
            extent: Extent { points: part(1400.0), suns: part(1000.0).max(700), emitters: part(256.0) },
        }
    }
}

/// The sources, found on a part of the samples.
fn choose(
    baked: &Baked,
    options: &Options,
    effort: &Effort,
    scene: Scene,
    cancel: &AtomicBool,
) -> Option<Vec<Atom>> {
    let (samples, kept) = scene.samples.thinned(effort.coarse);
    let optics = Optics {
        world: scene.world,
        samples: &samples,
        panels: scene.panels,
        sky: pick(&scene.gathered.sky, &kept),
        near_sky: pick(&scene.gathered.near_sky, &kept),
        sun_points: 1,
        area_rays: effort.area_rays.div_ceil(2),
        least_witnesses: LEAST_WITNESSES * kept.len() as f64 / scene.samples.len() as f64,
        seed: options.seed,
    };
    let candidates = candidates(&optics, baked, options.falloff, effort.extent, cancel)?;
    let mut fit = Fit::new(&optics, scene.bounced.each_ref().map(|bounced| pick(bounced, &kept)));
    let energy = fit.energy();
    let most = options.max_sources.min(MOST_SOURCES);
    let mut refused = vec![false; candidates.all.len()];
    while fit.atoms.len() < most {
        let objective = fit.objective();
        let least = (f64::from(options.least_evidence) * energy).max(LEAST_GAIN * objective);
        let room = most - fit.atoms.len();
        if !add_batch(&mut fit, &candidates, &mut refused, room.min(BATCH), least, cancel)? {
            break;
        }
        fit.refit();
        for _ in 0..2 {
            for group in groups(&fit) {
                descend(&mut fit, &group, 3);
            }
            fit.refit();
        }
        merge(&mut fit, least, cancel)?;
        prune(&mut fit, least, cancel)?;
        if fit.objective() > 0.995 * objective {
            break;
        }
    }
    Some(fit.atoms)
}

/// Adds the sources that explain most of the residual; false where there are none.
fn add_batch(
    fit: &mut Fit,
    candidates: &Candidates,
    refused: &mut [bool],
    most: usize,
    least: f64,
    cancel: &AtomicBool,
) -> Option<bool> {
    let taken = |source: &Source| fit.atoms.iter().any(|atom| same(&atom.source, source));
    let ranked = rank(fit, candidates, |number| refused[number] || taken(&candidates.all[number].source));
    let best = ranked.first().map_or(0.0, |&(gain, _)| gain);
    let mut trials: Vec<Trial> = Vec::new();
    for &(gain, number) in &ranked {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        if trials.len() == most || gain < least || (gain < 0.1 * best && !trials.is_empty()) {
            break;
        }
        let candidate = &candidates.all[number];
        let apart = |trial: &Trial| {
            likeness(fit, &trial.column, &candidate.column) < ALIKE && !same(&trial.source, &candidate.source)
        };
        if !trials.iter().all(apart) {
            continue;
        }
        let trial = Trial::new(fit, &fit.residual, candidate.source);
        let trial = match candidate.source {
            Source::Sun { .. } => aim_sun(fit, &fit.residual, trial, 0.15, 8),
            _ => search(fit, &fit.residual, trial, 0.5 * candidates.spacing, 3),
        };
        if taken(&trial.source) || !is_told(fit, &trial.source, &trial.column) {
            refused[number] = true;
        } else {
            trials.push(trial);
        }
    }
    let any = !trials.is_empty();
    fit.atoms.extend(trials.into_iter().map(Trial::into_atom));
    Some(any)
}

/// Candidates by how much of the residual they explain, most first.
fn rank(fit: &Fit, candidates: &Candidates, out: impl Fn(usize) -> bool) -> Vec<(f64, usize)> {
    let score = |number: usize| {
        let candidate = &candidates.all[number];
        fit.gain(&candidate.column, &fit.residual).0 * f64::from(candidate.preference)
    };
    let mut ranked: Vec<(f64, usize)> = (0..candidates.all.len())
        .filter(|&number| !out(number))
        .map(|number| (score(number), number))
        .collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    ranked
}

/// One source cannot stand beside the other: a sun's neighbours only make up for how its light ends.
fn same(one: &Source, other: &Source) -> bool {
    match (one, other) {
        (Source::Sun { direction, .. }, Source::Sun { direction: away, .. }) => {
            direction.dot(*away) > SUNS_APART.cos()
        }
        _ => one == other,
    }
}

/// Moves all sources once.
fn relocate(fit: &mut Fit, sweep: u32, cancel: &AtomicBool) -> Option<()> {
    for number in 0..fit.atoms.len() {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        if sweep.is_multiple_of(2) {
            // The finer samples see the edges of a sun's light better.
            aim(fit, number, 0.04 / (1 << sweep) as f32, 6);
        }
    }
    for group in groups(fit) {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        descend(fit, &group, 5);
    }
    fit.refit();
    Some(())
}

/// Takes the bounces that leave less.
fn choose_bounces(fit: &mut Fit, gathered: &Gathered) {
    fit.set_bounces(Bounces::First, gathered);
    let first = fit.objective();
    fit.set_bounces(Bounces::All, gathered);
    if first < fit.objective() {
        fit.set_bounces(Bounces::First, gathered);
    }
}
