//! Where sources may be: emitters, the sky and suns in it, points on a grid in free space.

use crate::column::{Optics, point_factor};
use crate::random::{direction, hash, unit};
use crate::types::{Baked, Falloff, FalloffModel, Source};
use glam::Vec3;
use std::sync::atomic::{AtomicBool, Ordering};

/// A source that may be, with its form factors.
pub(crate) struct Candidate {
    pub source: Source,
    pub column: Vec<f32>,
    /// Its gain counts this much.
    pub preference: f32,
}

/// How much is tried.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// About how many points.
    pub points: usize,
    /// Directions over the sphere.
    pub suns: usize,
    /// Emitters, those given first.
    pub emitters: usize,
}

/// Candidates and how far apart the points are.
pub(crate) struct Candidates {
    pub all: Vec<Candidate>,
    pub spacing: f32,
}

/// Nearest samples that are asked whether they see a point.
const WITNESSES: usize = 12;
/// Distance, in sizes of the world, within which a point light grows no brighter.
const CLAMP: f32 = 2e-3;
/// Reaches of linear lights to begin with, in sizes of the world.
const REACHES: [f32; 3] = [0.12, 0.3, 0.8];

/// All that can shine on some sample; None where it was cancelled.
pub(crate) fn candidates(
    optics: &Optics,
    baked: &Baked,
    falloff: FalloffModel,
    extent: Extent,
    cancel: &AtomicBool,
) -> Option<Candidates> {
    let (places, spacing) = free_points(optics, extent.points, cancel)?;
    let radius = CLAMP * optics.world.size;
    let reaches: Vec<Falloff> = match falloff {
        FalloffModel::Linear => {
            REACHES.map(|reach| Falloff::Linear { reach: reach * optics.world.size }).to_vec()
        }
        _ => vec![Falloff::InverseSquare],
    };
    let points = places.iter().flat_map(|&position| {
        reaches.iter().map(move |&falloff| (Source::Point { position, radius, falloff }, 1.0))
    });
    let mut sources: Vec<(Source, f32)> = points.collect();
    let emitters = baked.emitters.iter().enumerate().take(extent.emitters);
    let emitters = emitters.filter(|&(i, _)| !optics.panels[i].is_empty());
    let preference = |p: f32| if p.is_finite() { p.clamp(0.0, 16.0) } else { 1.0 };
    sources.extend(emitters.map(|(emitter, e)| (Source::Area { emitter }, preference(e.preference))));
    if optics.world.has_sky() {
        sources.push((Source::Sky, 1.0));
        let suns = (0..extent.suns).map(|i| direction(i, extent.suns));
        sources.extend(suns.map(|direction| (Source::Sun { direction, angular_radius: 0.0 }, 1.0)));
    }
    let mut all = Vec::new();
    for (source, preference) in sources {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        let column = optics.column(&source);
        if column.iter().any(|&factor| factor > 0.0) {
            all.push(Candidate { source, column, preference });
        }
    }
    Some(Candidates { all, spacing })
}

/// About `wanted` points that some sample sees, on a jittered grid, and its spacing. A sample's normal is to its lit
/// side: what no sample sees is inside something, or does not matter.
fn free_points(optics: &Optics, wanted: usize, cancel: &AtomicBool) -> Option<(Vec<Vec3>, f32)> {
    let bounds = optics.samples.bounds();
    let extent = bounds.extent().max(Vec3::splat(bounds.extent().max_element() * 1e-2));
    let mut spacing = (extent.x * extent.y * extent.z / wanted.max(1) as f32).cbrt();
    let mut points = Vec::new();
    // How much of the box is free is not known beforehand.
    for _ in 0..3 {
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Some((Vec::new(), 0.0));
        }
        points = grid(bounds.min, extent, spacing, optics.seed);
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        points.retain(|&point| is_seen(optics, point));
        let ratio = points.len().max(1) as f32 / wanted.max(1) as f32;
        if (0.6..1.2).contains(&ratio) {
            break;
        }
        spacing *= ratio.cbrt().clamp(0.5, 1.5);
    }
    Some((points, spacing))
}

/// Most cells along an axis.
const MOST_CELLS: f32 = 64.0;

fn grid(min: Vec3, extent: Vec3, spacing: f32, seed: u64) -> Vec<Vec3> {
    let cells = (extent / spacing).round().clamp(Vec3::ONE, Vec3::splat(MOST_CELLS));
    let [nx, ny, nz] = cells.to_array().map(|n| n as u64);
    let point = |i: u64| {
        let at = Vec3::new((i % nx) as f32, (i / nx % ny) as f32, (i / nx / ny) as f32);
        let jitter = |axis: u64| 0.5 + 0.5 * (unit(hash(seed, 3 * i + axis)) - 0.5);
        min + (at + Vec3::new(jitter(0), jitter(1), jitter(2))) / cells * extent
    };
    (0..nx * ny * nz).map(point).collect()
}

fn is_seen(optics: &Optics, point: Vec3) -> bool {
    let samples = optics.samples;
    let mut nearest = [(f32::INFINITY, 0usize); WITNESSES];
    for i in 0..samples.len() {
        let squared = samples.position[i].distance_squared(point);
        if squared < nearest[WITNESSES - 1].0
            && point_factor(samples.normal[i], point - samples.position[i], 0.0, Falloff::InverseSquare) > 0.0
        {
            let place = nearest.partition_point(|&(other, _)| other <= squared);
            nearest[place..].rotate_right(1);
            nearest[place] = (squared, i);
        }
    }
    let mut witnesses = nearest.iter().filter(|(squared, _)| squared.is_finite());
    witnesses.any(|&(_, i)| optics.world.visible(optics.origin(i), point))
}
