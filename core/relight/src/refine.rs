//! The other half: where a source is, its neighbours being known.

use crate::fit::{Atom, Fit};
use crate::random::{hash, spread};
use crate::types::{Falloff, Source};
use glam::Vec3;

/// A source, how much of a residual it would explain, and with which powers.
pub(crate) struct Trial {
    pub source: Source,
    pub column: Vec<f32>,
    pub gain: f64,
    pub power: [f64; 3],
}

impl Trial {
    pub fn new(fit: &Fit, residual: &[Vec<f32>; 3], source: Source) -> Self {
        let column = fit.optics.column(&source);
        let (gain, power) = fit.gain(&column, residual);
        Self { source, column, gain, power }
    }

    pub fn into_atom(self) -> Atom {
        Atom { source: self.source, column: self.column, power: self.power }
    }
}

/// Looks about a point light for a place that explains more, by steps that halve `halvings` times: from a grid's point it
/// may be far.
pub(crate) fn search(
    fit: &Fit,
    residual: &[Vec<f32>; 3],
    mut best: Trial,
    mut step: f32,
    halvings: u32,
) -> Trial {
    for _ in 0..halvings {
        // Uphill for as long as the step helps, but not for ever.
        for _ in 0..4 {
            let before = best.gain;
            for moved in neighbours(&best.source, step) {
                let trial = Trial::new(fit, residual, moved);
                if trial.gain > best.gain {
                    best = trial;
                }
            }
            if best.gain <= before * 1.001 {
                break;
            }
        }
        step *= 0.5;
    }
    best
}

fn neighbours(source: &Source, step: f32) -> Vec<Source> {
    match *source {
        Source::Point { position, radius, falloff } => {
            let moved = Vec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
            let moved = moved.map(|way| Source::Point { position: position + way * step, radius, falloff });
            moved.chain(reaches(source)).collect()
        }
        _ => Vec::new(),
    }
}

/// Other reaches of a linear light.
fn reaches(source: &Source) -> Vec<Source> {
    match *source {
        Source::Point { position, radius, falloff: Falloff::Linear { reach } } => [0.8, 1.25]
            .map(|f| Source::Point { position, radius, falloff: Falloff::Linear { reach: reach * f } })
            .to_vec(),
        _ => Vec::new(),
    }
}

/// Directions that are tried in each cone.
const CONE: u32 = 32;

/// Looks about a sun for a direction that explains more, in cones that narrow `halvings` times from `angle` (radians) on.
/// What tells a sun's direction is where its light ends, patch by patch: full of local optima, without a gradient.
pub(crate) fn aim_sun(
    fit: &Fit,
    residual: &[Vec<f32>; 3],
    mut best: Trial,
    mut angle: f32,
    halvings: u32,
) -> Trial {
    for narrowing in 0..halvings {
        let Source::Sun { direction, angular_radius } = best.source else {
            return best;
        };
        let (tangent, bitangent) = direction.any_orthonormal_pair();
        for place in 0..CONE {
            let square = spread(place, hash(fit.optics.seed, u64::from(narrowing)));
            let (across, turn) = (angle * square.x.sqrt(), square.y * std::f32::consts::TAU);
            let aside = tangent * turn.cos() + bitangent * turn.sin();
            let direction = (direction + aside * across).normalize();
            let trial = Trial::new(fit, residual, Source::Sun { direction, angular_radius });
            if trial.gain > best.gain {
                best = trial;
            }
        }
        angle *= 0.6;
    }
    best
}

/// Aims atom `number` anew if it is a sun; see [`aim_sun`].
pub(crate) fn aim(fit: &mut Fit, number: usize, angle: f32, halvings: u32) {
    if matches!(fit.atoms[number].source, Source::Sun { .. }) {
        let residual = fit.residual_without(number);
        let trial = Trial::new(fit, &residual, fit.atoms[number].source);
        let best = aim_sun(fit, &residual, trial, angle, halvings);
        fit.replace(number, best.into_atom());
    }
}
