//! How fast a drawable's pictures come.

use std::time::{Duration, Instant};

/// Counts pictures.
pub(crate) struct Pace {
    period: Duration,
    since: Instant,
    frames: u32,
    latency: Duration,
    total: u64,
}

/// Means over a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Figures {
    /// Pictures since the beginning.
    pub(crate) frame: u64,
    /// Pictures a second.
    pub(crate) rate: f64,
    /// Milliseconds from the program's buffer swap until the picture was handed to the window system.
    pub(crate) latency: f64,
}

impl Pace {
    /// Figures come once a `period`.
    pub(crate) fn new(now: Instant, period: Duration) -> Self {
        Self { period, since: now, frames: 0, latency: Duration::ZERO, total: 0 }
    }

    /// Pictures so far.
    pub(crate) fn total(&self) -> u64 {
        self.total
    }

    /// A picture that the program handed over at `handed_over` was shown. Once a period, what there is to say.
    pub(crate) fn shown(&mut self, handed_over: Instant, now: Instant) -> Option<Figures> {
        self.frames += 1;
        self.total += 1;
        self.latency += now - handed_over;
        let passed = now - self.since;
        if passed < self.period {
            return None;
        }
        let frames = f64::from(self.frames);
        let figures = Figures {
            frame: self.total,
            rate: frames / passed.as_secs_f64(),
            latency: self.latency.as_secs_f64() * 1000.0 / frames,
        };
        *self = Self { total: self.total, ..Self::new(now, self.period) };
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
        let mut pace = Pace::new(start, Duration::from_secs(5));
        assert_eq!(pace.shown(at(1000), at(1010)), None);
        let Figures { frame, rate, latency } = pace.shown(at(4970), at(5000)).unwrap();
        assert!((rate - 0.4).abs() < 1e-9 && (latency - 20.0).abs() < 1e-9);
        assert_eq!(pace.shown(at(5001), at(5002)), None);
        assert_eq!((frame, pace.shown(at(10_000), at(10_000)).unwrap().frame), (2, 4));
    }
}
