//! Whether a device is too slow to trace paths for somebody who plays.

use std::time::Duration;

/// Pictures that are judged together.
const PICTURES: u32 = 8;
/// How many of them must have taken too long: a few do where shaders are compiled for the first time.
const ENOUGH: u32 = 6;
/// More time than this for a picture is too much: four a second cannot be played.
pub(crate) const MOST: Duration = Duration::from_millis(250);

/// How many pictures take too long.
#[derive(Debug, Default)]
pub(crate) struct Slowness {
    pictures: u32,
    slow: u32,
}

impl Slowness {
    /// Takes note of the time that the render thread has spent on a picture. Whether pictures take too long.
    pub(crate) fn note(&mut self, taken: Duration) -> bool {
        self.pictures += 1;
        self.slow += u32::from(taken > MOST);
        if self.pictures < PICTURES {
            return false;
        }
        std::mem::take(self).slow >= ENOUGH
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many times pictures that took so many milliseconds were found too slow.
    fn verdicts(milliseconds: &[u64]) -> usize {
        let mut slowness = Slowness::default();
        milliseconds.iter().filter(|ms| slowness.note(Duration::from_millis(**ms))).count()
    }

    #[test]
    fn a_few_long_pictures_are_no_verdict() {
        assert_eq!(verdicts(&[9000, 3000, 10, 10, 10, 10, 10, 10]), 0);
        assert_eq!(verdicts(&[900; 7]), 0);
    }

    #[test]
    fn pictures_that_take_long_again_and_again_are_too_slow() {
        assert_eq!(verdicts(&[10, 10, 300, 300, 300, 300, 300, 300]), 1);
        assert_eq!(verdicts(&[10; 8]), 0);
    }
}
