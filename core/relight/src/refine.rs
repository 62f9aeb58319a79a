//! The other half: where a source is, its neighbours being known.

use crate::column::{Optics, point_gradient};
use crate::fit::{Atom, Fit};
use crate::random::{hash, spread};
use crate::types::{Falloff, Source};
use glam::{Vec3, Vec4};

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
        // Downhill for as long as the step helps, but not for ever.
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

/// Moves point `number` by at most `steps` steps of Levenberg and Marquardt's method, visibility being taken as it is in
/// each; true where it moved. Position, reach and powers are one step's unknowns.
pub(crate) fn descend(fit: &mut Fit, number: usize, steps: u32) -> bool {
    if !matches!(fit.atoms[number].source, Source::Point { .. }) {
        return false;
    }
    let residual = fit.residual_without(number);
    let mut damping = 1e-3;
    let mut moved = false;
    let (mut gain, _) = fit.gain(&fit.atoms[number].column, &residual);
    for _ in 0..steps {
        let Some(source) = proposal(fit, &residual, number, damping) else {
            break;
        };
        let trial = Trial::new(fit, &residual, source);
        if trial.gain > gain {
            let enough = trial.gain < gain * 1.0002;
            gain = trial.gain;
            damping *= 0.2;
            moved = true;
            fit.replace(number, trial.into_atom());
            if enough {
                break;
            }
        } else {
            damping *= 16.0;
        }
    }
    moved
}

/// Unknowns of a step: three of position, the reach, three powers.
const UNKNOWNS: usize = 7;

/// Where the linearised problem puts the point.
fn proposal(fit: &Fit, residual: &[Vec<f32>; 3], number: usize, damping: f64) -> Option<Source> {
    let atom = &fit.atoms[number];
    let Source::Point { position, radius, falloff } = atom.source else {
        return None;
    };
    let (mut matrix, mut right) = ([[0.0f64; UNKNOWNS]; UNKNOWNS], [0.0f64; UNKNOWNS]);
    let samples = fit.optics.samples;
    for i in 0..samples.len() {
        let factor = atom.column[i];
        if factor <= 0.0 {
            continue;
        }
        let to = position - samples.position[i];
        let gradient = point_gradient(samples.normal[i], to, radius, falloff).map(f64::from);
        for channel in 0..3 {
            let weight = f64::from(fit.weight[channel][i]);
            let power = atom.power[channel];
            let left = f64::from(residual[channel][i]) - power * f64::from(factor);
            let mut row = [0.0; UNKNOWNS];
            for (row, gradient) in row.iter_mut().zip(gradient) {
                *row = gradient * power;
            }
            row[4 + channel] = f64::from(factor);
            for a in 0..UNKNOWNS {
                right[a] += weight * row[a] * left;
                for b in 0..=a {
                    matrix[a][b] += weight * row[a] * row[b];
                }
            }
        }
    }
    let step = solve(&mut matrix, &right, damping)?;
    let limit = fit.optics.step_limit();
    let shift = Vec4::new(step[0] as f32, step[1] as f32, step[2] as f32, step[3] as f32);
    let shift = shift * (limit / shift.length().max(limit));
    let falloff = match falloff {
        Falloff::Linear { reach } => Falloff::Linear { reach: (reach + shift.w).max(0.3 * reach) },
        Falloff::InverseSquare => Falloff::InverseSquare,
    };
    let position = position + shift.truncate();
    position.is_finite().then_some(Source::Point { position, radius, falloff })
}

impl Optics<'_> {
    /// How far a point may go in one step.
    fn step_limit(&self) -> f32 {
        0.05 * self.world.size
    }
}

/// Cholesky's method on the lower triangle with a damped diagonal. Unknowns that nothing depends on stay 0.
fn solve(
    matrix: &mut [[f64; UNKNOWNS]; UNKNOWNS],
    right: &[f64; UNKNOWNS],
    damping: f64,
) -> Option<[f64; UNKNOWNS]> {
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] = if row[i] > 0.0 { row[i] * (1.0 + damping) } else { 1.0 };
    }
    let mut x = *right;
    for i in 0..UNKNOWNS {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum();
            let left = matrix[i][j] - sum;
            if i == j {
                if left <= 1e-12 * matrix[i][i] {
                    return None;
                }
                matrix[i][i] = left.sqrt();
            } else {
                matrix[i][j] = left / matrix[j][j];
            }
        }
        let sum: f64 = (0..i).map(|k| matrix[i][k] * x[k]).sum();
        x[i] = (x[i] - sum) / matrix[i][i];
    }
    for i in (0..UNKNOWNS).rev() {
        let sum: f64 = (i + 1..UNKNOWNS).map(|k| matrix[k][i] * x[k]).sum();
        x[i] = (x[i] - sum) / matrix[i][i];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_solves() {
        let mut matrix = [[0.0; UNKNOWNS]; UNKNOWNS];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate().take(i + 1) {
                *value = if i == j { 4.0 } else { 1.0 / (1 + i + j) as f64 };
            }
        }
        let full = |m: &[[f64; UNKNOWNS]; UNKNOWNS], i: usize, j: usize| m[i.max(j)][i.min(j)];
        let original = matrix;
        let right = [1.0, -2.0, 3.0, 0.5, 0.0, 1.0, 2.0];
        let x = solve(&mut matrix, &right, 0.0).unwrap();
        for i in 0..UNKNOWNS {
            let sum: f64 = (0..UNKNOWNS).map(|j| full(&original, i, j) * x[j]).sum();
            assert!((sum - right[i]).abs() < 1e-12);
        }
    }
}
