//! Ranges made of buffer objects' content, kept while that does not change.

use std::hash::{BuildHasher, Hasher};
use std::sync::Arc;

use hashbrown::{DefaultHashBuilder, HashMap, HashSet};

use crate::frame::RetainedRange;

/// Retained ranges that are kept for arrays in buffer objects, at most.
const RANGES_KEPT: usize = 16384;
/// Frames after which a range that was not drawn is forgotten.
const FRAMES_KEPT: u64 = 256;

/// Ranges made of buffer objects' content, by what they were made of. What is drawn in a second frame without a change
/// is worth a range; what a program writes anew for each frame is not.
#[derive(Debug, Default)]
pub struct RangeCache {
    kept: HashMap<u64, Kept>,
    /// What was drawn in this frame, and in the one before.
    drawn: HashSet<u64>,
    drawn_before: HashSet<u64>,
    /// Frames so far.
    frame: u64,
    hasher: DefaultHashBuilder,
}

#[derive(Debug)]
struct Kept {
    range: Arc<RetainedRange>,
    /// The frame that it was drawn in last.
    frame: u64,
}

impl RangeCache {
    /// The next frame begins.
    pub fn next_frame(&mut self) {
        self.frame += 1;
        std::mem::swap(&mut self.drawn, &mut self.drawn_before);
        self.drawn.clear();
        if self.frame.is_multiple_of(FRAMES_KEPT) {
            self.kept.retain(|_, kept| self.frame - kept.frame < FRAMES_KEPT);
        }
    }

    /// The hash that keys are made with.
    pub fn hasher(&self) -> impl Hasher + use<> {
        self.hasher.build_hasher()
    }

    /// The range that is kept under a key; it counts as drawn now.
    pub fn get(&mut self, key: u64) -> Option<&Arc<RetainedRange>> {
        let kept = self.kept.get_mut(&key)?;
        kept.frame = self.frame;
        Some(&kept.range)
    }

    /// Takes note of a draw; whether it was drawn in the frame before, too.
    pub fn is_drawn_again(&mut self, key: u64) -> bool {
        if self.drawn.len() < RANGES_KEPT {
            self.drawn.insert(key);
        }
        self.drawn_before.contains(&key)
    }

    /// Keeps a range.
    pub fn keep(&mut self, key: u64, range: Arc<RetainedRange>) {
        if self.kept.len() >= RANGES_KEPT {
            self.kept.clear();
        }
        self.kept.insert(key, Kept { range, frame: self.frame });
    }
}
