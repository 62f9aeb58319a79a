//! The view as a consensus: what most of the world agrees on.
//!
//! An object that stands still says where the camera is: V = E M⁻¹, with E its matrix now (object to eye) and M its place
//! in the world. Each object makes such a proposal as if it stood still; those that do are alike. A proposal weighs as
//! much as what agrees with it reaches in space and over the screen, and as there are different meshes: by numbers of
//! vertices a chase camera's car outweighs the world.

use std::cmp::Ordering;

use glam::{DMat3, DMat4, DVec2, DVec3};
use hashbrown::HashSet;

use crate::matrix;

/// Proposals that are compared.
const MOST_PROPOSALS: usize = 24;
/// Pixels within which a position is where it should be.
pub const TOLERANCE: f64 = 0.5;
/// Pixels within which witnesses are so close that their mean is better than each.
const CLOSE: f64 = 0.05;
/// Pixels within which two proposals are one.
const SAME: f64 = 1.0;

/// Share of what is trusted that settles the matter.
const ENOUGH: f64 = 0.7;

/// An object as a witness.
#[derive(Debug, Clone)]
pub struct Witness<'a> {
    /// Vertices, object space.
    pub samples: &'a [glam::Vec3],
    /// Object to eye space, now.
    pub eye: &'a DMat4,
    /// Object to world space, as it was.
    pub model: &'a DMat4,
    /// Names its mesh.
    pub mesh: u64,
    /// It has stood still for some frames.
    pub is_trusted: bool,
}

impl Witness<'_> {
    fn proposal(&self) -> Option<DMat4> {
        let view = *self.eye * self.model.inverse();
        matrix::similarity(view).filter(|s| s.scale == 1.0).map(|s| s.rigid)
    }

    fn agrees(&self, view: DMat4, focal: f64, pixels: f64) -> bool {
        agrees(self.samples, view * *self.model, *self.eye, focal, pixels)
    }

    /// Largest distance of where a view puts it from where it is, pixels.
    pub fn error(&self, view: DMat4, focal: f64) -> f64 {
        error(self.samples, view * *self.model, *self.eye, focal)
    }
}

/// The largest distance between positions under two matrices, as it shows on screen: pixels. `focal` is how many pixels a
/// unit at distance one takes.
pub fn error(samples: &[glam::Vec3], a: DMat4, b: DMat4, focal: f64) -> f64 {
    samples.iter().fold(0.0, |worst: f64, sample| {
        let sample = sample.as_dvec3();
        let (a, b) = (a.transform_point3(sample), b.transform_point3(sample));
        let shown = a.distance(b) * focal / b.length().max(1e-9);
        // What is not a number agrees with nothing.
        if shown.is_nan() { f64::INFINITY } else { worst.max(shown) }
    })
}

/// Whether positions are the same on screen under two matrices, within so many pixels.
pub fn agrees(samples: &[glam::Vec3], a: DMat4, b: DMat4, focal: f64, pixels: f64) -> bool {
    samples.iter().all(|sample| {
        let sample = sample.as_dvec3();
        let (a, b) = (a.transform_point3(sample), b.transform_point3(sample));
        // What is not a number agrees with nothing.
        a.distance_squared(b) * focal * focal <= pixels * pixels * b.length_squared().max(1e-18)
    })
}

/// What is known besides the witnesses.
#[derive(Debug, Clone, Copy)]
pub struct Prior {
    /// The view of the frame before.
    pub view: DMat4,
    /// The matrix that most is drawn under, made rigid, where that has been the view so far.
    pub base: Option<DMat4>,
    /// How many pixels a unit at distance one takes.
    pub focal: f64,
}

/// A view, and what speaks for it.
#[derive(Debug, Clone)]
struct Candidate {
    view: DMat4,
    weight: f64,
    trusted: f64,
    supporters: Vec<usize>,
}

