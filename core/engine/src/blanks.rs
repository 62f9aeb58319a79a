//! What stands in for a screen's blanks where none can be waited for.

use std::time::{Duration, Instant};

/// From one to the next, as on most screens.
const PERIOD: Duration = Duration::from_micros(16_667);

/// Keeps pictures apart.
#[derive(Default)]
pub(crate) struct Blanks {
    last: Option<Instant>,
}

impl Blanks {
    /// Waits for the next blank.
    pub(crate) fn wait(&mut self) {
        let now = Instant::now();
        let wait = self.until_next(now);
        std::thread::sleep(wait);
        self.last = Some(now + wait);
    }

    fn until_next(&self, now: Instant) -> Duration {
        self.last.map_or(Duration::ZERO, |last| (last + PERIOD).saturating_duration_since(now))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_too_fast_waits() {
        let now = Instant::now();
        assert_eq!(Blanks::default().until_next(now), Duration::ZERO);
        let blanks = Blanks { last: Some(now) };
        assert_eq!(blanks.until_next(now), PERIOD);
        assert_eq!(blanks.until_next(now + PERIOD * 3), Duration::ZERO);
    }
}
