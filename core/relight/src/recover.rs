//! The search: sources are added one after the other where they explain most, and moved to where they explain
//! more (Boyd, Schiebinger and Recht, The Alternating Descent Conditional Gradient Method for Sparse Inverse Problems,
//! SIAM Journal on Optimization 27(2), 2017).
//!
//! A coarse subset of the patches decides which sources there are; all patches decide where they are and how strong.

use crate::candidates::{Candidates, Extent, candidates};
use crate::column::{Optics, Panel};
use crate::fit::{Atom, Fit};
use crate::gather::{Gathered, gather};
use crate::reduce::{likeness, merge, prune};
use crate::refine::{Trial, descend, search};
use crate::report::report;
use crate::samples::{Samples, pick};
use crate::types::{Baked, FalloffModel, Found, Options, Source};
use crate::world::World;
use std::sync::atomic::{AtomicBool, Ordering};

/// Relative residual below which no other falloff is tried.
const GOOD: f32 = 0.05;
/// A source explains at least this share of what the others leave.
const LEAST_GAIN: f64 = 0.02;
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
    let effort = Effort::of(options.rays);
    let gathered = gather(&world, &samples, effort.hemisphere, options.seed, cancel)?;
    let panels: Vec<Panel> = baked.emitters.iter().map(Panel::new).collect();
    let atoms = choose(
        baked,
        options,
        &effort,
        Scene { world: &world, samples: &samples, panels: &panels, gathered: &gathered },
        cancel,
    )?;

    let all: Vec<usize> = (0..samples.len()).collect();
    let optics = Optics {
        world: &world,
        samples: &samples,
        panels: &panels,
        sky: gathered.sky.clone(),
        area_rays: effort.area_rays,
        seed: options.seed,
    };
    let mut fit = Fit::new(&optics, &gathered, &all);
    settle(&mut fit, atoms, options, &effort, cancel)?;
    Some(report(baked, &samples, Some(&fit), world.rays()))
}

/// What was made of the input.
#[derive(Clone, Copy)]
struct Scene<'a> {
    world: &'a World,
    samples: &'a Samples,
    panels: &'a [Panel],
    gathered: &'a Gathered,
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
    /// How often all sources are moved in the end.
    sweeps: u32,
}

impl Effort {
    fn of(rays: u64) -> Self {
        // Candidates and the samples that judge them grow alike.
        let scale = (rays as f64 / 8e6).sqrt().clamp(0.1, 3.0);
        let part = |full: f64| (full * scale) as usize;
        Self {
            coarse: part(1024.0).max(256),
            hemisphere: (96.0 * scale).clamp(48.0, 192.0) as u32,
            area_rays: (16.0 * scale).clamp(4.0, 32.0) as u32,
            extent: Extent { points: part(1400.0), suns: part(1000.0), emitters: part(256.0) },
            sweeps: if scale < 0.5 { 2 } else { 4 },
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
        area_rays: effort.area_rays.div_ceil(2),
        seed: options.seed,
    };
    let candidates = candidates(&optics, baked, options.falloff, effort.extent, cancel)?;
    let mut fit = Fit::new(&optics, scene.gathered, &kept);
    let energy = fit.energy();
    while fit.atoms.len() < options.max_sources {
        let objective = fit.objective();
        let least = (f64::from(options.least_evidence) * energy).max(LEAST_GAIN * objective);
        let room = options.max_sources - fit.atoms.len();
        let added = add_batch(&mut fit, &candidates, room.min(BATCH), least, cancel)?;
        if added == 0 {
            break;
        }
        fit.refit();
        for _ in 0..2 {
            for number in 0..fit.atoms.len() {
                descend(&mut fit, number, 3);
            }
            fit.refit();
        }
        merge(&mut fit, least, cancel)?;
        prune(&mut fit, least);
        if fit.objective() > 0.995 * objective {
            break;
        }
    }
    Some(fit.atoms)
}

/// Adds the sources that explain most of the residual; returns how many.
fn add_batch(
    fit: &mut Fit,
    candidates: &Candidates,
    most: usize,
    least: f64,
    cancel: &AtomicBool,
) -> Option<usize> {
    let score = |number: usize| {
        let candidate = &candidates.all[number];
        fit.gain(&candidate.column, &fit.residual).0 * f64::from(candidate.preference)
    };
    let taken = |source: &Source| fit.atoms.iter().any(|atom| atom.source == *source);
    let mut ranked: Vec<(f64, usize)> = (0..candidates.all.len())
        .filter(|&number| !taken(&candidates.all[number].source))
        .map(|number| (score(number), number))
        .collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let best = ranked.first().map_or(0.0, |&(gain, _)| gain);
    let mut trials: Vec<Trial> = Vec::new();
    for &(gain, number) in &ranked {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        if trials.len() == most || gain < least || gain < 0.1 * best {
            break;
        }
        let candidate = &candidates.all[number];
        let apart = |trial: &Trial| likeness(fit, &trial.column, &candidate.column) < ALIKE;
        if trials.iter().all(apart) {
            let trial = Trial::new(fit, &fit.residual, candidate.source);
            let (step, halvings) = match candidate.source {
                Source::Sun { .. } => (0.06, 6),
                _ => (0.5 * candidates.spacing, 3),
            };
            trials.push(search(fit, &fit.residual, trial, step, halvings));
        }
    }
    let added = trials.len();
    fit.atoms.extend(trials.into_iter().map(Trial::into_atom));
    Some(added)
}

/// Fits the chosen sources to all samples: moves them, joins those that are one, drops those that are none.
fn settle(
    fit: &mut Fit,
    atoms: Vec<Atom>,
    options: &Options,
    effort: &Effort,
    cancel: &AtomicBool,
) -> Option<()> {
    for atom in atoms {
        let column = fit.optics.column(&atom.source);
        fit.atoms.push(Atom { column, ..atom });
    }
    fit.refit();
    for sweep in 0..effort.sweeps {
        for number in 0..fit.atoms.len() {
            if cancel.load(Ordering::Relaxed) {
                return None;
            }
            aim(fit, number, sweep);
            descend(fit, number, 4);
        }
        fit.refit();
        let least = (f64::from(options.least_evidence) * fit.energy()).max(LEAST_GAIN * fit.objective());
        merge(fit, least, cancel)?;
        prune(fit, least);
        fit.distrust();
        fit.refit();
    }
    Some(())
}

/// Suns are aimed anew: the finer samples see the edges of their light better.
fn aim(fit: &mut Fit, number: usize, sweep: u32) {
    if matches!(fit.atoms[number].source, Source::Sun { .. }) {
        let residual = fit.residual_without(number);
        let trial = Trial::new(fit, &residual, fit.atoms[number].source);
        let best = search(fit, &residual, trial, 0.01 / (1 << sweep) as f32, 3);
        fit.replace(number, best.into_atom());
    }
}
