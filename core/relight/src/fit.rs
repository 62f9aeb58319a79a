//! The linear half of the problem: how much each source gives, its place being known.

use crate::column::Optics;
use crate::gather::Gathered;
use crate::nnls::Normal;
use crate::types::Source;

/// More bounced light than the albedos allow is possible only so far as they are guesses.
const MOST_BOUNCE: f64 = 1.5;
/// Numbers of a fit that are no sources: ambient and bounced light.
const BASE: usize = 2;

/// Which reflections a bake holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bounces {
    /// One, of the sources' own light.
    First,
    /// All of them.
    All,
}

/// A source under consideration.
pub(crate) struct Atom {
    pub source: Source,
    /// Its form factors.
    pub column: Vec<f32>,
    pub power: [f64; 3],
}

/// Sources, and what of the bake they leave.
pub(crate) struct Fit<'a> {
    pub optics: &'a Optics<'a>,
    pub atoms: Vec<Atom>,
    pub ambient: [f64; 3],
    /// The share of bounced light, channel by channel.
    pub bounce: [f64; 3],
    /// Which bounces it has.
    pub bounces: Bounces,
    /// Bake less model, channel by channel.
    pub residual: [Vec<f32>; 3],
    /// What squared residuals count, channel by channel: 0 where a clipped bake is reached.
    pub weight: [Vec<f32>; 3],
    /// Trust in each sample, 0..1.
    trust: Vec<f32>,
    ones: Vec<f32>,
    bounced: [Vec<f32>; 3],
}

impl<'a> Fit<'a> {
    /// Without sources; `bounced` is the light of all bounces.
    pub fn new(optics: &'a Optics<'a>, bounced: [Vec<f32>; 3]) -> Self {
        let samples = optics.samples;
        let count = samples.len();
        let mut fit = Self {
            optics,
            atoms: Vec::new(),
            ambient: [0.0; 3],
            bounce: [0.0; 3],
            bounces: Bounces::All,
            residual: samples.target.clone(),
            weight: std::array::from_fn(|_| samples.weight.clone()),
            trust: vec![1.0; count],
            ones: vec![1.0; count],
            bounced,
        };
        fit.refit();
        fit
    }

    /// What the sources give by themselves, channel by channel.
    pub fn direct(&self) -> [Vec<f32>; 3] {
        std::array::from_fn(|channel| {
            let mut direct = vec![0.0; self.ones.len()];
            self.atoms.iter().for_each(|atom| subtract(&mut direct, &atom.column, -atom.power[channel]));
            direct
        })
    }

    /// What samples receive: the bake, or the model where that says that a clipped one receives more.
    pub fn total(&self) -> [Vec<f32>; 3] {
        let samples = self.optics.samples;
        std::array::from_fn(|channel| {
            let target = samples.target[channel].iter().zip(&self.residual[channel]).zip(&samples.clipped);
            target
                .map(|((&bake, &left), &clipped)| if clipped { bake - left.min(0.0) } else { bake })
                .collect()
        })
    }

    /// Takes these bounces; the sources' powers follow, and with them what they reflect, so this is repeated.
    pub fn set_bounces(&mut self, bounces: Bounces, gathered: &Gathered) {
        self.bounces = bounces;
        for _ in 0..3 {
            let light = match bounces {
                Bounces::First => self.direct(),
                Bounces::All => self.total(),
            };
            self.bounced = gathered.bounce(self.optics.samples, &light);
            self.refit();
        }
    }

    /// The bake's own weighted square, which gains are measured by.
    pub fn energy(&self) -> f64 {
        let samples = self.optics.samples;
        let target = samples.target.iter();
        target.map(|target| triple(&samples.weight, target, target)).sum()
    }

    /// The weighted square of what is left.
    pub fn objective(&self) -> f64 {
        (0..3).map(|c| triple(&self.weight[c], &self.residual[c], &self.residual[c])).sum()
    }

    /// Finds all powers anew.
    pub fn refit(&mut self) {
        let clipped = self.optics.samples.clipped.iter().any(|&clipped| clipped);
        for _ in 0..if clipped { 3 } else { 1 } {
            for channel in 0..3 {
                self.weigh(channel);
                self.solve(channel);
                self.update(channel);
            }
        }
        (0..3).for_each(|channel| self.weigh(channel));
    }

