//! Statistics of tests, shared with those in `tests/`.

use super::random::independent;
use glam::Vec4;

/// The same independent numbers in every run.
pub fn draws(seed: u32, count: u32) -> impl Iterator<Item = Vec4> {
    (0..count).map(move |i| independent(i, 0, 0, seed))
}

/// A mean and how far it may be from the truth (Welford's sums).
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Mean {
    pub const fn new() -> Self {
        Self { count: 0.0, mean: 0.0, squares: 0.0 }
    }

    pub fn add(&mut self, value: f64) {
        self.count += 1.0;
        let before = value - self.mean;
        self.mean += before / self.count;
        self.squares += before * (value - self.mean);
    }

    pub fn mean(&self) -> f64 {
        self.mean
    }

    pub fn variance(&self) -> f64 {
        self.squares / (self.count - 1.0)
    }

    pub fn standard_error(&self) -> f64 {
        (self.variance() / self.count).sqrt()
    }

    /// Panics if the mean is further from `expected` than so many standard errors, or than rounding if there are none.
    pub fn assert_near(&self, expected: f64, standard_errors: f64) {
        let far = (self.mean - expected).abs();
        let most = standard_errors * self.standard_error() + 1e-6 * expected.abs();
        assert!(far <= most, "{} is not {expected}: {far} off, at most {most}", self.mean);
    }
}

/// Panics if counts are less likely than five standard deviations (chi-square; its cube root is nearly normal,
/// Wilson and Hilferty 1931). Bins that expect fewer than 10 are put together.
pub fn assert_chi_square(counts: &[f64], expected: &[f64], what: &str) {
    let (mut statistic, mut bins, mut rest) = (0.0, 0.0, [0.0; 2]);
    let mut add = |count: f64, expected: f64| {
        statistic += (count - expected).powi(2) / expected;
        bins += 1.0;
    };
    for (&count, &expected) in counts.iter().zip(expected) {
        if expected >= 10.0 {
            add(count, expected);
        } else {
            rest = [rest[0] + count, rest[1] + expected];
        }
    }
    if rest[1] >= 10.0 {
        add(rest[0], rest[1]);
    }
    let freedom: f64 = bins - 1.0;
    let spread = 2.0 / (9.0 * freedom);
    let deviation = ((statistic / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    assert!(deviation < 5.0, "{what}: chi-square {statistic} at {freedom} degrees of freedom");
}
