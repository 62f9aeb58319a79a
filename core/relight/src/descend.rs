//! Points moved to where they leave least: Levenberg and Marquardt's method on a few at a time, those that light the
//! same places together, since each by itself makes up for the others' errors.

use crate::column::{Optics, point_gradient};
use crate::fit::{Atom, Fit, subtract, triple};
use crate::nnls::Normal;
use crate::reduce::likeness;
use crate::types::{Falloff, Source};
use glam::Vec3;

/// Most points of a group.
const MOST: usize = 4;
/// Points whose form factors are more alike than this (cosine) are moved together.
const TOGETHER: f64 = 0.2;
/// Unknowns of a point: three of position, the reach of a linear light, three powers.
const UNKNOWNS: usize = 7;

/// All points, in groups of those that light the same places.
pub(crate) fn groups(fit: &Fit) -> Vec<Vec<usize>> {
    let points = fit.atoms.iter().enumerate();
    let mut left: Vec<usize> = points.filter(|(_, atom)| is_point(&atom.source)).map(|(i, _)| i).collect();
    let mut groups = Vec::new();
    while !left.is_empty() {
        let first = left.remove(0);
        let like = |&number: &usize| likeness(fit, &fit.atoms[first].column, &fit.atoms[number].column);
        let mut near: Vec<(f64, usize)> = left.iter().map(|number| (like(number), *number)).collect();
        near.retain(|&(likeness, _)| likeness > TOGETHER);
        near.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut group = vec![first];
        group.extend(near.into_iter().take(MOST - 1).map(|(_, number)| number));
        left.retain(|number| !group.contains(number));
        groups.push(group);
    }
    groups
}

fn is_point(source: &Source) -> bool {
    matches!(source, Source::Point { .. })
}

/// Moves the points of `group` by at most `steps` steps, visibility being taken as it is in each.
pub(crate) fn descend(fit: &mut Fit, group: &[usize], steps: u32) {
    let mut residual = fit.residual.clone();
    for &number in group {
        let atom = &fit.atoms[number];
        for (left, power) in residual.iter_mut().zip(atom.power) {
            subtract(left, &atom.column, -power);
        }
    }
    let mut damping = 1e-3;
    let mut objective = fit.objective();
    for _ in 0..steps {
        let Some(sources) = proposal(fit, &residual, group, damping) else {
            return;
        };
        let (atoms, left) = shone(fit, &residual, &sources);
        if left < objective {
            let enough = left > objective * 0.9998;
            (objective, damping) = (left, damping * 0.2);
            group.iter().zip(atoms).for_each(|(&number, atom)| fit.replace(number, atom));
            if enough {
                return;
            }
        } else {
            damping *= 16.0;
        }
    }
}

/// These sources with the powers that are best for `residual`, and what they leave of it.
fn shone(fit: &Fit, residual: &[Vec<f32>; 3], sources: &[Source]) -> (Vec<Atom>, f64) {
    let mut atoms: Vec<Atom> = sources
        .iter()
        .map(|&source| Atom { source, column: fit.optics.column(&source), power: [0.0; 3] })
        .collect();
    let mut objective = 0.0;
    let count = atoms.len();
    for (channel, residual) in residual.iter().enumerate() {
        let weight = &fit.weight[channel];
        let right: Vec<f64> = atoms.iter().map(|atom| triple(weight, &atom.column, residual)).collect();
        let mut gram = vec![0.0; count * count];
        for i in 0..count {
            for j in 0..=i {
                let product = triple(weight, &atoms[i].column, &atoms[j].column);
                (gram[i * count + j], gram[j * count + i]) = (product, product);
            }
        }
        let mut power = vec![0.0; count];
        Normal { gram, right }.solve(&mut power, &vec![f64::INFINITY; count]);
        let mut left = residual.clone();
        for (atom, power) in atoms.iter_mut().zip(power) {
            atom.power[channel] = power;
            subtract(&mut left, &atom.column, power);
        }
        objective += triple(weight, &left, &left);
    }
    (atoms, objective)
}

/// Where the linearised problem puts the points.
fn proposal(fit: &Fit, residual: &[Vec<f32>; 3], group: &[usize], damping: f64) -> Option<Vec<Source>> {
    let mut system = System::new(group.len() * UNKNOWNS);
    for (channel, residual) in residual.iter().enumerate() {
        for (i, (&left, &weight)) in residual.iter().zip(&fit.weight[channel]).enumerate() {
            if weight > 0.0 {
                let (row, model) = derivatives(fit, group, i, channel);
                system.add(&row, f64::from(left) - model, f64::from(weight));
            }
        }
    }
    let step = system.solve(damping)?;
    let moved = |(&number, step): (&usize, &[f64])| fit.optics.moved(&fit.atoms[number].source, step);
    group.iter().zip(step.chunks(UNKNOWNS)).map(moved).collect()
}