    fn weigh(&mut self, channel: usize) {
        let samples = self.optics.samples;
        for i in 0..samples.len() {
            let reached = samples.clipped[i] && self.residual[channel][i] <= 0.0;
            self.weight[channel][i] = if reached { 0.0 } else { samples.weight[i] * self.trust[i] };
        }
    }

    fn column(&self, number: usize, channel: usize) -> &[f32] {
        match number {
            0 => &self.ones,
            1 => &self.bounced[channel],
            _ => &self.atoms[number - BASE].column,
        }
    }

    fn solve(&mut self, channel: usize) {
        let n = self.atoms.len() + BASE;
        let normal = self.normal(channel, n);
        let mut x = vec![self.ambient[channel], self.bounce[channel]];
        x.extend(self.atoms.iter().map(|atom| atom.power[channel]));
        let mut upper = vec![f64::INFINITY; n];
        upper[1] = MOST_BOUNCE;
        normal.solve(&mut x, &upper);
        (self.ambient[channel], self.bounce[channel]) = (x[0], x[1]);
        for (atom, power) in self.atoms.iter_mut().zip(&x[BASE..]) {
            atom.power[channel] = *power;
        }
    }

    fn normal(&self, channel: usize, n: usize) -> Normal {
        let mut normal = Normal { gram: vec![0.0; n * n], right: vec![0.0; n] };
        let (weight, target) = (&self.weight[channel], &self.optics.samples.target[channel]);
        let mut weighted = vec![0.0; weight.len()];
        for i in 0..n {
            for (out, (a, w)) in weighted.iter_mut().zip(self.column(i, channel).iter().zip(weight)) {
                *out = a * w;
            }
            normal.right[i] = dot(&weighted, target);
            for j in 0..=i {
                let product = dot(&weighted, self.column(j, channel));
                normal.gram[i * n + j] = product;
                normal.gram[j * n + i] = product;
            }
        }
        normal
    }

    /// The residual of the powers as they are.
    fn update(&mut self, channel: usize) {
        let mut left = self.optics.samples.target[channel].clone();
        subtract(&mut left, &self.ones, self.ambient[channel]);
        subtract(&mut left, &self.bounced[channel], self.bounce[channel]);
        for atom in &self.atoms {
            subtract(&mut left, &atom.column, atom.power[channel]);
        }
        self.residual[channel] = left;
    }

    /// What would be left without atom `number`, all else as it is.
    pub fn residual_without(&self, number: usize) -> [Vec<f32>; 3] {
        let atom = &self.atoms[number];
        std::array::from_fn(|channel| {
            let mut left = self.residual[channel].clone();
            subtract(&mut left, &atom.column, -atom.power[channel]);
            left
        })
    }

    /// The objective without atom `number`, all else as it is.
    pub fn objective_without(&self, number: usize) -> f64 {
        let residual = self.residual_without(number);
        (0..3).map(|c| triple(&self.weight[c], &residual[c], &residual[c])).sum()
    }

    /// How many samples tell of a source with these form factors: (sum s)^2 / sum s^2, where s is what it adds to each.
    pub fn witnesses(&self, column: &[f32]) -> f64 {
        let weight = &self.optics.samples.weight;
        let shares = column.iter().zip(weight).map(|(a, w)| f64::from(a * w.sqrt()));
        let (sum, squares) = shares.fold((0.0, 0.0), |(sum, squares), s| (sum + s, squares + s * s));
        if squares > 0.0 { sum * sum / squares } else { 0.0 }
    }

    /// The objective of the samples that these atoms light.
    pub fn objective_about(&self, numbers: &[usize]) -> f64 {
        let lit = |i: usize| numbers.iter().any(|&number| self.atoms[number].column[i] > 0.0);
        let error = |i: usize| -> f64 {
            let squared = |c: usize| f64::from(self.weight[c][i] * self.residual[c][i] * self.residual[c][i]);
            (0..3).map(squared).sum()
        };
        (0..self.ones.len()).filter(|&i| lit(i)).map(error).sum()
    }

