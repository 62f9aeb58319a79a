//! How often to begin anew.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Failures that are borne within a [`PERIOD`].
const MOST: usize = 3;
const PERIOD: Duration = Duration::from_secs(60);

/// The failures of the last minute.
#[derive(Default)]
pub(crate) struct Failures {
    times: VecDeque<Instant>,
}

impl Failures {
    /// Takes note of a failure; whether there were few enough of late to try again.
    pub(crate) fn allow(&mut self, now: Instant) -> bool {
        while self.times.front().is_some_and(|time| now.duration_since(*time) >= PERIOD) {
            self.times.pop_front();
        }
        self.times.push_back(now);
        self.times.len() <= MOST
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_failures_a_minute_are_borne() {
        let start = Instant::now();
        let mut failures = Failures::default();
        let allowed: Vec<_> =
            [0, 10, 59, 60, 69, 70].map(|s| failures.allow(start + Duration::from_secs(s))).into();
        assert_eq!(allowed, [true, true, true, true, false, false]);
        assert!(failures.allow(start + Duration::from_secs(200)));
    }
}
