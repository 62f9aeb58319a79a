//! How many samples a submission has.

use std::time::Duration;

/// What a submission should take, seconds: long against its overhead, short against what drivers allow.
const WANTED: f64 = 0.5;
/// How many times more samples than the last one a submission may have, so that one bad measurement does no harm.
const MOST_GROWTH: u32 = 4;
/// Whatever the device takes: what it counts in a submission must not overflow.
const MOST_SAMPLES: u32 = 1 << 10;

/// Finds the number of samples by what the last submissions took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    samples: u32,
}

impl Default for Pace {
    /// One sample, since nothing is known of what it takes.
    fn default() -> Self {
        Self { samples: 1 }
    }
}

impl Pace {
    /// Samples a pixel of the next submission.
    pub fn next(self) -> u32 {
        self.samples
    }

    /// Learns what a submission of so many took.
    pub fn note(&mut self, samples: u32, taken: Duration) {
        let fitting = f64::from(samples) * WANTED / taken.as_secs_f64().max(1e-6);
        let most = self.samples.saturating_mul(MOST_GROWTH).min(MOST_SAMPLES);
        self.samples = (fitting as u32).clamp(1, most);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Submissions of a device that takes so many seconds a sample.
    fn submissions(seconds: f64) -> Vec<u32> {
        let mut pace = Pace::default();
        let submit = |_| {
            let samples = pace.next();
            pace.note(samples, Duration::from_secs_f64(seconds * f64::from(samples)));
            samples
        };
        (0..8).map(submit).collect()
    }

    #[test]
    fn submissions_take_about_what_they_should() {
        assert_eq!(submissions(0.15), [1, 3, 3, 3, 3, 3, 3, 3]);
        assert_eq!(submissions(7.0), [1; 8]);
        assert_eq!(submissions(1e-9)[..6], [1, 4, 16, 64, 256, 1024]);
    }
}