/// Finds the view on which witnesses agree; nothing where there is none.
pub fn find(witnesses: &[Witness], prior: &Prior) -> Option<DMat4> {
    let extents: Vec<f64> = witnesses.iter().map(extent).collect();
    let trusted =
        witnesses.iter().zip(&extents).filter(|(w, _)| w.is_trusted).map(|(_, extent)| extent).sum();
    let all: f64 = extents.iter().sum();
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut proposals =
        Proposals { witnesses, extents: &extents, prior, order: Vec::new(), asked: 0, made: Vec::new() };
    while let Some(view) = proposals.next() {
        let candidate = support(witnesses, &extents, view, prior);
        // What most of the world says, and of what is trusted, needs no rival to be compared with.
        let reach: f64 = candidate.supporters.iter().map(|index| extents[*index]).sum();
        if candidate.trusted > ENOUGH * trusted && 2.0 * reach > all {
            return Some(refine(witnesses, &extents, &candidate, prior));
        }
        candidates.push(candidate);
    }
    candidates.retain(|candidate| !candidate.supporters.is_empty());
    candidates.iter_mut().for_each(|candidate| candidate.weight = weight(witnesses, candidate));
    let chosen = choose(&candidates, trusted, prior)?;
    Some(refine(witnesses, &extents, chosen, prior))
}

/// Different views that witnesses propose, heaviest first: made one by one, for mostly the first will do.
struct Proposals<'a> {
    witnesses: &'a [Witness<'a>],
    extents: &'a [f64],
    prior: &'a Prior,
    /// Witnesses, what says most first: the first one, or all of them once more were needed.
    order: Vec<usize>,
    /// How many of them were asked.
    asked: usize,
    made: Vec<DMat4>,
}

impl Proposals<'_> {
    fn next(&mut self) -> Option<DMat4> {
        if self.made.is_empty() && self.asked == 0 && self.prior.base.is_some() {
            self.made.extend(self.prior.base);
            return self.prior.base;
        }
        while self.made.len() < MOST_PROPOSALS {
            let witness = &self.witnesses[self.witness()?];
            let is_known = |view: &DMat4| witness.agrees(*view, self.prior.focal, SAME * TOLERANCE);
            if self.made.iter().any(is_known) {
                continue;
            }
            if let Some(view) = witness.proposal() {
                self.made.push(view);
                return Some(view);
            }
        }
        None
    }

    /// The witness to ask next.
    fn witness(&mut self) -> Option<usize> {
        let by_weight = |a: &usize, b: &usize| {
            let trusted = self.witnesses[*b].is_trusted.cmp(&self.witnesses[*a].is_trusted);
            trusted.then(self.extents[*b].total_cmp(&self.extents[*a])).then(a.cmp(b))
        };
        let all = 0..self.witnesses.len();
        match self.asked {
            0 => self.order = all.min_by(by_weight).into_iter().collect(),
            1 => {
                self.order = all.collect();
                self.order.sort_by(by_weight);
            }
            _ => {}
        }
        self.asked += 1;
        self.order.get(self.asked - 1).copied()
    }
}

/// A view with the witnesses that agree with it, not weighed yet.
fn support(witnesses: &[Witness], extents: &[f64], view: DMat4, prior: &Prior) -> Candidate {
    let mut candidate = Candidate { view, weight: 0.0, trusted: 0.0, supporters: Vec::new() };
    for (index, witness) in witnesses.iter().enumerate() {
        if witness.agrees(view, prior.focal, TOLERANCE) {
            candidate.supporters.push(index);
            candidate.trusted += if witness.is_trusted { extents[index] } else { 0.0 };
        }
    }
    candidate
}

/// How much what agrees with a view reaches, and how many meshes there are of it.
fn weight(witnesses: &[Witness], candidate: &Candidate) -> f64 {
    let (mut space, mut screen) = (Span::<3>::default(), Span::<2>::default());
    let mut meshes = HashSet::new();
    for witness in candidate.supporters.iter().map(|index| &witnesses[*index]) {
        meshes.insert(witness.mesh);
        for sample in witness.samples {
            let seen = witness.eye.transform_point3(sample.as_dvec3());
            space.add(seen.to_array());
            // By directions, so that what is behind the eye counts as well.
            let direction = seen.normalize_or_zero();
            screen.add([direction.x, direction.y]);
        }
    }
    let shown = DVec2::from_array(screen.sides()).length() / 8f64.sqrt();
    DVec3::from_array(space.sides()).length() * (meshes.len() as f64).sqrt() * (0.1 + shown)
}

