//! Fewer sources that explain as much.

use crate::descend::descend;
use crate::fit::{Atom, Fit, triple};
use crate::types::Source;
use std::sync::atomic::{AtomicBool, Ordering};

/// Points whose form factors are more alike than this (cosine) may be one.
const ONE: f64 = 0.7;
/// One may leave more than two by this power of their likeness, as a share of what is left about them: beside a shadow's
/// edge, of which a patch has a part, two always fit better, but what is nearly alike is more likely one.
const SIMPLER: i32 = 12;
/// Weak sources that are tried before a round of dropping ends.
const MOST_TRIED: usize = 8;

/// Powers to go back to.
struct Before {
    powers: Vec<[f64; 3]>,
    ambient: [f64; 3],
    bounce: [f64; 3],
}

impl Before {
    fn of(fit: &Fit) -> Self {
        let powers = fit.atoms.iter().map(|atom| atom.power).collect();
        Self { powers, ambient: fit.ambient, bounce: fit.bounce }
    }

    fn restore(self, fit: &mut Fit) {
        for (atom, power) in fit.atoms.iter_mut().zip(self.powers) {
            atom.power = power;
        }
        (fit.ambient, fit.bounce) = (self.ambient, self.bounce);
        fit.refit();
    }
}

/// The cosine between two columns.
pub(crate) fn likeness(fit: &Fit, a: &[f32], b: &[f32]) -> f64 {
    let weight = &fit.optics.samples.weight;
    let squares = triple(weight, a, a) * triple(weight, b, b);
    if squares > 0.0 { triple(weight, a, b) / squares.sqrt() } else { 0.0 }
}

/// Enough samples tell of a point that it is not there for the error of one.
pub(crate) fn is_told(fit: &Fit, source: &Source, column: &[f32]) -> bool {
    !matches!(source, Source::Point { .. }) || fit.witnesses(column) >= fit.optics.least_witnesses
}

/// Joins pairs of points where one, moved to its best place, leaves at most `least` more: a light that was first put in a wrong
/// place gathers others about it, each making up for some of the error. None where it was cancelled.
pub(crate) fn merge(fit: &mut Fit, least: f64, cancel: &AtomicBool) -> Option<()> {
    let mut first = 0;
    while first < fit.atoms.len() {
        let mut second = first + 1;
        while second < fit.atoms.len() {
            if cancel.load(Ordering::Relaxed) {
                return None;
            }
            let alike = likeness(fit, &fit.atoms[first].column, &fit.atoms[second].column);
            let source = middle(fit, first, second).filter(|_| alike > ONE);
            let joined = source.is_some_and(|source| {
                let about = fit.objective_about(&[first, second]);
                join(fit, first, second, source, least.max(about * alike.powi(SIMPLER)))
            });
            second += usize::from(!joined);
        }
        first += 1;
    }
    Some(())
}

/// The point between two, nearer to the stronger.
fn middle(fit: &Fit, first: usize, second: usize) -> Option<Source> {
    let (one, other) = (&fit.atoms[first], &fit.atoms[second]);
    let Source::Point { position, radius, falloff } = one.source else {
        return None;
    };
    let Source::Point { position: away, .. } = other.source else {
        return None;
    };
    let sum = |atom: &Atom| atom.power.iter().sum::<f64>();
    let share = (sum(other) / (sum(one) + sum(other))) as f32;
    let position = position.lerp(away, share);
    position.is_finite().then_some(Source::Point { position, radius, falloff })
}

fn join(fit: &mut Fit, first: usize, second: usize, source: Source, least: f64) -> bool {
    let objective = fit.objective();
    let before = Before::of(fit);
    let column = fit.optics.column(&source);
    let old = fit.atoms.remove(second);
    let power = std::array::from_fn(|c| fit.atoms[first].power[c] + old.power[c]);
    let former = std::mem::replace(&mut fit.atoms[first], Atom { source, column, power });
    fit.refit();
    descend(fit, &[first], 8);
    fit.refit();
    if fit.objective() <= objective + least {
        return true;
    }
    fit.atoms[first] = former;
    fit.atoms.insert(second, old);
    before.restore(fit);
    false
}

/// Drops, weakest first, the sources without which the objective grows by less than `least`. None where it was
/// cancelled.
pub(crate) fn prune(fit: &mut Fit, least: f64, cancel: &AtomicBool) -> Option<()> {
    let told: Vec<bool> = fit.atoms.iter().map(|atom| is_told(fit, &atom.source, &atom.column)).collect();
    let mut told = told.into_iter();
    fit.atoms.retain(|atom| told.next() == Some(true) && atom.power != [0.0; 3]);
    fit.refit();
    loop {
        if cancel.load(Ordering::Relaxed) {
            return None;
        }
        let limit = fit.objective() + least;
        let mut ranked: Vec<(f64, usize)> =
            (0..fit.atoms.len()).map(|number| (fit.objective_without(number), number)).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // Others may take over, which only a refit tells; it is worth that only for those that seem weak.
        let weak = ranked.iter().take(MOST_TRIED).filter(|&&(left, _)| left < limit + 64.0 * least);
        if !weak.map(|&(_, number)| number).any(|number| drop_if_idle(fit, number, limit)) {
            return Some(());
        }
    }
}

/// Drops a source where the others, fitted anew, reach `limit`.
fn drop_if_idle(fit: &mut Fit, number: usize, limit: f64) -> bool {
    let before = Before::of(fit);
    let atom = fit.atoms.remove(number);
    fit.refit();
    if fit.objective() <= limit {
        return true;
    }
    fit.atoms.insert(number, atom);
    before.restore(fit);
    false
}
