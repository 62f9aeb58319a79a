//! Which frames are rendered.

use std::ops::Range;
use std::str::FromStr;
use std::time::Duration;

use crate::failure::Failure;
use crate::options;

/// `N` or `A..B`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Frames {
    /// So many of a still.
    Count(u64),
    /// Those of a sequence, without the end.
    Range(Range<u64>),
}

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Frames, String> {
        if text.contains("..") {
            return text.parse().map(|options::Frames(range)| Frames::Range(range));
        }
        match text.parse::<u64>() {
            Ok(count @ 1..) => Ok(Frames::Count(count)),
            _ => Err(format!("'{text}' is neither a number of frames nor A..B")),
        }
    }
}

/// What is rendered, one frame after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Selection {
    /// Successive frames of the still scene.
    Stills(u64),
    /// The still scene for so long, once at least.
    Time(Duration),
    /// Frames of the sequence.
    Sequence(Range<u64>),
}

impl Selection {
    /// What is asked for of a scene whose sequence has `length` frames; 0 of a still.
    pub fn new(
        frames: Option<&Frames>,
        seconds: Option<Duration>,
        length: usize,
    ) -> Result<Selection, Failure> {
        match (frames, seconds, length as u64) {
            (None, None, _) => Ok(Selection::Stills(1)),
            (Some(_), Some(_), _) => {
                Err(Failure::Usage("--seconds and --frames go together in reference mode only".into()))
            }
            (None, Some(time), _) => Ok(Selection::Time(time)),
            (Some(Frames::Count(count)), _, 0) => Ok(Selection::Stills(*count)),
            (Some(Frames::Count(_)), _, length) => Err(Failure::Usage(format!(
                "the scene is a sequence of {length} frames: say which ones, as in --frames 0..{length}"
            ))),
            (Some(Frames::Range(_)), _, 0) => Err(Failure::Usage(
                "the scene is a still: --frames N renders it N times in succession".into(),
            )),
            (Some(Frames::Range(range)), _, length) => match range.start..range.end.min(length) {
                range if range.is_empty() => {
                    Err(Failure::Usage(format!("the scene has {length} frames, none of those asked for")))
                }
                range => Ok(Selection::Sequence(range)),
            },
        }
    }

    /// The frames, in order.
    pub fn frames(&self) -> Succession<'_> {
        Succession { selection: self, count: 0 }
    }

    /// The share of all that is done after so many frames and so long a time.
    pub fn share(&self, frames: f64, elapsed: Duration) -> f64 {
        match self {
            Selection::Stills(count) => frames / *count as f64,
            Selection::Time(time) => elapsed.as_secs_f64() / time.as_secs_f64(),
            Selection::Sequence(range) => frames / (range.end - range.start) as f64,
        }
    }
}

/// Goes through a selection.
#[derive(Debug)]
pub struct Succession<'a> {
    selection: &'a Selection,
    count: u64,
}

impl Succession<'_> {
    /// The next frame after so long a time: its number in the sequence, or none within for the still scene.
    pub fn next(&mut self, elapsed: Duration) -> Option<Option<u64>> {
        if self.is_last(elapsed) {
            return None;
        }
        self.count += 1;
        Some(match self.selection {
            Selection::Stills(_) | Selection::Time(_) => None,
            Selection::Sequence(range) => Some(range.start + self.count - 1),
        })
    }

    /// Whether there is no frame after those that have been, if it is so late. Each selection has one at least.
    pub fn is_last(&self, elapsed: Duration) -> bool {
        match self.selection {
            Selection::Stills(count) => self.count >= *count,
            Selection::Time(time) => self.count > 0 && elapsed >= *time,
            Selection::Sequence(range) => self.count >= range.end - range.start,
        }
    }

    /// How many have been.
    pub fn count(&self) -> u64 {
        self.count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(selection: &Selection) -> Vec<Option<u64>> {
        let mut frames = selection.frames();
        std::iter::from_fn(|| frames.next(Duration::from_secs(1))).collect()
    }

    #[test]
    fn stills_are_repeated_and_sequences_are_played() {
        let select = |text: &str, length| Selection::new(Some(&text.parse().unwrap()), None, length);
        assert_eq!(numbers(&select("2", 0).unwrap()), [None, None]);
        assert_eq!(numbers(&select("2..4", 9).unwrap()), [Some(2), Some(3)]);
        assert_eq!(numbers(&select("7..", 9).unwrap()), [Some(7), Some(8)]);
        assert!(select("2", 9).is_err() && select("0..2", 0).is_err() && select("9..12", 9).is_err());
        assert!("0".parse::<Frames>().is_err() && "-1".parse::<Frames>().is_err());
    }

    #[test]
    fn time_is_for_one_frame_at_least() {
        let within = Selection::new(None, Some(Duration::from_secs(1)), 0).unwrap();
        assert_eq!(numbers(&within), [None]);
        assert_eq!(numbers(&Selection::new(None, None, 48).unwrap()), [None]);
    }
}
