//! How fast a drawable's pictures come.

use std::time::{Duration, Instant};

/// How often it is logged.
const PERIOD: Duration = Duration::from_secs(5);

/// Counts pictures.
pub(crate) struct Pace {
    since: Instant,
    frames: u32,
    latency: Duration,
}

impl Pace {
    pub(crate) fn new(now: Instant) -> Self {
        Self { since: now, frames: 0, latency: Duration::ZERO }
    }

    /// A picture that the program handed over at `handed_over` was shown. Once in a while, what there is to say:
    /// pictures a second, and the mean time from the program's buffer swap to the picture in milliseconds.
    pub(crate) fn shown(&mut self, handed_over: Instant, now: Instant) -> Option<(f64, f64)> {
        self.frames += 1;
        self.latency += now - handed_over;
        let passed = now - self.since;
        if passed < PERIOD {
            return None;
        }
        let frames = f64::from(self.frames);
        let figures = (frames / passed.as_secs_f64(), self.latency.as_secs_f64() * 1000.0 / frames);
        *self = Self::new(now);
        Some(figures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_and_latency_are_means_of_a_period() {
        let start = Instant::now();
        let at = |milliseconds| start + Duration::from_millis(milliseconds);
        let mut pace = Pace::new(start);
        assert_eq!(pace.shown(at(1000), at(1010)), None);
        let (rate, latency) = pace.shown(at(4970), at(5000)).unwrap();
        assert!((rate - 0.4).abs() < 1e-9 && (latency - 20.0).abs() < 1e-9);
        assert_eq!(pace.shown(at(5001), at(5002)), None);
    }
}