/// What sample `i` receives from the group, and what that changes by with each unknown: (unknown, derivative), zeros left out.
fn derivatives(fit: &Fit, group: &[usize], i: usize, channel: usize) -> (Vec<(usize, f64)>, f64) {
    let samples = fit.optics.samples;
    let mut row = Vec::new();
    let mut model = 0.0;
    for (place, &number) in group.iter().enumerate() {
        let atom = &fit.atoms[number];
        let (factor, power) = (f64::from(atom.column[i]), atom.power[channel]);
        let Source::Point { position, radius, falloff } = atom.source else {
            continue;
        };
        if factor <= 0.0 {
            continue;
        }
        let gradient = point_gradient(samples.normal[i], position - samples.position[i], radius, falloff);
        let first = place * UNKNOWNS;
        row.extend((first..).zip(gradient.map(|g| f64::from(g) * power)));
        row.push((first + 4 + channel, factor));
        model += factor * power;
    }
    (row, model)
}

impl Optics<'_> {
    /// A point after a step, which is cut to a twentieth of the world.
    fn moved(&self, source: &Source, step: &[f64]) -> Option<Source> {
        let Source::Point { position, radius, falloff } = *source else {
            return None;
        };
        let limit = 0.05 * self.world.size;
        let shift = Vec3::new(step[0] as f32, step[1] as f32, step[2] as f32).clamp_length_max(limit);
        let falloff = match falloff {
            Falloff::Linear { reach } => {
                Falloff::Linear { reach: (reach + (step[3] as f32).clamp(-limit, limit)).max(0.3 * reach) }
            }
            Falloff::InverseSquare => Falloff::InverseSquare,
        };
        let position = position + shift;
        position.is_finite().then_some(Source::Point { position, radius, falloff })
    }
}

/// Normal equations; of the matrix the lower triangle.
struct System {
    size: usize,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl System {
    fn new(size: usize) -> Self {
        Self { size, matrix: vec![0.0; size * size], right: vec![0.0; size] }
    }

    fn add(&mut self, row: &[(usize, f64)], left: f64, weight: f64) {
        for (place, &(a, value)) in row.iter().enumerate() {
            self.right[a] += weight * value * left;
            for &(b, other) in &row[..=place] {
                let at = a.max(b) * self.size + a.min(b);
                self.matrix[at] += weight * value * other;
            }
        }
    }

    /// Cholesky's method with a damped diagonal. Unknowns that nothing depends on stay 0; None where others cannot be told.
    fn solve(mut self, damping: f64) -> Option<Vec<f64>> {
        let n = self.size;
        let mut x = self.right;
        for i in 0..n {
            let own = &mut self.matrix[i * n + i];
            *own = if *own > 0.0 { *own * (1.0 + damping) } else { 1.0 };
        }
        for i in 0..n {
            let (above, row) = self.matrix.split_at_mut(i * n);
            for j in 0..i {
                let sum: f64 = (0..j).map(|k| row[k] * above[j * n + k]).sum();
                row[j] = (row[j] - sum) / above[j * n + j];
            }
            let sum: f64 = row[..i].iter().map(|value| value * value).sum();
            let left = row[i] - sum;
            if left.is_nan() || left <= 1e-13 * row[i] {
                return None;
            }
            row[i] = left.sqrt();
            let sum: f64 = (0..i).map(|k| row[k] * x[k]).sum();
            x[i] = (x[i] - sum) / row[i];
        }
        for i in (0..n).rev() {
            let sum: f64 = (i + 1..n).map(|k| self.matrix[k * n + i] * x[k]).sum();
            x[i] = (x[i] - sum) / self.matrix[i * n + i];
        }
        x.iter().all(|x| x.is_finite()).then_some(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_solves() {
        let rows = [[(0, 2.0), (1, 1.0)], [(1, 3.0), (0, -1.0)], [(0, 1.0), (1, 1.0)]];
        let mut system = System::new(3);
        for (row, left) in rows.iter().zip([5.0, 4.0, 3.0]) {
            system.add(row, left, 2.0);
        }
        // x = (11/7, 13/7) solves the first two and misses the third by 3/7: against normal equations.
        let x = system.solve(0.0).unwrap();
        let (a, b) = (x[0], x[1]);
        let gradient_a = 2.0 * (2.0 * a + b - 5.0) - (3.0 * b - a - 4.0) + (a + b - 3.0);
        let gradient_b = (2.0 * a + b - 5.0) + 3.0 * (3.0 * b - a - 4.0) + (a + b - 3.0);
        assert!(gradient_a.abs() < 1e-12 && gradient_b.abs() < 1e-12 && x[2] == 0.0, "{x:?}");
    }
}