    /// By how much the objective falls where a source of these form factors gets the powers that are best for
    /// `residual`, and those powers.
    pub fn gain(&self, column: &[f32], residual: &[Vec<f32>; 3]) -> (f64, [f64; 3]) {
        let mut gain = 0.0;
        let power = std::array::from_fn(|channel| {
            let weight = &self.weight[channel];
            let along = triple(weight, column, &residual[channel]).max(0.0);
            let square = triple(weight, column, column);
            if square <= 0.0 {
                return 0.0;
            }
            gain += along * along / square;
            along / square
        });
        (gain, power)
    }

    /// Replaces atom `number` where that lowers the objective; the residual follows.
    pub fn replace(&mut self, number: usize, atom: Atom) {
        for channel in 0..3 {
            let old = &self.atoms[number];
            let left = &mut self.residual[channel];
            subtract(left, &old.column, -old.power[channel]);
            subtract(left, &atom.column, atom.power[channel]);
        }
        self.atoms[number] = atom;
    }

    /// Lowers the trust in samples that the model misses by far more than the rest: Huber's weights, the scale from the
    /// median of absolute residuals.
    pub fn distrust(&mut self) {
        let samples = self.optics.samples;
        let error = |i: usize| {
            let squared: f32 = (0..3).map(|c| self.residual[c][i].powi(2)).sum();
            let missed = (0..3).any(|c| self.weight[c][i] > 0.0);
            if missed { (squared * samples.weight[i]).sqrt() } else { 0.0 }
        };
        let errors: Vec<f32> = (0..samples.len()).map(error).collect();
        let mut sorted = errors.clone();
        sorted.sort_unstable_by(f32::total_cmp);
        let Some(&median) = sorted.get(sorted.len() / 2) else {
            return;
        };
        let bound = 2.0 * 1.4826 * median;
        self.trust = errors.iter().map(|&e| if e > bound && bound > 0.0 { bound / e } else { 1.0 }).collect();
    }
}

/// Takes power x column away.
pub(crate) fn subtract(left: &mut [f32], column: &[f32], power: f64) {
    if power == 0.0 {
        return;
    }
    for (left, a) in left.iter_mut().zip(column) {
        *left -= a * power as f32;
    }
}

/// Partial sums side by side, so that they can be vectors; always in the same order.
const LANES: usize = 16;

fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut sums = [0.0f32; LANES];
    let mut total = 0.0;
    // Partial sums are short, to lose few bits.
    for (a, b) in a.chunks(1024).zip(b.chunks(1024)) {
        let (rows_a, rows_b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
        let rest: f32 = rows_a.remainder().iter().zip(rows_b.remainder()).map(|(a, b)| a * b).sum();
        for (a, b) in rows_a.zip(rows_b) {
            for lane in 0..LANES {
                sums[lane] += a[lane] * b[lane];
            }
        }
        total += f64::from(rest) + sums.iter().map(|&s| f64::from(s)).sum::<f64>();
        sums = [0.0; LANES];
    }
    total
}

/// The sum of w a b.
pub(crate) fn triple(w: &[f32], a: &[f32], b: &[f32]) -> f64 {
    let mut total = 0.0;
    for ((w, a), b) in w.chunks(1024).zip(a.chunks(1024)).zip(b.chunks(1024)) {
        let mut sums = [0.0f32; LANES];
        let (rows_w, rows_a, rows_b) = (w.chunks_exact(LANES), a.chunks_exact(LANES), b.chunks_exact(LANES));
        let rest = rows_w.remainder().iter().zip(rows_a.remainder()).zip(rows_b.remainder());
        let rest: f32 = rest.map(|((w, a), b)| w * a * b).sum();
        for ((w, a), b) in rows_w.zip(rows_a).zip(rows_b) {
            for lane in 0..LANES {
                sums[lane] += w[lane] * a[lane] * b[lane];
            }
        }
        total += f64::from(rest) + sums.iter().map(|&s| f64::from(s)).sum::<f64>();
    }
    total
}