/// The candidate that is the camera; `trusted` is what all trusted witnesses reach.
fn choose<'a>(candidates: &'a [Candidate], trusted: f64, prior: &Prior) -> Option<&'a Candidate> {
    let weight = |c: &Candidate| {
        let faith = if trusted > 0.0 { 1.0 + 8.0 * c.trusted / trusted } else { 1.0 };
        c.weight * faith
    };
    let best = candidates.iter().max_by(|a, b| weight(a).total_cmp(&weight(b)))?;
    if trusted > 0.0 && best.trusted > ENOUGH * trusted {
        return Some(best);
    }
    // What did not move is attached to the camera if something large moved as one; what only turned is the sky if
    // something else turned alike and passed by.
    let others = candidates.iter().filter(|other| !std::ptr::eq(*other, best));
    let rival = match relation(best.view, prior) {
        Relation::Rests => others
            .filter(|other| {
                weight(other) > 0.2 * weight(best) && relation(other.view, prior) != Relation::Rests
            })
            .max_by(|a, b| weight(a).total_cmp(&weight(b))),
        Relation::Turns => others
            .filter(|other| weight(other) > 0.02 * weight(best) && turned_alike(other.view, best.view))
            .max_by(|a, b| weight(a).total_cmp(&weight(b))),
        Relation::Moves => None,
    };
    Some(rival.unwrap_or(best))
}

/// How a view relates to the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Relation {
    Rests,
    Turns,
    Moves,
}

fn relation(view: DMat4, prior: &Prior) -> Relation {
    let eye = |view: DMat4| matrix::rigid_inverse(view).col(3).truncate();
    let step = eye(view).distance(eye(prior.view));
    let reach = eye(view).length().max(eye(prior.view).length()).max(1e-6);
    match (turned_alike(view, prior.view), step <= 1e-6 * reach) {
        (true, true) => Relation::Rests,
        (false, true) => Relation::Turns,
        _ => Relation::Moves,
    }
}

/// Whether two views look the same way, to a ten-thousandth of a radian.
pub fn turned_alike(a: DMat4, b: DMat4) -> bool {
    let (a, b) = (DMat3::from_mat4(a), DMat3::from_mat4(b));
    [0, 1, 2].iter().all(|&i| a.col(i).abs_diff_eq(b.col(i), 1e-4))
}

/// The view as exactly as its supporters tell: those in world coordinates tell it without an error of ours, else the
/// mean of all.
fn refine(witnesses: &[Witness], extents: &[f64], chosen: &Candidate, prior: &Prior) -> DMat4 {
    let of = |index: &usize| &witnesses[*index];
    let exact = chosen.supporters.iter().filter(|i| *of(i).model == DMat4::IDENTITY);
    if let Some(best) = exact.max_by(|a, b| extents[**a].total_cmp(&extents[**b]).then(b.cmp(a))) {
        return matrix::orthonormal(*of(best).eye);
    }
    // What moves slowly agrees as well, but not as closely as what stands still.
    let rank = |i: usize| (witnesses[i].is_trusted, extents[i]);
    let by_rank =
        |a: &&usize, b: &&usize| rank(**a).partial_cmp(&rank(**b)).unwrap_or(Ordering::Equal).then(b.cmp(a));
    let best = chosen.supporters.iter().max_by(by_rank).and_then(|best| of(best).proposal());
    let best = best.unwrap_or(chosen.view);
    let mut sum = DMat4::ZERO;
    for index in &chosen.supporters {
        let weight = extents[*index];
        let close = of(index).agrees(best, prior.focal, CLOSE);
        if let Some(view) = of(index).proposal().filter(|_| close && weight > 0.0) {
            sum += view * weight;
        }
    }
    let total = sum.w_axis.w;
    let mean = matrix::orthonormal(sum * (1.0 / total));
    if total > 0.0 && mean.is_finite() { mean } else { best }
}

/// Diagonal of a witness's box in eye space.
fn extent(witness: &Witness) -> f64 {
    let mut span = Span::<3>::default();
    for sample in witness.samples {
        span.add(witness.eye.transform_point3(sample.as_dvec3()).to_array());
    }
    DVec3::from_array(span.sides()).length()
}

/// The box around points.
struct Span<const N: usize> {
    least: [f64; N],
    most: [f64; N],
}

impl<const N: usize> Default for Span<N> {
    fn default() -> Self {
        Span { least: [f64::INFINITY; N], most: [f64::NEG_INFINITY; N] }
    }
}

impl<const N: usize> Span<N> {
    fn add(&mut self, point: [f64; N]) {
        for ((least, most), at) in self.least.iter_mut().zip(&mut self.most).zip(point) {
            *least = least.min(at);
            *most = most.max(at);
        }
    }

    fn sides(&self) -> [f64; N] {
        std::array::from_fn(|axis| (self.most[axis] - self.least[axis]).max(0.0))
    }
}
